// Result of a program run: its plan, its events and its probing moves.
#pragma once

#include <cstdint>
#include <motionrack/control/axis_group.hpp>
#include <motionrack/control/gcode/canon_call.hpp>
#include <motionrack/control/look_ahead_planner.hpp>
#include <string>
#include <vector>

namespace motionrack::control {

/// A canonical call other than motion, in program order, with the number of the last planned move before it.
struct ProgramEvent {
    int line = 0;
    std::int64_t after_move = -1;
    std::string text;  ///< "spindle clockwise at 12000 rpm", "message: clamp the part"
};

/// Returns the text of a call other than motion.
std::string event_text(const gcode::CanonCall& step);

/// A probing move of the program.
struct ProgramProbe {
    int line = 0;
    gcode::Probe probe = gcode::Probe::none;
    ProbeResult outcome;
};

struct ProgramResult {
    static constexpr std::size_t max_events = 2000;  ///< stored ones; later ones are only counted

    PlanSummary plan;
    std::int64_t lines = 0;  ///< lines read
    std::int64_t moves = 0;  ///< moves read, without dwells
    std::vector<ProgramEvent> events;
    std::int64_t events_left_out = 0;
    std::vector<ProgramProbe> probes;  ///< at most max_events of them
    bool ended = false;                ///< the program ended with M2 or M30

    void add(ProgramEvent event);
    /// Adds a probing move, and its event.
    void add(const ProgramProbe& probe, std::int64_t after_move);
};

}  // namespace motionrack::control
