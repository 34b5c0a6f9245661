// Wires, pulses, encoder lines and card values of a running rack, written to a file while it runs.
//
//   kernel wires ──┐
//   pulse edges ───┼──► events in a buffer ──drain(), between runs, in order of time──► WaveSink (VCD, CSV, HDF5)
//   encoder edges ─┤
//   LP, EP ────────┘ looked at every register_period
//
// A pulse of X.step lasts half the way to the next one, at most 5 us; X.dir changes 250 ns before the first pulse that
// way. Pins that the card drives on demand (its pulse outputs) are recorded as they are, if a pattern names them and
// there is a WireTap.
#pragma once

#include <functional>
#include <memory>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/wave_sink.hpp>
#include <string>
#include <vector>

namespace motionrack::rack {

/// Makes pins that are driven on demand worth driving: listens to all of them, and wants those that are followed.
class WireTap final : public sim::Device {
  public:
    /// Before the rack is started and after everything else was built.
    explicit WireTap(sim::Kernel& kernel);
    /// Counted: a wire is wanted until each of its followers has left it.
    void follow(sim::WireId wire, bool wanted);
    void on_scheduled(Instant) override {}

  private:
    sim::Kernel& kernel_;
    sim::DeviceId id_;
    std::vector<int> followers_;  ///< of each wire of the kernel
};

struct WaveSettings {
    std::string path;
    WaveFormat format = WaveFormat::vcd;
    std::vector<std::string> signals;  ///< patterns with * and ?, over full names ("X.step", "motion.xlmtp");
                                       ///< empty: all but the pins driven on demand
    /// Unit of a VCD file's time; 0: the coarsest that shows every edge of the signals: 100 ns, or that of the bus
    /// whose lines are among them (10 ns at most).
    Duration unit{0};
    Duration register_period = milliseconds(1);  ///< how often LP and EP are looked at
    WireTap* tap = nullptr;                      ///< pins driven on demand are recorded through it
    std::string version = {};                    ///< of the program that records; stands in files of HDF5
    /// Makes what takes the changes, instead of the file; may be empty.
    std::function<std::unique_ptr<WaveSink>(const std::vector<WaveSignal>& signals)> sink = {};
};

class WaveRecorder final : public sim::Device, public sim::Kernel::WireObserver {
  public:
    /// Before the rack is started it becomes a device that looks at the registers by itself after begin(); in a running
    /// rack its owner calls look(). Errors: io; refused (the unit); invalid_input if no signal fits the patterns. The
    /// rack is as it was then.
    static Result<std::unique_ptr<WaveRecorder>> create(Rack& rack, const WaveSettings& settings);
    ~WaveRecorder() override;

    /// After the rack was started, if the recorder was made before that.
    void begin();
    /// Between runs: looks at the registers.
    void look() { look_at_cards(rack_.kernel().now()); }
    /// Between runs: writes what has come together.
    void drain();
    /// Between runs: the same but for the last microseconds, of which more may come: the file does not depend on when
    /// this is called.
    void drain_settled();
    /// Ends the file and listens no more. Errors: io; it goes on then, so that it can be tried again.
    Result<void> finish();
    /// The last finish() failed.
    bool failed() const { return failed_; }
    /// Whether finish() may be tried again then.
    bool can_end_again() const { return sink_->can_end_again(); }
    std::uint64_t changes() const { return changes_; }
    Duration register_period() const { return register_period_; }

    void on_scheduled(Instant now) override;
    void wire_changed(sim::WireId wire, int level, Instant now) override;

  private:
    struct Event {
        Instant at{};
        std::uint32_t signal = 0;
        std::uint32_t place = 0;  ///< among the events of its instant
        std::int64_t value = 0;
    };
    /// Edges are handed over some time later, so their place is by their signals; wires come before them, as they
    /// changed. Both tracks of an encoder have the place of the first: where it turns by many counts at one instant,
    /// their edges keep their order.
    std::uint32_t place_of(std::size_t signal) const {
        return wires_begin_ <= signal && signal < wires_end_ ? 0 : static_cast<std::uint32_t>(signal + 1);
    }
    /// Hears the pulses of one axis.
    class StepEar;
    /// Hears the encoder of one axis.
    class LineEar;
    /// LP (or EP) of a channel.
    struct Counter {
        Card* card = nullptr;
        int channel = 0;
        bool encoder = false;
        std::size_t signal = 0;
        std::int64_t value() const;
    };

    WaveRecorder(Rack& rack, const WaveSettings& settings);
    bool wanted(const std::string& name) const;
    /// The first of its names that is wanted, or nullptr.
    const std::string* wanted_name(sim::WireId wire) const;
    std::size_t add(WaveSignal signal);
    Duration coarsest_unit() const;
    void choose_axes();
    void choose_wires();
    void choose_counters();
    void listen();
    void stop_listening();
    void push(Instant at, std::size_t signal, std::int64_t value) { push(at, signal, value, place_of(signal)); }
    void push(Instant at, std::size_t signal, std::int64_t value, std::uint32_t place);
    void look_at_cards(Instant now);
    void write_before(Instant end);

    static constexpr std::size_t buffer_size = 1 << 21;

    Rack& rack_;
    std::vector<std::string> patterns_;
    WireTap* tap_;
    Duration register_period_;
    Duration lag_{0};  // so much later an edge may come
    sim::DeviceId id_{};
    bool is_device_ = false;
    bool recording_ = false;
    bool failed_ = false;
    std::vector<WaveSignal> signals_;
    std::unique_ptr<WaveSink> sink_;
    std::size_t wires_begin_ = 0, wires_end_ = 0;  // the signals that are wires of the kernel
    std::vector<std::int64_t> wire_signals_;       // signal of each kernel wire, -1: not recorded
    std::vector<std::unique_ptr<StepEar>> steps_;
    std::vector<std::unique_ptr<LineEar>> lines_;
    std::vector<std::pair<EdgeFanout*, sim::EdgeListener*>> heard_;  ///< which ear listens to which edges
    std::vector<sim::WireId> followed_;
    std::vector<Counter> counters_;
    std::vector<Event> buffer_;
    std::uint64_t changes_ = 0;
    std::uint64_t lost_ = 0;
    Instant last_{};
};

}  // namespace motionrack::rack
