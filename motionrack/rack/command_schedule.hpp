// Schedule of commands to a running job: planned ones, each at its instant, and stop requests during the run.
//
//   kernel ──on_scheduled at the instant──► break_run ──► between runs: apply_due() ──► stop flag, StreamExecutor
//
// A stop request takes effect a microsecond later, at an instant that a recording stores. Planned at that instant, it
// has the same effect again.
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
    /// Call before the rack starts. Commands: "stop", "hold", "resume", "feed=PART" (0.01 .. 2),
    /// "rapid=PART" (0.01 .. 1). Errors: invalid_input for the first unknown command; refused for a hold without a
    /// later resume or stop.
    static Result<std::unique_ptr<CommandSchedule>> create(Rack& rack, const std::vector<ScheduledText>& commands);
    /// Returns true if a command of that name exists; its value may be invalid.
    static bool knows(std::string_view action);

    /// Call after the rack has started.
    void begin();
    /// Returns true if a StreamExecutor must drive: some commands are not stops.
    bool needs_stream() const { return needs_stream_; }
    /// Sets the executor; nullptr: a feed hold is not possible.
    void attach(control::StreamExecutor* stream) { stream_ = stream; }
    /// Stop flag for executors other than StreamExecutor.
    const std::atomic<bool>* stop_flag() const { return &stop_flag_; }

    // ---- between runs
    /// Requests a stop, once. Returns the instant at which it takes effect.
    std::optional<Instant> ask_stop();
    void apply_due();
    /// Reports that the stop latch has stopped the machine: the executor decelerates to standstill and drops the
    /// program.
    void halt();
    bool stopped() const { return stop_flag_; }
    /// Returns true if the last hold or resume was a hold. A resume before standstill takes effect at standstill.
    bool holds() const { return holds_; }
    /// Returns true while a command is pending.
    bool pending() const;
    /// Sentences about commands that were not executed because the run ended before them.
    std::vector<std::string> not_done() const;

    void on_scheduled(Instant now) override;

  private:
    enum class CommandKind : std::uint8_t { stop, hold, resume, feed, rapid };
    struct ScheduledCommand {
        Instant at{};
        CommandKind kind = CommandKind::stop;
        double value = 1;
        std::string text;
        bool done = false;
    };
    explicit CommandSchedule(Rack& rack) : rack_(rack) {}
    static Result<ScheduledCommand> read(const ScheduledText& text);
    Result<void> check_holds() const;
    void apply(const ScheduledCommand& command);
    void aim();

    Rack& rack_;
    sim::DeviceId id_{};
    std::vector<ScheduledCommand> commands_;  // by time
    control::StreamExecutor* stream_ = nullptr;
    std::atomic<bool> stop_flag_{false};
    bool needs_stream_ = false, asked_ = false, holds_ = false;
    double feed_ = 1, rapid_ = 1;
};

}  // namespace motionrack::rack
