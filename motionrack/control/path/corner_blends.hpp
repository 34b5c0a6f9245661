// Corner blends of one curve, in order, with their blend lengths.
//
//   add --> | added: length proposed | checked: scale that keeps each corner's tolerance | settled: final | --> drop
//
// The proposed length of a blend assumes neighbours of the same length. The check adds the deviations of all blends
// that reach over a corner; if the sum exceeds its tolerance, all of them shrink. A blend reaches over at most `reach`
// corners on either side, so it settles when 3 * reach corners after it are known, or all.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/control/limits.hpp>
#include <motionrack/control/move.hpp>

namespace motionrack::control {

/// The tangent of the path changes by `change` at `u`. The blend spreads this over begin .. end as a triangle with its
/// peak at `peak`. The mean of these three is u, so that nothing changes outside.
struct CornerBlend {
    double u = 0;
    double begin = 0, peak = 0, end = 0;
    double rise = 0;     ///< 1 / ((peak - begin)(end - begin)): half the slope of the rising side; 0 without one
    double fall = 0;     ///< 1 / ((end - peak)(end - begin)): half the slope of the falling side; 0 without one
    bool fixed = false;  ///< the blend length is given (arcs)
    double blend_length = 0;
    double linear = 0;     ///< length of the XYZ part of `change`
    double rotary = 0;     ///< change of the rotary axis with the largest change
    double tolerance = 0;  ///< largest deviation from the corner by blending: mm, or degrees where only ABC move
    double tolerance_per_rotary = 0;  ///< weight of a degree of the rotary axes in `tolerance`
    double velocity = 0;              ///< maximum du/dt here
    double per_accel =
        0;  ///< change relative to the axis limit, largest over the axes: gives the blend length for a velocity
    double per_jerk = 0;
    double blend_scale = 1;  ///< factor that the tolerance of its corner requires of all blends that reach over it
    Point at = {};           ///< position of the corner
    Point change = {};
    Point tangent = {};     ///< tangent after the corner
    double feed = 0;        ///< maximum du/dt after the corner; a blend begins wherever the feed rate changes
    std::int32_t line = 0;  ///< line of the move after the corner
};

class CornerBlends {
  public:
    static constexpr std::int64_t reach = 8;
    static constexpr std::int64_t capacity = 128;

    explicit CornerBlends(const MachineLimits& limits);

    /// Starts a new curve.
    void clear();
    bool has_room() const { return made_ - dropped_ < capacity; }
    /// Adds a blend for the caller to fill; for a fixed one including begin, peak and end.
    CornerBlend& add();
    /// Completes the last blend: computes the values that follow from its change.
    void added();
    /// Ends the curve at u; no corner follows.
    void complete(double u);
    /// Discards the blends before number `index`.
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
