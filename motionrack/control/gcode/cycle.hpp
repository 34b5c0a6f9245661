// Drilling cycles G81, G82, G83: the moves of one line, made one after the other in constant memory.
#pragma once

#include <cstdint>
#include <motionrack/control/move.hpp>

namespace motionrack::control::gcode {

/// A cycle, all in machine coordinates. Per hole (third axis drawn downwards, T rapid, F feed):
///
///     level --T--> over the hole
///       |T                                   G83: after every `peck`
///       r ----------------.        .----     back to r and to `clearance` above the last depth
///       |F                |T       |
///     bottom  (G82 waits) '--- clear (r or the level before the first hole)
struct CyclePlan {
    std::int16_t code = 810;  ///< in tenths: 810, 820, 830
    std::uint8_t first = 0;   ///< axes of the plane
    std::uint8_t second = 1;
    std::uint8_t third = 2;    ///< axis that drills
    std::int32_t repeats = 1;  ///< holes, >= 1
    double step_first = 0;     ///< from hole to hole, mm; also before the first
    double step_second = 0;
    double level = 0;  ///< of the third axis before the first hole
    double r = 0;
    double clear = 0;
    double bottom = 0;
    double peck = 0;  ///< depth of one peck, > 0 for G83
    double clearance = 0;
    double seconds = 0;  ///< wait at the bottom, G82
    Move pattern = {};   ///< feed, path control, line; end: where the first hole is, less the steps
    Point from = {};     ///< where the machine is
};

class Cycle {
  public:
    void begin(const CyclePlan& plan);

    /// The next move; false: there is none.
    bool next(Move& move);

  private:
    enum class Phase : std::uint8_t { lift, over, approach, work, wait, back, again, leave };

    void straight(Move& move, MoveKind kind, double third);

    CyclePlan plan_;
    Phase phase_ = Phase::lift;
    Point at_ = {};
    double level_ = 0;
    std::int32_t hole_ = 0;
    std::int32_t pecks_ = 0;
};

}  // namespace motionrack::control::gcode
