// Records wires, pulses, encoder lines and card values of a running rack into a sink while it runs.
//
//   kernel wires ──┐
//   pulse edges ───┼──► changes in a buffer ──drain(), between runs──► ChangeSink (VCD, CSV, HDF5)
//   encoder edges ─┤
//   LP, EP ────────┘ sampled every period
//
// The changes come in order of time; those of `events` only within each channel.
//
// A pulse of X.step lasts half the interval to the next one, at most 5 us. X.dir changes 250 ns before the first pulse
// in the new direction. Pins that the card drives on demand (its pulse outputs) are recorded directly if a pattern
// names them and a RecorderTap exists.
#pragma once

#include <functional>
#include <memory>
#include <motionrack/rack/change_sink.hpp>
#include <motionrack/rack/rack.hpp>
#include <string>
#include <utility>
#include <vector>

namespace motionrack::rack {

/// The recorders' device in a rack: drives the on-demand pins that they follow, and lets one of them sample.
class RecorderTap final : public sim::Device {
  public:
    /// Call before the rack starts and after everything else is built.
    explicit RecorderTap(sim::Kernel& kernel);
    /// Adds or removes a follower; a wire stays subscribed while it has followers.
    void follow(sim::WireId wire, bool wanted);
    /// Lets `sampler` act at the instants that are scheduled for the returned device; nullptr: none acts. Nothing is
    /// scheduled at first.
    sim::DeviceId lend(sim::Device* sampler);
    void on_scheduled(Instant now) override {
        if (sampler_ != nullptr) sampler_->on_scheduled(now);
    }

  private:
    sim::Kernel& kernel_;
    sim::DeviceId id_;
    std::vector<int> followers_;  ///< follower count of each kernel wire
    sim::Device* sampler_ = nullptr;
};

/// A channel that a function reads.
struct SampledChannel {
    Channel channel;
    std::function<std::int64_t()> read;
};

struct RecorderSettings {
    std::vector<std::string> signals;   ///< patterns with * and ?, over full names ("X.step", "motion.xlmtp"); empty:
                                        ///< all except pins driven on demand, or none beside `sampled`
    Duration period = milliseconds(1);  ///< sampling period of counters and `sampled`
    RecorderTap* tap = nullptr;         ///< source of pins driven on demand
    SinkMaker sink = {};                ///< must not be empty
    /// Pulses and counts are handed over as they are (X.steps, X.encoder), in order of time within each channel; else
    /// as levels of lines (X.step, X.dir, X.enc_a, X.enc_b), in order of time over all channels.
    bool events = false;
    std::vector<SampledChannel> sampled = {};  ///< further channels; within a run, reading them must neither allocate
                                               ///< nor change anything
    bool breaks = false;                       ///< a sample ends the run of the kernel, and poll_due() takes it
};

class Recorder final : public sim::Device, public sim::Kernel::WireObserver {
  public:
    /// Before the rack starts: creates a device that samples by itself after begin(). In a running rack, the settings'
    /// tap does so after begin(), for one recorder at a time; without begin(), the owner calls poll(). Errors: those of
    /// the sink; invalid_input if no signal matches the patterns. On error the rack is unchanged.
    static Result<std::unique_ptr<Recorder>> create(Rack& rack, const RecorderSettings& settings);
    ~Recorder() override;

    /// Samples each period from `after` this instant on. Call after the rack has started.
    void begin(Duration after = {});
    /// Takes a sample. Call between runs.
    void poll() { sample(rack_.kernel().now()); }
    /// Takes the sample that ended the run, if any. Call between runs.
    void poll_due() {
        if (std::exchange(due_, false)) poll();
    }
    /// Hands the buffered changes to the sink. Call between runs.
    void drain() { hand_over(never); }
    /// Hands over the buffered changes except those of the last microseconds, which may be incomplete. The recording
    /// does not depend on the instants of the calls. Call between runs.
    void drain_settled() { hand_over(rack_.kernel().now() - lag_); }
    /// Ends the recording and stops listening. Errors: io; if can_end_again(), the recording continues, so that
    /// finish() can be retried.
    Result<void> finish();
    /// Returns true if the last finish() failed.
    bool failed() const { return failed_; }
    /// Returns true if finish() may be retried after a failure.
    bool can_end_again() const { return !closed_ && sink_->can_end_again(); }
    /// Returns true if the recording is complete, apart from omitted changes.
    bool is_closed() const { return closed_; }
    Duration period() const { return period_; }

    void on_scheduled(Instant now) override;
    void wire_changed(sim::WireId wire, int level, Instant now) override;

  private:
    struct BufferedChange {
        Instant at{};
        std::uint32_t channel = 0;
        std::uint32_t place = 0;  ///< order among the changes of its instant
        std::int64_t value = 0;
    };
    /// Edges are delivered with a delay, so their order follows their signals; wires precede them in the order of their
    /// changes. Both tracks of an encoder share the place of the first. If it moves by many counts at one instant, its
    /// edges keep their order.
    std::uint32_t place_of(std::size_t channel) const {
        return wires_begin_ <= channel && channel < wires_end_ ? 0 : static_cast<std::uint32_t>(channel + 1);
    }
    /// Listens to the pulses of one axis.
    class StepListener;
    /// Listens to the encoder of one axis.
    class LineListener;
    /// Listens to the pulses or the encoder of one axis, whose edges stay events.
    class EventListener;

    Recorder(Rack& rack, const RecorderSettings& settings);
    bool wanted(const std::string& name) const;
    /// Returns the first of the wire's names that a pattern selects, or nullptr.
    const std::string* wanted_name(sim::WireId wire) const;
    std::size_t add(Channel channel);
    void add_sampled(SampledChannel one);
    Duration edge_unit() const;
    void choose_axes();
    void choose_pulses(RunningAxis& axis);
    void choose_encoder(RunningAxis& axis);
    void choose_wires();
    void choose_counters();
    void reserve_buffer();
    void listen();
    void stop_listening();
    void push(Instant at, std::size_t channel, std::int64_t value) { push(at, channel, value, place_of(channel)); }
    void push(Instant at, std::size_t channel, std::int64_t value, std::uint32_t place);
    void sample(Instant now);
    std::vector<BufferedChange>::iterator order_before(Instant end);
    void hand_over(Instant end);

    // Changes, 24 bytes each. A run breaks when the buffer is half full; half the samples exceed those of one slice.
    static constexpr std::size_t max_buffered = 1 << 21, max_samples_buffered = 1 << 16;

    Rack& rack_;
    std::vector<std::string> patterns_;
    RecorderTap* tap_;
    Duration period_;
    bool events_, breaks_;
    bool wants_all_;   ///< no pattern limits the selection
    Duration lag_{0};  // maximum delay of an edge
    sim::DeviceId id_{};
    bool is_device_ = false, borrows_device_ = false;
    bool due_ = false;
    bool recording_ = false;
    bool failed_ = false, closed_ = false;
    Declaration declared_;
    std::shared_ptr<ChangeSink> sink_;
    std::size_t wires_begin_ = 0, wires_end_ = 0;  // range of the channels that are kernel wires
    std::vector<std::int64_t> wire_channels_;      // channel of each kernel wire, -1: not recorded
    std::vector<std::unique_ptr<StepListener>> steps_;
    std::vector<std::unique_ptr<sim::EdgeListener>> others_;
    std::vector<std::pair<EdgeFanout*, sim::EdgeListener*>> heard_;  ///< listeners and the fanouts they belong to
    std::vector<sim::WireId> followed_;
    std::vector<std::pair<std::size_t, std::function<std::int64_t()>>> sampled_;  ///< channels and their readings
    std::vector<BufferedChange> buffer_;
    std::size_t buffer_size_ = 0;
    std::uint64_t lost_ = 0;
    Instant last_{};
};

}  // namespace motionrack::rack
