// Texts of program events.
#include <fmt/format.h>

#include <motionrack/control/probing.hpp>
#include <motionrack/control/program_result.hpp>
#include <utility>

namespace motionrack::control {

namespace {

std::string override_words(const gcode::CanonCall& step) {
    const bool on = step.value != 0;
    switch (step.port) {
        case 48:
        case 49:
            return fmt::format("overrides {} (M{})", on ? "on" : "off: feeds and rapids as programmed", step.port);
        case 50:
            return fmt::format("feed override {} (M50)", on ? "on" : "off: feeds and rapids as programmed");
        case 51:
            return fmt::format("spindle override {} (M51)", on ? "on" : "off");
        case 52:
            return "adaptive feed off (M52)";
        default:
            return fmt::format("feed stop switch {} (M53)", on ? "on" : "off");
    }
}

int output_code(const gcode::CanonCall& step) {
    if (step.analog) return step.with_motion ? 67 : 68;
    return (step.with_motion ? 62 : 64) + (step.value == 0);
}

std::string input_words(const gcode::CanonCall& step) {
    const char* kind = step.analog ? "analog" : "digital";
    if (step.value < 0) return fmt::format("{} input {} (M66): timed out, not connected; #5399 is -1", kind, step.port);
    return fmt::format("{} input {} (M66): {:g}, not connected", kind, step.port, step.value);
}

}  // namespace

std::string event_text(const gcode::CanonCall& step) {
    using gcode::CanonCallKind;
    switch (step.kind) {
        case CanonCallKind::comment:
            return fmt::format("comment: {}", step.text);
        case CanonCallKind::message:
            return fmt::format("message: {}", step.text);
        case CanonCallKind::spindle_speed:
            return fmt::format("spindle speed {} rpm", step.speed_rpm);
        case CanonCallKind::spindle:
            if (step.spindle == gcode::Spindle::off) return "spindle off";
            return fmt::format("spindle {} at {} rpm",
                               step.spindle == gcode::Spindle::clockwise ? "clockwise" : "counter-clockwise",
                               step.speed_rpm);
        case CanonCallKind::coolant:
            return fmt::format("coolant: mist {}, flood {}", step.mist ? "on" : "off", step.flood ? "on" : "off");
        case CanonCallKind::tool_select:
            return fmt::format("tool {} selected", step.tool);
        case CanonCallKind::tool_number:
            return fmt::format("tool {} is in the spindle", step.tool);
        case CanonCallKind::tool_change:
            return fmt::format("tool {} changed in", step.tool);
        case CanonCallKind::overrides:
            return override_words(step);
        case CanonCallKind::output:
            return fmt::format("{} output {} to {:g} (M{})", step.analog ? "analog" : "digital", step.port, step.value,
                               output_code(step));
        case CanonCallKind::input:
            return input_words(step);
        case CanonCallKind::pause:
            return "pause (M0): not held in simulated time, the program continues";
        case CanonCallKind::optional_pause:
            return "optional pause (M1): not enabled, the program continues";
        case CanonCallKind::end:
            return "end of program";
        case CanonCallKind::move:
            break;
    }
    return {};
}

void ProgramResult::add(ProgramEvent event) {
    if (events.size() < max_events)
        events.push_back(std::move(event));
    else
        ++events_left_out;
}

void ProgramResult::add(const ProgramProbe& probe, std::int64_t after_move) {
    if (probes.size() < max_events) probes.push_back(probe);
    add(ProgramEvent{probe.line, after_move, probe_text(probe.probe, probe.outcome)});
}

}  // namespace motionrack::control
