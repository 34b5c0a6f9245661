// Channels of a recorder, and the sinks that receive their changes.
//
//   Recorder ──Declaration──► SinkMaker ──► ChangeSink ◄── change, change, ... settle ... close ── Recorder
//
// A sink runs between the runs of the kernel: it may allocate and write.
#pragma once

#include <bit>
#include <cstdint>
#include <functional>
#include <memory>
#include <motionrack/base/result.hpp>
#include <motionrack/base/time.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

enum class ChannelKind : std::uint8_t {
    level,    ///< 0 or 1
    number,   ///< a voltage, a word of a bus
    counter,  ///< a position counter of a card, sampled
    steps,    ///< motor pulses: each change is a pulse, +1 or -1
    counts,   ///< an encoder: each change is a count, its value the new count
    quantity  ///< sampled: a change's value is the bits of a double
};

/// A recorded source of values: a wire, a pulse line, a counter.
struct Channel {
    std::string name;  ///< "X.step", "motion.xlmtp", "estop"
    ChannelKind kind = ChannelKind::level;
    std::string_view unit = {};  ///< "V", "step", "count"; empty: none
    double scale = 1;            ///< value in `unit` = change's value times this
    std::int64_t initial = 0;    ///< value at the start of the recording

    bool is_level() const { return kind == ChannelKind::level; }
    bool is_wire() const { return is_level() || kind == ChannelKind::number; }
    /// Returns "X" for "X.step", "rack" for "estop".
    std::string scope() const { return dot() == std::string::npos ? "rack" : name.substr(0, dot()); }
    /// Returns "step" for "X.step", "estop" for "estop".
    std::string short_name() const { return dot() == std::string::npos ? name : name.substr(dot() + 1); }
    /// Returns true if shown() returns a change's value as it is.
    bool is_exact() const { return kind != ChannelKind::quantity && scale == 1; }
    /// Converts a change's value to `unit`; whole numbers stay exact.
    double shown(std::int64_t value) const {
        return kind == ChannelKind::quantity ? std::bit_cast<double>(value) : static_cast<double>(value) * scale;
    }

  private:
    std::size_t dot() const { return name.find('.'); }
};

class ChangeSink {
  public:
    virtual ~ChangeSink() = default;
    /// Receives a new value of channel `index`. `at` is not earlier than the previous one; with
    /// RecorderSettings::events, than the previous one of the same channel.
    virtual void change(std::size_t index, std::int64_t value, Instant at) = 0;
    /// Notifies the sink that all changes up to `at` were handed over.
    virtual void settle(Instant at) { (void)at; }
    /// Ends the recording at `end`. Errors: io, the first error.
    virtual Result<void> close(Instant end) { return (void)end, Result<void>(); }
    /// Returns true if close() may be retried after an error, with further changes before it; else the recording has
    /// ended.
    virtual bool can_end_again() const { return true; }
};

/// Channels and time base of a recording, for the maker of its sink.
struct Declaration {
    std::vector<Channel> channels;
    Instant start{};
    Duration edge_unit = nanoseconds(100);  ///< the coarsest unit, a power of ten, that shows every edge that cards and
                                            ///< parts drive
    std::string rack_name;
};

/// Makes the sink of a recording. Errors: those of the sink; then nothing is recorded.
using SinkMaker = std::function<Result<std::shared_ptr<ChangeSink>>(const Declaration& declared)>;

}  // namespace motionrack::rack
