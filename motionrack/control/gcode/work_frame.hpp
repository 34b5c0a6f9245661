// Where program coordinates lie on the machine.
//
//     machine = turn(program + G92) + work offset + tool offset        turn: about Z, by the active system's G10 L2 R
#pragma once

#include <motionrack/control/gcode/settings.hpp>

namespace motionrack::control::gcode {

struct WorkFrame {
    std::array<Point, work_offset_count> work = {};
    std::array<double, work_offset_count> rotation_deg = {};  ///< degrees, counter-clockwise seen from above
    Point g92 = {};
    Point g92_saved = {};  ///< what G92.3 brings back
    Point tool = {};       ///< G43, G43.1, G43.2
    Point g28 = {};
    Point g30 = {};
    Point probe = {};  ///< machine coordinates where the probe last touched or left, or where its move ended without
    bool probe_hit = false;  ///< whether it did

    // Of the active system, by activate():
    Point offset = {};  ///< sum of work, G92 and tool: machine less program coordinates where the system is not turned
    Point base = {};    ///< work and tool
    bool is_rotated = false;
    double cosine = 1;
    double sine = 0;

    void activate(int system);

    Point to_machine(const Point& program) const;
    Point to_program(const Point& machine) const;
    /// A distance in program coordinates as one of the machine.
    Point rotate(const Point& distance) const;
};

/// Cosine and sine of an angle in degrees; exact at quarter turns.
struct Rotation {
    double cosine;
    double sine;
};
Rotation rotation_of(double degrees);

}  // namespace motionrack::control::gcode
