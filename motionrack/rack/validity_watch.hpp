// Validity of the positions of a rack's axes: one rule for part programs and for operated machines.
//
//   a motor lost steps, was pushed or blocked ───────────────────► invalid, until the axis is homed or its position set
//   an axis that positions by itself has lost its position ──────► invalid
//   a card's encoder counter is off from the motor's rotation ───► reported; the pulses that drive the axis are right
//   a following error above its warning limit ───────────────────► reported; above its alarm limit by the stop latch
//   a stage's card opened its loop ──────────────────────────────► reported
#pragma once

#include <cstdint>
#include <motionrack/base/time.hpp>
#include <motionrack/rack/rack.hpp>
#include <motionrack/sim/kernel.hpp>
#include <string>
#include <vector>

namespace motionrack::rack {

/// A problem with the position of an axis, or with a stage.
struct ValidityFinding {
    static constexpr std::size_t no_axis = ~std::size_t{0};
    std::size_t axis = 0;  ///< index in Rack::axes(); no_axis: a stage whose loop was opened
    Instant at{};
    std::string text;            ///< without a full stop
    bool lost = false;           ///< the position is not valid
    bool follows_badly = false;  ///< a following error above its warning limit
};

class ValidityWatch {
  public:
    /// Call at the start of a rack; encoder counts are correct at that instant.
    explicit ValidityWatch(Rack& rack);
    /// Step loss of an axis up to an instant.
    struct Mark {
        Instant at{};  ///< earlier events are ignored
        std::int64_t lost_pulses = 0;
        std::int64_t turned = 0;  ///< counts of the encoder of a servo
    };
    Mark mark(std::size_t axis) const { return {rack_.kernel().now(), lost_pulses(axis), turned(axis)}; }
    /// Returns the travel of a servo since `mark`, mm or degrees. It is 0 for other axes, which have pulses to lose.
    double moved_since(std::size_t axis, const Mark& mark) const;
    /// Takes the position of an axis as correct at `from`, after homing or setting it. The next poll() reports any loss
    /// since then.
    void begin(std::size_t axis, const Mark& from);
    /// Returns the findings since the last call, each once until begin(). `is_stationary`: nothing moves, so that
    /// counters and rotors can be compared and axes queried.
    std::vector<ValidityFinding> poll(bool is_stationary);
    /// Returns false if an axis that positions by itself has lost its position; sets the position of other axes. Call
    /// at standstill.
    bool knows_itself(std::size_t axis);

  private:
    struct AxisWatch {
        Mark from{Instant{-1}};
        std::int64_t counted_wrongly = 0;  ///< count error at the start
        bool counted = false;              ///< the card counts the encoder separately from the pulses
        bool lost = false, reported_counts = false;
    };
    bool is_counted(std::size_t axis) const;
    std::int64_t lost_pulses(std::size_t axis) const;
    std::int64_t turned(std::size_t axis) const;
    std::int64_t counted_wrongly(std::size_t axis) const;
    void lose(std::size_t axis, Instant at, std::string text, std::vector<ValidityFinding>& out);
    void look_at_conditions(std::vector<ValidityFinding>& out);
    void look_at(const sim::Condition& condition, std::vector<ValidityFinding>& out);
    void look_for_lost(std::size_t axis, const sim::Condition& condition, std::vector<ValidityFinding>& out);
    void compare(std::size_t axis, std::vector<ValidityFinding>& out);

    Rack& rack_;
    std::vector<AxisWatch> watched_;
    std::uint64_t seen_ = 0;              ///< conditions evaluated
    std::vector<ValidityFinding> early_;  ///< findings for the next poll()
};

}  // namespace motionrack::rack
