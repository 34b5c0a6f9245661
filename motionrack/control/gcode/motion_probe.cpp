// G38.2 .. G38.5: a move that ends at the probe edge.
#include <fmt/format.h>

#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/interpreter.hpp>

namespace motionrack::control::gcode {

bool Interpreter::may_probe(std::int16_t code) {
    const std::string name = name_of_g(code);
    const auto refuse = [&](GrblStatus status, const char* why) {
        return words_.fail_at(words_.error_column(), status, name + why);
    };
    if (!settings_.probe) {
        return refuse(
            GrblStatus::unsupported,
            " probes, but this machine has no probe input; take the probing out of the program and set the work "
            "offset with G10 L20 instead");
    }
    if (next().cutter != CutterSide::off)
        return refuse(GrblStatus::axis_conflict,
                      " cannot probe while cutter compensation is on; write G40 and a straight move before it");
    if (!leaves_straight(code)) return false;
    if (next().inverse_time)
        return refuse(GrblStatus::no_feed, " cannot be done in G93 (inverse time); write G94 and a feed before it");
    return true;
}

/// Turns the move prepared by straight() into a probing move.
bool Interpreter::probing(std::int16_t code) {
    const std::string name = name_of_g(code);
    const auto refuse = [&](GrblStatus status, const char* why) {
        return words_.fail_at(words_.error_column(), status, name + why);
    };
    for (int axis = 3; axis < axis_count; ++axis)
        if (travel_.end()[axis] != travel_.position()[axis])
            return refuse(GrblStatus::unused_word, " does not turn axes; put the turn on a line before it");
    if (travel_.end() == travel_.position())
        return refuse(GrblStatus::bad_target, " has no length; its end is the current position");
    constexpr std::array<Probe, 4> kinds = {Probe::contact, Probe::contact_if, Probe::release, Probe::release_if};
    steps_.moving().probe = kinds[static_cast<std::size_t>(code - 382)];
    steps_.moving().move.path = PathControl::exact_stop;
    return true;
}

/// Stores #5061 .. #5066 in the coordinates and units of the probing line, and #5070.
void Interpreter::store_probe_result(bool hit, const Point& at) {
    constexpr int first = 5061, success = 5070;
    const Point place = frame().to_program(at);
    for (int axis = 0; axis < axis_count; ++axis)
        parameters_.set(first + axis, place[axis] / (axis < 3 && modes().inch ? 25.4 : 1.0));
    for (int other = first + axis_count; other < success; ++other) parameters_.set(other, 0);
    parameters_.set(success, hit ? 1 : 0);
}

void Interpreter::set_probe_result(bool hit, const Point& at, const Point& stopped_at) {
    offsets_.set_probe_result(hit, at);
    store_probe_result(hit, at);
    resync_position(stopped_at);
}

}  // namespace motionrack::control::gcode
