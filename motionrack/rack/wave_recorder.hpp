// Wires, pulses, encoder lines and card values of a running rack, written to a VCD file while it runs.
//
//   kernel wires ──┐
//   pulse edges ───┼──► events in a buffer ──drain(), between runs, in order of time──► VcdWriter
//   encoder edges ─┘
//
// A pulse of the recording lasts half the way to the next one, at most 5 us; the direction changes 250 ns before the first pulse that way.
#pragma once

#include <memory>
#include <motionrack/rack/rack.hpp>
#include <motionrack/trace/vcd.hpp>
#include <string>
#include <vector>

namespace motionrack::rack {

struct WaveSettings {
    std::string path;                                ///< the VCD file
    std::vector<std::string> signals;                ///< patterns with * and ?, over full names ("X.step", "motion.xlmtp"); empty: all
    Duration timescale{1000};                        ///< 100 ns: fine for viewers and sigrok; 100 ps ticks are exact
    Duration register_period = milliseconds(1);      ///< how often LP, EP and RR0 are looked at
};

class WaveRecorder final : public sim::Device, public sim::Kernel::WireObserver {
  public:
    /// Before the rack is started. Errors: io; bad_input if no signal fits the patterns.
    static Result<std::unique_ptr<WaveRecorder>> create(Rack& rack, const WaveSettings& settings);
    ~WaveRecorder() override;

    /// After the rack was started.
    void begin();
    /// Between runs: writes what has come together.
    void drain();
    /// Ends the file. Errors: io.
    Result<void> finish();
    std::uint64_t changes() const { return changes_; }

    void act(Instant now) override;
    void wire_changed(sim::WireId wire, int level, Instant now) override;

  private:
    struct Event {
        Instant at{};
        std::uint32_t id = 0;
        std::uint64_t value = 0;
    };
    /// Hears the pulses of one axis.
    class StepEar;
    /// Hears the encoder of one axis.
    class LineEar;
    struct CardSignals {
        Card* card = nullptr;
        std::vector<std::uint32_t> lp, ep;
    };

    WaveRecorder(Rack& rack, trace::VcdWriter writer, Duration register_period);
    bool declare(const WaveSettings& settings);
    void push(Instant at, std::uint32_t id, std::uint64_t value);
    void look_at_cards(Instant now);

    static constexpr std::size_t buffer_size = 1 << 21;

    Rack& rack_;
    trace::VcdWriter writer_;
    Duration register_period_;
    sim::DeviceId id_{};
    std::vector<std::int64_t> wire_ids_;  // VCD id of each kernel wire, -1: not recorded
    std::vector<std::unique_ptr<StepEar>> steps_;
    std::vector<std::unique_ptr<LineEar>> lines_;
    std::vector<CardSignals> cards_;
    std::vector<Event> buffer_;
    std::uint64_t changes_ = 0;
    Instant last_{};
};

}  // namespace motionrack::rack
