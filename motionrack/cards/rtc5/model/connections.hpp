// Objects attached to the card: a receiver of samples, a source of inputs, a listener of list starts and ends.
#pragma once

#include <cstdint>
#include <span>

namespace motionrack::rtc5 {

/// Outputs of consecutive 10 us ticks. In tick k the spot of ideal mirrors moves from the output of tick k-1 to that
/// of tick k.
struct Samples {
    std::int64_t first = 0;                            ///< tick of the first sample
    std::span<const std::int32_t> x, y;                ///< head A, bits
    std::span<const std::int32_t> x_b, y_b;            ///< head B, empty while no table is selected for it
    std::span<const std::uint8_t> laser;               ///< half-microseconds with the laser on, 0 .. 20
    std::span<const double> corrected_x, corrected_y;  ///< bits, after fly, before clipping; empty while fly is off
};

class Sink {
  public:
    virtual ~Sink() = default;
    virtual void samples(const Samples& block) = 0;
    /// Reports that the laser gate changes `half_us` half-microseconds after tick 0; called before the block with this
    /// tick.
    virtual void laser(std::int64_t half_us, bool on) { (void)half_us, (void)on; }
};

/// Inputs of the card tick by tick, if they are known in advance.
class Inputs {
  public:
    virtual ~Inputs() = default;
    /// Writes the counts (four per line period, wrapping at 32 bits) of an encoder at ticks `first`, `first` + 1, ..
    virtual void counts(int encoder, std::int64_t first, std::span<std::int32_t> out) = 0;
    /// Writes the last complete McBSP word at ticks `first`, `first` + 1, ..; returns false if the source has no words.
    virtual bool words(std::int64_t first, std::span<std::uint32_t> out) { return (void)first, (void)out, false; }
};

/// Result of an external start.
enum class StartFate : std::uint8_t {
    begun,     ///< the list began
    busy,      ///< lost: a list was running or the card was moving when the start was due
    too_many,  ///< lost on arrival: eight starts were waiting
};

/// Notified of lists that begin by an external start and of lists that end, within the tick; must not command the card.
class ListListener {
  public:
    virtual ~ListListener() = default;
    virtual void started(std::int64_t tick, StartFate fate) = 0;
    virtual void ended(std::int64_t tick) = 0;
};

/// Attached objects; not part of the card's state, so a snapshot does not contain them.
struct Connections {
    Sink* sink = nullptr;              ///< receives the samples of the present run
    Inputs* inputs = nullptr;          ///< nullptr: inputs come from BeltEncoders::set_count and McBspReceiver::receive
    ListListener* listener = nullptr;  ///< notified of list starts and ends; nullptr: none
};

}  // namespace motionrack::rtc5
