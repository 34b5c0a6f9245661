// Scope of the rack: wires with every edge, numbers as periodic samples, from before a trigger until after it.
//
//   wires, every edge ─────────┐
//   numbers, every period ─────┴─► Recorder ──slice──► edges, samples ── trigger ──► ScopeCapture, shared, immutable
//
//   idle ──arm──► armed ──trigger──► triggered ──length is full──► done (single), armed again (run)
//
// Memory is bounded: each slice forgets the data that are too old for a capture.
#pragma once

#include <deque>
#include <memory>
#include <motionrack/operate/machine.hpp>
#include <motionrack/panel/channel_registry.hpp>
#include <motionrack/rack/recorder.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace motionrack::panel {

enum class TriggerEdge : std::uint8_t { rise, fall, either };
enum class ScopeState : std::uint8_t { idle, armed, triggered, done };
std::string_view name_of(ScopeState state);

struct ScopeSettings {
    std::vector<std::string> channels;  ///< 1 .. max_channels
    std::string trigger;                ///< one of the channels; empty: immediately
    TriggerEdge edge = TriggerEdge::rise;
    double level = 0.5;
    Duration period = microseconds(100);  ///< sampling period of the numbers
    Duration length = milliseconds(100);  ///< total length of a capture
    Duration pre = milliseconds(10);      ///< part of it before the trigger
    bool again = false;                   ///< run mode: armed again after each capture
};

/// Trace of a channel.
struct ScopeTrace {
    std::string name, unit;
    bool edges = false;             ///< true: every change; false: samples
    double before = 0;              ///< edges only: level at the start of the capture
    std::vector<double> at, value;  ///< `at`: s from the trigger; empty for samples
};

struct ScopeCapture {
    std::int64_t number = 0;                  ///< starts at 1
    double trigger_s = 0;                     ///< virtual time
    double from_s = 0, to_s = 0;              ///< relative to the trigger
    double first_sample_s = 0, period_s = 0;  ///< numbers only; relative to the trigger
    bool full = false;                        ///< more edges than fit; the latest are left out
    std::vector<ScopeTrace> traces;           ///< in the order of the settings
};
nlohmann::json to_json(const ScopeCapture& capture);

class Scope {
  public:
    static constexpr std::size_t max_channels = 16, max_samples = 20'000, max_edges = 100'000;

    Scope(operate::Machine& machine, ChannelRegistry& channels);
    ~Scope();

    /// Arms the scope. Errors: invalid_input for an unknown channel or a trigger outside the channels; refused for more
    /// than max_samples.
    Result<void> arm(const ScopeSettings& settings);
    void stop();
    /// Call every slice of a running machine.
    void slice(Instant now);

    ScopeState state() const { return state_; }
    const ScopeSettings& settings() const { return settings_; }
    /// Last capture; nullptr: none.
    std::shared_ptr<const ScopeCapture> capture() const { return capture_; }

  private:
    class Sink;
    struct ScopeEdge {
        Instant at{};
        std::size_t channel = 0;
        double value = 0;
    };
    struct NumericChannel {
        const LiveChannel* channel = nullptr;
        std::size_t place = 0;  ///< index in the settings' list
        double slow = 0;        ///< value at the last slice, for a channel that can be read only then
        Instant first = {};     ///< instant of the oldest sample
        std::deque<double> samples = {};

        double value() const { return channel->reader == ChannelReader::anytime ? channel->read() : slow; }
    };

    Result<void> record(const std::vector<std::string>& wires);
    void look_at(Instant at, double before, double value);
    void see_edge(Instant at, std::size_t place, double value);
    void see_sample(Instant at, NumericChannel& number, double value);
    void forget_old(Instant now);
    void finish();
    void restart(Instant now);
    void detach();

    operate::Machine& machine_;
    ChannelRegistry& book_;
    ScopeSettings settings_;
    ScopeState state_ = ScopeState::idle;
    std::unique_ptr<rack::Recorder> recorder_;
    // wires
    std::vector<std::size_t> places_;  ///< settings index of each recorded wire; npos: not selected
    std::vector<double> base_;         ///< levels before the oldest stored edge
    std::deque<ScopeEdge> edges_;
    bool full_ = false;
    std::vector<NumericChannel> numbers_;  ///< the last channels of the recorder
    // trigger state
    std::size_t trigger_place_ = 0;
    std::optional<double> last_value_;
    Instant armed_at_{}, triggered_at_ = never;
    std::int64_t captures_ = 0;
    std::shared_ptr<const ScopeCapture> capture_;
};

}  // namespace motionrack::panel
