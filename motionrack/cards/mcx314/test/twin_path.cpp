// The twin's lines and arcs.
#include <algorithm>
#include <cstdlib>
#include <motionrack/cards/mcx314/test/twin_path.hpp>

namespace motionrack::mcx314::twin {

namespace {

// Stepping in octant k: the coordinate (0: x, 1: y) that steps at every pulse, its direction, and the sign of the other
// coordinate.
struct Octant {
    int short_axis, short_step, long_side;
};
constexpr std::array<Octant, 8> octants{
    {{1, +1, +1}, {0, -1, +1}, {0, -1, +1}, {1, -1, -1}, {1, -1, -1}, {0, +1, -1}, {0, +1, -1}, {1, +1, +1}}};

// Returns the direction of a coordinate in an octant, counter-clockwise: x decreases in the upper half, y in the left
// half.
constexpr int direction_in(int octant, int coordinate) {
    if (coordinate == 0) return octant < 4 ? -1 : +1;
    return octant >= 2 && octant < 6 ? -1 : +1;
}

int octant_of(std::int64_t x, std::int64_t y) {
    if (x == 0 && y == 0) return 0;
    if (y >= 0 && x > y) return 0;
    if (x > 0 && y >= x) return 1;
    if (y > 0 && x <= 0 && -x < y) return 2;
    if (y > 0 && -x >= y) return 3;
    if (x < 0 && y <= 0 && -y < -x) return 4;
    if (x < 0 && -y >= -x) return 5;
    if (y < 0 && x >= 0 && x < -y) return 6;
    return 7;
}

bool leaves(int octant, std::int64_t x, std::int64_t y) {
    switch (octant) {
        case 0:
            return y >= x;
        case 1:
            return x <= 0;
        case 2:
            return -x >= y;
        case 3:
            return y <= 0;
        case 4:
            return -y >= -x;
        case 5:
            return x >= 0;
        case 6:
            return x >= -y;
        default:
            return y >= 0;
    }
}

}  // namespace

unsigned Segment::mask() const {
    unsigned bits = 0;
    for (int i = 0; i < count; ++i) bits |= 1u << axis[i];
    return bits;
}

bool Segment::names_an_axis_twice() const {
    return axis[0] == axis[1] || (count == 3 && (axis[2] == axis[0] || axis[2] == axis[1]));
}

void Path::begin(const Segment& segment) {
    segment_ = segment;
    n_ = 0;
    if (is_pattern()) return;
    if (is_arc()) return begin_arc();
    max_pulses_ = 0;
    for (int i = 0; i < segment_.count; ++i)
        max_pulses_ = std::max<std::int64_t>(max_pulses_, std::abs(segment_.finish[i]));
    error_.fill(max_pulses_);
    finished_ = max_pulses_ == 0;
}

void Path::begin_arc() {
    const std::int64_t mirror = segment_.kind == Segment::Kind::arc_cw ? -1 : 1;
    const std::array<std::int64_t, 2> centre{segment_.centre[0], segment_.centre[1] * mirror};
    at_ = {-centre[0], -centre[1]};
    finish_ = {segment_.finish[0] - centre[0], segment_.finish[1] * mirror - centre[1]};
    outside_ = 0;
    max_pulses_ = 0;
    octant_ = octant_of(at_[0], at_[1]);
    finish_octant_ = octant_of(finish_[0], finish_[1]);
    lap_ = octant_ == finish_octant_ && past_finish();
    finished_ = at_[0] == 0 && at_[1] == 0;
}

bool Path::past_finish() const {
    const Octant& o = octants[octant_];
    return (at_[o.short_axis] - finish_[o.short_axis]) * o.short_step >= 0;
}

void Path::step(std::array<int, 3>& step) {
    step = {};
    ++n_;
    if (is_arc())
        step_arc(step);
    else
        step_line(step);
}

void Path::step_line(std::array<int, 3>& step) {
    for (int i = 0; i < segment_.count; ++i) {
        error_[i] += 2 * std::abs(segment_.finish[i]);
        if (error_[i] < 2 * max_pulses_) continue;
        error_[i] -= 2 * max_pulses_;
        step[i] = segment_.finish[i] < 0 ? -1 : +1;
    }
    finished_ = n_ == max_pulses_;
}

void Path::step_arc(std::array<int, 3>& step) {
    const Octant& o = octants[octant_];
    const int long_axis = 1 - o.short_axis;
    std::int64_t& s = at_[o.short_axis];
    outside_ += 2 * s * o.short_step + 1;
    s += o.short_step;
    step[o.short_axis] = o.short_step;

    // With m pulses on the long axis the point half a pulse further out lies inside the circle if outside < -m, and the
    // one half a pulse further in lies outside it if outside >= m.
    const std::int64_t m = at_[long_axis] * o.long_side;
    const int grow = m < 0 || outside_ < -m ? +1 : m > 0 && outside_ >= m ? -1 : 0;
    outside_ += grow * 2 * m + grow * grow;
    at_[long_axis] += grow * o.long_side;
    step[long_axis] = grow * o.long_side;

    const auto at_finish = [&] { return octant_ == finish_octant_ && !lap_ && past_finish(); };
    finished_ = at_finish();
    for (int i = 0; i < 4 && !finished_ && leaves(octant_, at_[0], at_[1]); ++i) {
        if (octant_ == finish_octant_ && !lap_) {
            finished_ = true;
        } else {
            octant_ = (octant_ + 1) % 8;
            lap_ = false;
            finished_ = at_finish();
        }
    }
    if (segment_.kind == Segment::Kind::arc_cw) step[1] = -step[1];
}

int Path::zone() const {
    if (!is_arc()) return 0;
    return segment_.kind == Segment::Kind::arc_cw ? 7 - octant_ : octant_;
}

int Path::direction(int i) const {
    if (is_pattern()) return 0;
    if (is_line()) return segment_.finish[i] > 0 ? +1 : segment_.finish[i] < 0 ? -1 : 0;
    const int d = direction_in(octant_, i);
    return i == 1 && segment_.kind == Segment::Kind::arc_cw ? -d : d;
}

}  // namespace motionrack::mcx314::twin
