// G5 and G5.1: from words to the four points of a cubic, checked against the limits.
#pragma once

#include <motionrack/control/gcode/move_reader.hpp>

namespace motionrack::control::gcode {

class SplineWords : public MoveReader {
  public:
    using MoveReader::MoveReader;

    bool read(std::int16_t code);
    bool spline_allowed(std::int16_t code);

  private:
    bool cubic_of_words(PlanePoint start, PlanePoint end, CubicBezier& curve);
    bool quadratic_of_words(PlanePoint start, PlanePoint end, CubicBezier& curve);
    PlanePoint turned_handle(PlanePoint handle) const;
};

}  // namespace motionrack::control::gcode
