// Drilling, tapping and boring cycles G73, G74, G81 .. G86, G89: the moves of one line, made one by one in constant
// memory.
#pragma once

#include <cstdint>
#include <motionrack/control/gcode/canon_call.hpp>
#include <span>

namespace motionrack::control::gcode {

/// Return true if a G code in tenths is a drilling cycle, and a drilling cycle that pecks.
inline bool is_cycle(std::int16_t code) {
    return code >= 810 || code == 730 || code == 740;
}
inline bool is_pecking(std::int16_t code) {
    return code == 830 || code == 730;
}

/// A cycle in machine coordinates. Moves of a hole (third axis drawn downwards, T rapid, F feed):
///
///     level --T--> over the hole
///       |T                                   G83: after every `peck`
///       r ----------------.        .----     back to r and to `clearance` above the last depth
///       |F                |T       |
///     bottom  ---------------- clear (r or the level before the first hole)
///
/// At the bottom: G73 G81 G83 T to clear (G73 retracts only by the clearance between pecks, not to r); G82 dwells, T to
/// clear; G85 F to r, T to clear; G86 dwells, stops the spindle, T to clear, starts it; G89 dwells, F to clear; G74 G84
/// stop the spindle, reverse it, dwell, F to clear, stop it, restart it as before.
struct DrillCycle {
    std::int16_t code = 810;         ///< G code in tenths
    Spindle spindle = Spindle::off;  ///< spindle state before the cycle
    double speed_rpm = 0;
    std::uint8_t first = 0;  ///< first axis of the plane, 0 .. 2
    std::uint8_t second = 1;
    std::uint8_t third = 2;    ///< drilling axis, 0 .. 2
    std::int32_t repeats = 1;  ///< number of holes, >= 1
    double step_first = 0;     ///< distance between holes, also before the first one, mm
    double step_second = 0;
    double level = 0;  ///< position of the drilling axis before the first hole, mm
    double r = 0;
    double clear = 0;
    double bottom = 0;
    double peck = 0;  ///< depth of one peck, mm, > 0 for G73 and G83
    double clearance = 0;
    double seconds = 0;  ///< duration of the dwell at the bottom, s
    Move pattern = {};   ///< feed rate, path control, line; end: first hole less one step
    Point from = {};     ///< current position
};

class DrillCycleMoves {
  public:
    void begin(const DrillCycle& plan);

    /// Returns the next move or spindle event; false after the last one.
    bool next(CanonCall& step);

  private:
    enum class DrillPhase : std::uint8_t { lift, over, approach, work, back, again, leave };
    enum class Act : std::uint8_t { wait, stop, turn_back, turn, feed_r, feed_clear, rapid_clear };

    static std::span<const Act> acts_of(std::int16_t code);
    void straight(CanonCall& step, MoveKind kind, double third);
    void spindle(CanonCall& step, Spindle how) const;
    void act(Act what, CanonCall& step);

    DrillCycle plan_;
    DrillPhase phase_ = DrillPhase::lift;
    Point at_ = {};
    double level_ = 0;
    std::int32_t hole_ = 0;
    std::int32_t pecks_ = 0;
    std::size_t acts_ = 0;  ///< completed acts at the bottom of the hole
};

}  // namespace motionrack::control::gcode
