// The transformation from program to machine coordinates.
//
//     machine = rotate(program + G92) + work offset + tool offset     rotate: about Z, by G10 L2 R of the active system
#pragma once

#include <motionrack/control/gcode/settings.hpp>

namespace motionrack::control::gcode {

struct WorkFrame {
    std::array<Point, work_offset_count> work = {};
    std::array<double, work_offset_count> rotation_deg = {};  ///< degrees, counter-clockwise seen from above
    Point g92 = {};
    Point g92_saved = {};  ///< G92 shift that G92.3 restores
    Point tool = {};       ///< active tool offset (G43, G43.1, G43.2)
    Point g28 = {};
    Point g30 = {};
    Point probe = {};        ///< machine coordinates of the last probe edge, or the end of the move without one
    bool probe_hit = false;  ///< the last probing move found an edge

    // Set by activate() for the active system:
    Point offset = {};  ///< sum of work, G92 and tool: machine less program coordinates without rotation
    Point base = {};    ///< sum of work and tool offset
    bool is_rotated = false;
    double cosine = 1;
    double sine = 0;

    void activate(int system);

    Point to_machine(const Point& program) const;
    Point to_program(const Point& machine) const;
    /// Transforms a distance from program to machine coordinates.
    Point rotate(const Point& distance) const;
};

/// Cosine and sine of an angle given in degrees; exact for multiples of 90 degrees.
struct Rotation {
    double cosine;
    double sine;
};
Rotation rotation_of(double degrees);

}  // namespace motionrack::control::gcode
