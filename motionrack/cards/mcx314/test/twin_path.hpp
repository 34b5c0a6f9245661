// The twin's lines and arcs, one basic pulse at a time, by incremental decisions: a Bresenham error for lines, the
// midpoint's sign for arcs. No square root, no division, no state but the last point.
//
//          2 | 1           the eight octants, counter-clockwise from +AX1; clockwise arcs are drawn with the
//        3 \ | / 0         second axis negated
//        ----+----  AX1
//        4 / | \ 7
//          5 | 6
#pragma once

#include <array>
#include <cstdint>

namespace motionrack::mcx314::twin {

/// Parameters of an interpolation command: the axes, their finish points and the centre, all in pulses from the start
/// point.
struct Segment {
    enum class Kind : std::uint8_t { line, arc_cw, arc_ccw, pattern };
    enum Steps : std::uint8_t { by_wire = 1, by_command = 2 };
    Kind kind = Kind::line;
    int count = 2;              ///< axes: 2 or 3
    std::array<int, 3> axis{};  ///< axis number of AX1, AX2, AX3
    int constant_speed = 0;     ///< WR5.LSPD
    int steps = 0;              ///< WR5.EXPLS, CMPLS
    std::array<std::int64_t, 3> finish{};
    std::array<std::int64_t, 2> centre{};

    unsigned mask() const;
    bool names_an_axis_twice() const;
};

/// State of one segment.
class Path {
  public:
    void begin(const Segment& segment);
    /// Executes one basic pulse of a line or an arc; sets `step[i]` to -1, 0 or +1 for AX(i+1).
    void step(std::array<int, 3>& step);
    bool finished() const { return finished_; }
    /// Returns the remaining basic pulses of a line.
    std::int64_t left() const { return max_pulses_ - n_; }
    std::int64_t done() const { return n_; }
    bool is_line() const { return segment_.kind == Segment::Kind::line; }
    bool is_pattern() const { return segment_.kind == Segment::Kind::pattern; }
    bool is_arc() const { return !is_line() && !is_pattern(); }
    const Segment& segment() const { return segment_; }
    /// Returns the value of RR0.ZONE, 0..7.
    int zone() const;
    /// Returns the direction of AX(i+1): the sign of its finish point, in an arc that of the present octant; 0: it is
    /// stationary.
    int direction(int i) const;

  private:
    void begin_arc();
    void step_line(std::array<int, 3>& step);
    void step_arc(std::array<int, 3>& step);
    bool past_finish() const;

    Segment segment_;
    std::int64_t n_ = 0;
    bool finished_ = true;
    // Lines: the error of each axis, in units of 1 / (2 max_pulses_) pulse.
    std::int64_t max_pulses_ = 0;
    std::array<std::int64_t, 3> error_{};
    // Arcs, relative to the centre and counter-clockwise: the point, the finish, and x^2 + y^2 - r^2 at the point.
    std::array<std::int64_t, 2> at_{};
    std::array<std::int64_t, 2> finish_{};
    std::int64_t outside_ = 0;
    int octant_ = 0;
    int finish_octant_ = 0;
    bool lap_ = false;
};

}  // namespace motionrack::mcx314::twin
