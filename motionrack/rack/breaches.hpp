// What the controller must never do to a machine, whatever the program is: told with its place and its instant, and
// counted. An independent referee: it looks at the pulses that were sent and at the program as it was read, not at any
// plan.
//
//   pulses of an axis    |..w..|..w..|    the change of speed from one window of 1 to 8 ms to the next may be what the
//                        q0    q1    q2   start speed and the acceleration limit allow, and three pulses of counting
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/base/time.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

enum class BreachKind : std::uint8_t {
    jump,       ///< the speed of an axis changed at once by more than its start speed
    accel,      ///< an axis was accelerated by more than its limit
    deviation,  ///< the machine left the programmed path by more than the tolerance
    late        ///< a piece of the path came too late, and the card stopped at its start
};

/// The worst of its kind and axis.
struct Breach {
    BreachKind kind = BreachKind::jump;
    int axis = -1;                     ///< 0 .. 5; -1: no single one
    double value = 0;                  ///< mm/s or degrees/s, the same /s2, mm, s
    double limit = 0;                  ///< the same
    Instant at{};                      ///< since the rack was started
    int line = 0;                      ///< of the program; 0: not known
    std::array<double, 3> place = {};  ///< where the machine was, mm
    std::int64_t times = 1;            ///< how often, this one too
};

class Breaches {
  public:
    /// Counts one more of its kind and axis, and keeps the worse of both.
    void add(const Breach& breach);
    const std::vector<Breach>& all() const { return all_; }

  private:
    std::vector<Breach> all_;
};

/// "jump", "accel", "deviation", "late".
std::string_view name_of(BreachKind kind);

/// "in line 12, at 3.512000 s and X 10.000, Y 0.000, Z 80.000, the speed of X jumped by 84.000 mm/s; ...".
std::string sentence_of(const Breach& breach);

/// What whole pulses say of the speed of an axis: from one window to the next it may change by what its start speed and
/// its acceleration limit allow.
struct JumpLaw {
    /// `start_hz`, `accel_hz`: what the axis may be changed by at once, pulses/s, and pulses/s2. `period`: between two
    /// looks; with one above 2 ms nothing is found.
    JumpLaw(double start_hz, double accel_hz, Duration period);
    static constexpr Duration max_window = milliseconds(8);

    std::size_t looks = 0;  ///< of a window; 0: nothing is looked for
    double seconds = 0;     ///< of a window
    /// Of the counts at the begin of the first window, at its end, and at the end of the second: pulses/s above what
    /// the limit explains, or 0 if that is allowed.
    double jump_hz(std::int64_t first, std::int64_t middle, std::int64_t last) const;

  private:
    double allowed_ = 0;    ///< pulses
    double explained_ = 0;  ///< pulses that the acceleration limit alone explains
};

/// Looks for jumps in the pulses of one axis. Allocates only when it is made.
class JumpWatch {
  public:
    /// See JumpLaw.
    JumpWatch(double start_hz, double accel_hz, Duration period);
    struct Jump {
        double hz = 0;       ///< 0: none
        bool first = false;  ///< none at the look before
    };
    /// The pulses sent so far; the jump in the middle of the two windows that end now, if it is too large.
    Jump look(std::int64_t count);
    /// How long ago the middle of the windows is.
    Duration middle() const { return period_ * static_cast<std::int64_t>(law_.looks); }

  private:
    JumpLaw law_;
    Duration period_;
    std::vector<std::int64_t> counts_;
    std::size_t seen_ = 0;
    bool jumps_ = false;
};

}  // namespace motionrack::rack
