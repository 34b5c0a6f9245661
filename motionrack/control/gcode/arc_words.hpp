// G2 and G3: centre, turns, and limits over the whole arc.
#pragma once

#include <motionrack/control/gcode/move_reader.hpp>

namespace motionrack::control::gcode {

class ArcWords : public MoveReader {
  public:
    using MoveReader::MoveReader;

    bool read(std::int16_t code);

  private:
    bool arc_centre(bool counter_clockwise, PlanePoint& centre);
    bool arc_centre_of_radius(PlanePoint start, PlanePoint end, bool closed, bool counter_clockwise,
                              PlanePoint& centre);
    bool arc_centre_of_offsets(PlanePoint start, PlanePoint& centre);
    bool arc_radii_agree(PlanePoint start, PlanePoint end, PlanePoint centre);
};

}  // namespace motionrack::control::gcode
