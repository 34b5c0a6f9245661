// Breaches: events that the controller must never cause, whatever the program is. Each is counted and reported with its
// position and instant. This check is independent: it compares the pulses sent with the program as read, not with any
// plan.
//
//   pulses of an axis    |..w..|..w..|    the change of velocity between two windows of 1 to 8 ms is limited by the
//                        q0    q1    q2   velocity step limit, the acceleration limit, and three pulses of counting
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/base/time.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

enum class BreachKind : std::uint8_t {
    jump,       ///< the velocity of an axis stepped by more than its velocity step limit
    accel,      ///< the acceleration of an axis exceeded its limit
    deviation,  ///< the machine left the programmed path by more than the tolerance
    late        ///< a path segment arrived too late, and the card stopped at its start
};

/// The largest breach of its kind and axis.
struct Breach {
    BreachKind kind = BreachKind::jump;
    int axis = -1;                        ///< 0 .. 5; -1: not a single axis
    double value = 0;                     ///< measured: mm/s or degrees/s, mm/s2 or degrees/s2, mm; late: s
    double limit = 0;                     ///< exceeded limit, in the unit of `value`
    Instant at{};                         ///< since the start of the rack
    int line = 0;                         ///< program line; 0: unknown
    std::array<double, 3> position = {};  ///< machine position, mm
    std::int64_t times = 1;               ///< number of occurrences, including this one
};

class Breaches {
  public:
    /// Adds a breach. If one of that kind and axis is stored, adds up their `times` and keeps the larger one.
    void add(const Breach& breach);
    const std::vector<Breach>& all() const { return all_; }

  private:
    std::vector<Breach> all_;
};

/// Returns "jump", "accel", "deviation" or "late".
std::string_view name_of(BreachKind kind);

/// Returns "in line 12, at 3.512000 s and X 10.000, Y 0.000, Z 80.000, the velocity step of X was 84.0 mm/s; ...".
std::string sentence_of(const Breach& breach);

/// Velocity step limit in whole pulses. Between two windows, the velocity of an axis may change by what its velocity
/// step limit and its acceleration limit allow.
struct JumpLaw {
    /// `start_hz`: velocity step limit, pulses/s. `accel_hz`: acceleration limit, pulses/s2. `period`: time between two
    /// samples; with a period above 2 ms the check is off.
    JumpLaw(double start_hz, double accel_hz, Duration period);
    static constexpr Duration max_window = milliseconds(8);

    std::size_t samples = 0;  ///< samples per window; 0: the check is off
    double seconds = 0;       ///< duration of a window
    double end_hz = 0;        ///< pulses/s: highest rate one period before a ramp ends
    /// Takes the counts at the start of the first window, at its end, and at the end of the second. Returns the
    /// pulses/s above what the acceleration limit explains, or 0 if the step is allowed.
    double jump_hz(std::int64_t first, std::int64_t middle, std::int64_t last) const;
    /// Takes one count per period, oldest first, more than `samples`. Returns the highest rate in pulses/s that these
    /// counts allow at the newest. A card may show a higher rate for a segment in which the axis makes one pulse.
    double max_hz(std::span<const std::int64_t> counts) const;

  private:
    double period_ = 0;     ///< seconds
    double accel_hz_ = 0;   ///< acceleration limit, pulses/s2
    double allowed_ = 0;    ///< pulses
    double explained_ = 0;  ///< pulses explained by the acceleration limit alone
};

/// Detects velocity steps in the pulses of one axis. Allocates only in the constructor.
class JumpWatch {
  public:
    /// Takes the arguments of JumpLaw.
    JumpWatch(double start_hz, double accel_hz, Duration period);
    struct Jump {
        double hz = 0;       ///< height of the velocity step, pulses/s; 0: no step
        bool first = false;  ///< the previous sample had no step
    };
    /// Takes the pulses sent up to now. Returns the velocity step in the middle of the two windows that end now, if too
    /// large.
    Jump sample(std::int64_t count);
    /// Returns the time from the middle of the two windows to the last sample.
    Duration middle() const { return period_ * static_cast<std::int64_t>(law_.samples); }

  private:
    JumpLaw law_;
    Duration period_;
    std::vector<std::int64_t> counts_;
    std::size_t seen_ = 0;
    bool jumps_ = false;
};

}  // namespace motionrack::rack
