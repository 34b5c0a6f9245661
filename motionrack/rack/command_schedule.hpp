// Orders to a running job, each at its instant: planned ones, and a stop that somebody asks for on the way.
//
//   kernel ──act at the instant──► break_run ──► between runs: apply_due() ──► stop flag, Stream
//
// A stop that is asked for takes effect a microsecond later, at an instant that a recording has: planned there, it does
// the same again.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <motionrack/control/stream_executor.hpp>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/scheduled_text.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

class CommandSchedule final : public sim::Device {
  public:
    /// Before the rack is started. Orders: "stop", "hold", "resume", "feed=PART" (0.01 .. 2), "rapid=PART" (0.01 .. 1).
    /// Errors: invalid_input for the first that is none of these; refused, a hold after which neither resume nor stop
    /// is planned.
    static Result<std::unique_ptr<CommandSchedule>> create(Rack& rack, const std::vector<ScheduledText>& orders);
    /// Whether there is an order of that name; its value may be wrong.
    static bool knows(std::string_view action);

    /// After the rack was started.
    void begin();
    /// Whether a Stream must drive: there are others than stops.
    bool needs_stream() const { return needs_stream_; }
    /// Who drives; nullptr: nobody who could hold.
    void attach(control::StreamExecutor* stream) { stream_ = stream; }
    /// For those who drive without a Stream.
    const std::atomic<bool>* stop_flag() const { return &stop_flag_; }

    // ---- between runs
    /// Comes to rest soon; once. Gives the instant at which it takes effect.
    std::optional<Instant> ask_stop();
    void apply_due();
    /// The stop latch has stopped the machine: whoever drives comes to rest and forgets the program.
    void halt();
    bool stopped() const { return stop_flag_; }
    /// The last of holds and resumes was a hold. A resume that comes before the axes stand lets them go on as soon as
    /// they do.
    bool holds() const { return holds_; }
    /// An order is still to come.
    bool pending() const;
    /// Sentences about what was not done because the run ended before.
    std::vector<std::string> not_done() const;

    void on_scheduled(Instant now) override;

  private:
    enum class Kind : std::uint8_t { stop, hold, resume, feed, rapid };
    struct Order {
        Instant at{};
        Kind kind = Kind::stop;
        double value = 1;
        std::string text;
        bool done = false;
    };
    explicit CommandSchedule(Rack& rack) : rack_(rack) {}
    static Result<Order> read(const ScheduledText& text);
    Result<void> check_holds() const;
    void apply(const Order& order);
    void aim();

    Rack& rack_;
    sim::DeviceId id_{};
    std::vector<Order> orders_;  // in the order of time
    control::StreamExecutor* stream_ = nullptr;
    std::atomic<bool> stop_flag_{false};
    bool needs_stream_ = false, asked_ = false, holds_ = false;
    double feed_ = 1, rapid_ = 1;
};

}  // namespace motionrack::rack
