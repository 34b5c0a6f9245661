// Straight and probing moves.
#include <array>
#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/cutter_compensation.hpp>
#include <motionrack/control/gcode/straight_words.hpp>

namespace motionrack::control::gcode {

bool StraightWords::read(std::int16_t code) {
    if (is_probing(code) && !may_probe(code)) return false;
    if (!targets(block().has_g(g_nonmodal) && block().g[g_nonmodal] == 530)) return false;
    Move& move = steps().moving().move;
    move.kind = code == 0 ? MoveKind::rapid : MoveKind::feed;
    move.path = next().path;
    move.tolerance_mm = next().tolerance_mm;
    move.line = line_number();
    move.end = travel().end();
    move.feed = 0;
    move.feed_mode = FeedMode::units_per_second;
    if (code != 0 && (!by_itself(code) || !feed_of(move))) return false;
    steps().moving().probe = Probe::none;
    if (is_probing(code) && !probing(code)) return false;
    steps().moving().line = line_number();
    steps().add_move();
    return !compensates() || CutterCompensation(in_).compensate();
}

bool StraightWords::may_probe(std::int16_t code) {
    const std::string name = name_of_g(code);
    const auto refuse = [&](GrblStatus status, const char* why) { return fail_at(error_column(), status, name + why); };
    if (!settings().probe) {
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

/// Turns the move prepared by read() into a probing move.
bool StraightWords::probing(std::int16_t code) {
    const std::string name = name_of_g(code);
    const auto refuse = [&](GrblStatus status, const char* why) { return fail_at(error_column(), status, name + why); };
    for (int axis = 3; axis < axis_count; ++axis)
        if (travel().end()[axis] != travel().position()[axis])
            return refuse(GrblStatus::unused_word, " does not turn axes; put the turn on a line before it");
    if (travel().end() == travel().position())
        return refuse(GrblStatus::bad_target, " has no length; its end is the current position");
    constexpr std::array<Probe, 4> kinds = {Probe::contact, Probe::contact_if, Probe::release, Probe::release_if};
    steps().moving().probe = kinds[static_cast<std::size_t>(code - 382)];
    steps().moving().move.path = PathControl::exact_stop;
    return true;
}

}  // namespace motionrack::control::gcode
