// The programmed position: after the last line and at the end of the current one, with the limits of the axes.
#pragma once

#include <cstdint>
#include <motionrack/control/gcode/settings.hpp>

namespace motionrack::control::gcode {

/// Positions may exceed a limit by this much (mm or degrees): the rounding error of sums.
inline constexpr double limit_slack = 1e-6;

class Travel {
  public:
    void start(const Settings& settings);
    /// Removes the limits, and makes all axes present.
    void remove_limits();

    const Point& position() const { return position_; }  ///< machine coordinates after the last line
    /// Returns the end of the current line; it becomes the position when the line is valid.
    Point& end() { return end_; }
    const Point& end() const { return end_; }
    void begin_line() { end_ = position_; }
    void commit() { position_ = end_; }
    /// Continues from a position that no line of the program reached.
    void move_to(const Point& position) { position_ = position; }

    const Point& low() const { return low_; }  ///< lower limits less limit_slack
    const Point& high() const { return high_; }
    bool contains(int axis, double value) const { return value >= low_[axis] && value <= high_[axis]; }
    std::uint32_t present_words() const { return present_words_; }  ///< letters of the axes that are present

  private:
    Point low_ = {};
    Point high_ = {};
    std::uint32_t present_words_ = 0;
    Point position_ = {};
    Point end_ = {};
};

}  // namespace motionrack::control::gcode
