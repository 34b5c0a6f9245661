// The turns of one curve, in order, and the widths over which they are spread.
//
//   add --> | made: proposed a width | checked: what it leaves of each corner's room | settled: final | --> drop
//
// A width is proposed for each turn as if its neighbours had the same. Then each corner looks at all that reach over
// it: where their deviations add up to more than its room, all of them shrink. No width reaches over more than `reach`
// turns on either side, so a turn settles when 3 * reach turns after it are known, or all.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/control/limits.hpp>
#include <motionrack/control/move.hpp>

namespace motionrack::control {

/// The path's direction changes by `change` at `u`; this is spread over begin .. end as a triangle whose peak is at
/// `peak`. The mean of these three is u, so that outside of them nothing changes.
struct CornerBlend {
    double u = 0;
    double begin = 0, peak = 0, end = 0;
    double rise = 0,
           fall = 0;     ///< 1 / ((peak - begin)(end - begin)), 1 / ((end - peak)(end - begin)); 0 without such a side
    bool fixed = false;  ///< its width was given: of an arc
    double blend_length = 0;
    double linear = 0;  ///< size of the change of XYZ
    double rotary = 0;  ///< of the rotary axis that turns most
    double tolerance =
        0;  ///< how far the curve may be from the corner by spreading: mm, or degrees where only ABC move
    double room_per_rotary = 0;  ///< what a degree of the rotary axes counts in `room`
    double speed = 0;            ///< greatest du/dt here
    double per_accel = 0;        ///< of the change; greatest over the axes, so that the width for a speed can be told
    double per_jerk = 0;
    double blend_scale = 1;  ///< what its corner asks of all that reach over it
    Point at = {};           ///< the corner
    Point change = {};
    Point tangent = {};     ///< after the corner
    double feed = 0;        ///< after the corner; each span begins with a turn, so pieces end where feeds change
    std::int32_t line = 0;  ///< after the corner
};

class CornerBlends {
  public:
    static constexpr std::int64_t reach = 8;
    static constexpr std::int64_t capacity = 128;

    explicit CornerBlends(const MachineLimits& limits);

    /// Begins a new curve.
    void clear();
    bool has_room() const { return made_ - dropped_ < capacity; }
    /// A turn to fill; begin, peak and end too where it is fixed.
    CornerBlend& add();
    /// What is to be known of the last turn is: works out what follows from its change.
    void added();
    /// No turn comes after; the curve ends at u.
    void complete(double u);
    /// Turns before this one are not needed any more.
    void drop_before(std::int64_t index) { dropped_ = index; }

    std::int64_t size() const { return made_; }
    std::int64_t settled() const { return settled_; }
    bool is_complete() const { return complete_; }
    double end() const { return end_; }
    const CornerBlend& operator[](std::int64_t i) const { return turns_[static_cast<std::size_t>(i % capacity)]; }

  private:
    CornerBlend& turn(std::int64_t i) { return turns_[static_cast<std::size_t>(i % capacity)]; }
    void advance();
    double proposed_width(std::int64_t k) const;
    double shrink_at(std::int64_t k) const;
    void set_blend_length(std::int64_t k, double width);
    void settle(std::int64_t k);

    std::array<double, axis_count> per_accel_;
    std::array<double, axis_count> per_jerk_;
    std::array<CornerBlend, capacity> turns_;
    std::int64_t made_ = 0, proposed_ = 0, checked_ = 0, settled_ = 0, dropped_ = 0;
    bool complete_ = false;
    double end_ = 0;
};

}  // namespace motionrack::control
