// Records wires, pulses, encoder lines and card values of a running rack to a file while it runs.
//
//   kernel wires ──┐
//   pulse edges ───┼──► events in a buffer ──drain(), between runs, in order of time──► WaveSink (VCD, CSV, HDF5)
//   encoder edges ─┤
//   LP, EP ────────┘ sampled every register_period
//
// A pulse of X.step lasts half the interval to the next one, at most 5 us. X.dir changes 250 ns before the first pulse
// in the new direction. Pins that the card drives on demand (its pulse outputs) are recorded directly if a pattern
// names them and a WireTap exists.
#pragma once

#include <functional>
#include <memory>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/wave_sink.hpp>
#include <string>
#include <vector>

namespace motionrack::rack {

/// Drives on-demand pins: subscribes to the wires that have followers.
class WireTap final : public sim::Device {
  public:
    /// Call before the rack starts and after everything else is built.
    explicit WireTap(sim::Kernel& kernel);
    /// Adds or removes a follower; a wire stays subscribed while it has followers.
    void follow(sim::WireId wire, bool wanted);
    void on_scheduled(Instant) override {}

  private:
    sim::Kernel& kernel_;
    sim::DeviceId id_;
    std::vector<int> followers_;  ///< follower count of each kernel wire
};

struct WaveSettings {
    std::string path;
    WaveFormat format = WaveFormat::vcd;
    std::vector<std::string> signals;  ///< patterns with * and ?, over full names ("X.step", "motion.xlmtp"); empty:
                                       ///< all except pins driven on demand
    /// Time unit of a VCD file. 0: the coarsest unit that shows every edge that cards and parts drive: 100 ns, or less
    /// where lines of a bus (10 ns at most) or of a scale with a high count rate are recorded. Wires forced from
    /// outside at shorter intervals need a finer unit.
    Duration unit{0};
    Duration register_period = milliseconds(1);  ///< sampling period of LP and EP
    WireTap* tap = nullptr;                      ///< source of pins driven on demand
    std::string version = {};                    ///< version of the recording program, stored in HDF5 files
    /// Creates a sink that replaces the file; may be empty.
    std::function<std::unique_ptr<WaveSink>(const std::vector<WaveSignal>& signals)> sink = {};
};

class WaveRecorder final : public sim::Device, public sim::Kernel::WireObserver {
  public:
    /// Before the rack starts: creates a device that samples the registers by itself after begin(). In a running rack:
    /// its owner calls poll(). Errors: io; refused (the unit); invalid_input if no signal matches the patterns. On
    /// error the rack is unchanged.
    static Result<std::unique_ptr<WaveRecorder>> create(Rack& rack, const WaveSettings& settings);
    ~WaveRecorder() override;

    /// Call after the rack has started, if the recorder was created before that.
    void begin();
    /// Samples the registers. Call between runs.
    void poll() { look_at_cards(rack_.kernel().now()); }
    /// Writes the buffered changes. Call between runs.
    void drain();
    /// Writes the buffered changes except those of the last microseconds, which may be incomplete. The file does not
    /// depend on the instants of the calls. Call between runs.
    void drain_settled();
    /// Ends the file and stops listening. Errors: io; the recording then continues, so that finish() can be retried.
    Result<void> finish();
    /// Returns true if the last finish() failed.
    bool failed() const { return failed_; }
    /// Returns true if finish() may be retried after a failure.
    bool can_end_again() const { return sink_->can_end_again(); }
    std::uint64_t changes() const { return changes_; }
    Duration register_period() const { return register_period_; }

    void on_scheduled(Instant now) override;
    void wire_changed(sim::WireId wire, int level, Instant now) override;

  private:
    struct WaveEvent {
        Instant at{};
        std::uint32_t signal = 0;
        std::uint32_t place = 0;  ///< order among the events of its instant
        std::int64_t value = 0;
    };
    /// Edges are delivered with a delay, so their order follows their signals; wires precede them in the order of their
    /// changes. Both tracks of an encoder share the place of the first. If it moves by many counts at one instant, its
    /// edges keep their order.
    std::uint32_t place_of(std::size_t signal) const {
        return wires_begin_ <= signal && signal < wires_end_ ? 0 : static_cast<std::uint32_t>(signal + 1);
    }
    /// Listens to the pulses of one axis.
    class StepListener;
    /// Listens to the encoder of one axis.
    class LineListener;
    /// LP or EP of a channel.
    struct RecordedCounter {
        Card* card = nullptr;
        int channel = 0;
        bool encoder = false;
        std::size_t signal = 0;
        std::int64_t value() const;
    };

    WaveRecorder(Rack& rack, const WaveSettings& settings);
    bool wanted(const std::string& name) const;
    /// Returns the first of the wire's names that a pattern selects, or nullptr.
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
    Duration lag_{0};  // maximum delay of an edge
    sim::DeviceId id_{};
    bool is_device_ = false;
    bool recording_ = false;
    bool failed_ = false;
    std::vector<WaveSignal> signals_;
    std::unique_ptr<WaveSink> sink_;
    std::size_t wires_begin_ = 0, wires_end_ = 0;  // range of the signals that are kernel wires
    std::vector<std::int64_t> wire_signals_;       // signal of each kernel wire, -1: not recorded
    std::vector<std::unique_ptr<StepListener>> steps_;
    std::vector<std::unique_ptr<LineListener>> lines_;
    std::vector<std::pair<EdgeFanout*, sim::EdgeListener*>> heard_;  ///< listeners and the fanouts they belong to
    std::vector<sim::WireId> followed_;
    std::vector<RecordedCounter> counters_;
    std::vector<WaveEvent> buffer_;
    std::uint64_t changes_ = 0;
    std::uint64_t lost_ = 0;
    Instant last_{};
};

}  // namespace motionrack::rack
