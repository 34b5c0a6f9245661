// Base of the classes that read moves: the target of the axis words, its limits, and the feed rate.
#pragma once

#include <motionrack/control/gcode/arc.hpp>
#include <motionrack/control/gcode/word_reader.hpp>

namespace motionrack::control::gcode {

constexpr bool is_arc(std::int16_t code) {
    return code == 20 || code == 30;
}
constexpr bool is_spline(std::int16_t code) {
    return code == 50 || code == 51;
}
constexpr bool is_probing(std::int16_t code) {
    return code >= 382 && code <= 385;
}

inline constexpr std::array<const char*, 3> plane_names = {"G17 (XY)", "G18 (XZ)", "G19 (YZ)"};

class MoveReader : public WordReader {
  public:
    using WordReader::WordReader;

  protected:
    const CutterState& cutter() const { return in_.cutter; }
    bool compensates() const { return next().cutter != CutterSide::off && next().cutter_radius_mm > 0; }

    bool targets(bool machine_coordinates);
    Move& begin_move(MoveKind kind);
    bool feed_of(Move& move);
    bool no_feed();
    bool by_itself(std::int16_t code);
    bool in_turned_plane(std::int16_t code);
    bool leaves_straight(std::int16_t code);
    bool reaches_contour();
    bool arc_within_limits(PlanePoint start, PlanePoint end, PlanePoint centre, std::int32_t turns);
    bool reach(int axis, double value, std::size_t column) {
        return travel().contains(axis, value) || exceeds_travel(axis, value, column);
    }

  private:
    bool targets_turned();
    bool exceeds_travel(int axis, double value, std::size_t column);
};

}  // namespace motionrack::control::gcode
