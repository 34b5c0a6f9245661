// Lathe cycles.
#include <fmt/format.h>

#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/lathe_words.hpp>
#include <utility>

namespace motionrack::control::gcode {

namespace {

constexpr std::int16_t finishing = 700;
constexpr double max_passes = 10'000;
/// Minimum depth of a level, mm.
constexpr double min_depth = 1e-4;

}  // namespace

bool LatheWords::read(std::int16_t code) {
    LatheCycle plan;
    plan.code = code;
    if (!turning_allowed(code) || !turning_words(code, plan)) return false;
    use(axis_words);
    const Point stays = travel().end();
    const bool incremental = std::exchange(next().incremental, false);  // X and Z are absolute in G91 too
    if ((block().words & axis_words) != 0 && !targets(false)) return false;
    next().incremental = incremental;
    plan.start = {travel().end()[2], travel().end()[0]};
    travel().end() = stays;
    if (!feed_of(begin_move(MoveKind::feed))) return false;
    next().motion = no_motion;
    in_.contour.cycle = plan;
    return true;
}

bool LatheWords::turning_allowed(std::int16_t code) {
    const std::string name = name_of_g(code);
    const auto refuse = [&](GrblStatus status, const std::string& why) {
        return fail_at(block().g_column[g_motion], status, name + why);
    };
    if (language() != Language::program)
        return refuse(GrblStatus::unsupported, ": a single line has no contour to turn; run the program as a file");
    if (block().has_g(g_nonmodal) || axis_words_taken())
        return refuse(GrblStatus::axis_conflict,
                      " must not share its words with other codes; put it on a separate line");
    if (block().has_m(m_stop) || block().has_m(m_io))
        return refuse(GrblStatus::unsupported,
                      " must not share a line with a stop, an end or an output; put that on a separate line");
    if (next().plane != 1)
        return refuse(GrblStatus::no_plane_axis, " turns in the plane of X and Z; write G18 before it");
    if (settings().point_to_point)
        return refuse(GrblStatus::unsupported,
                      " moves two axes together, but the axes of this rack position one by one");
    if (next().cutter != CutterSide::off)
        return refuse(GrblStatus::axis_conflict,
                      " cannot be done while cutter compensation is on; write G40 and a straight move before it");
    if (next().inverse_time)
        return refuse(GrblStatus::no_feed, " cannot be done in G93 (inverse time); write G94 and a feed before it");
    if (!leaves_straight(code) || !in_turned_plane(code)) return false;
    for (const char letter : {'Y', 'A', 'B', 'C'}) {
        if (block().has(letter))
            return fail_word(letter, GrblStatus::unused_word,
                             fmt::format("{}: {} moves X and Z only; put the other axes on a separate line",
                                         word_text(letter), name));
    }
    return true;
}

bool LatheWords::turning_words(std::int16_t code, LatheCycle& plan) {
    if (!block().has('Q')) {
        return fail_at(
            block().g_column[g_motion], GrblStatus::word_missing,
            fmt::format("Q word missing: {} needs the number of the sub with the contour; write e.g. {} Q100 X30 Z2",
                        name_of_g(code), name_of_g(code)));
    }
    if (!need_integer('Q', 0, 1e9, "the number of the sub with the contour")) return false;
    in_.contour.label = fmt::format("{:.0f}", block()['Q']);
    if (!claim_for_g(code, letter_bit('Q'))) return false;
    use(letter_bit('D'));
    for (const char letter : {'D', 'E', 'R'}) {
        if (block().has(letter) && block()[letter] < 0)
            return fail_word(letter, GrblStatus::negative_value,
                             fmt::format("{} is negative; it is a distance, 0 or more", word_text(letter)));
    }
    if (block().has('D')) plan.distance = scaled('D');
    if (code == finishing) {
        if (!claim_for_g(code, letter_bit('E') | letter_bit('P'))) return false;
        if (block().has('E')) plan.end_distance = scaled('E');
        if (block().has('P') && !need_integer('P', 1, max_passes, "the number of passes")) return false;
        if (block().has('P')) plan.passes = static_cast<std::int32_t>(block()['P']);
        return true;
    }
    if (!claim_for_g(code, letter_bit('R'))) return false;
    use(letter_bit('I'));
    const double unit = next().inch ? 25.4 : 1;
    plan.depth = block().has('I') ? scaled('I') : unit;
    plan.retract = block().has('R') ? scaled('R') : 0.5 * unit;
    if (plan.depth >= min_depth) return true;
    return fail_word(
        'I', GrblStatus::bad_target,
        fmt::format("{}: I is the depth of each cut; it must be {} mm or more", word_text('I'), min_depth));
}

Outcome<void> LatheWords::turn(std::vector<ContourSegment> contour) {
    const std::size_t column = block().g_column[g_motion];
    std::vector<LatheMove> moves;
    const std::string fault = gcode::make_lathe_moves(*in_.contour.cycle, std::move(contour),
                                                      {travel().position()[2], travel().position()[0]}, moves);
    const std::string name = name_of_g(in_.contour.cycle->code);
    in_.contour.cycle.reset();
    if (!fault.empty()) fail_at(column, GrblStatus::bad_target, fmt::format("{}: {}", name, fault));
    if (!fault.empty() || !turning_within_limits(moves)) {
        steps().clear();
        return in_.words.problem_of(line_number());
    }
    if (moves.empty()) return {};
    Point end = travel().position();
    end[2] = moves.back().to.first;
    end[0] = moves.back().to.second;
    travel().move_to(end);
    steps().moving().move.end = end;
    steps().add_turning(std::move(moves));
    return {};
}

bool LatheWords::turning_within_limits(const std::vector<LatheMove>& moves) {
    const std::size_t column = block().g_column[g_motion];
    PlanePoint from = {travel().position()[2], travel().position()[0]};
    for (const LatheMove& move : moves) {
        if (!reach(2, move.to.first, column) || !reach(0, move.to.second, column)) return false;
        if (move.kind == MoveKind::arc && !arc_within_limits(from, move.to, move.centre, move.turns)) return false;
        from = move.to;
    }
    return true;
}

}  // namespace motionrack::control::gcode
