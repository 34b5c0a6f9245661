// G70 .. G72.2: from words to a plan, and from the contour of a sub to moves.
#include <fmt/format.h>

#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/interpreter.hpp>
#include <motionrack/control/gcode/plane_point.hpp>
#include <utility>

namespace motionrack::control::gcode {

namespace {

constexpr std::int16_t finishing = 700;
constexpr double max_passes = 10'000;
/// Minimum depth of a level, mm.
constexpr double min_depth = 1e-4;

}  // namespace

/// Reads the words of the cycle. turn() makes its moves when the contour is known.
bool Interpreter::turning(std::int16_t code) {
    LatheCycle plan;
    plan.code = code;
    if (!turning_allowed(code) || !turning_words(code, plan)) return false;
    words_.use(axis_words);
    const Point stays = travel_.end();
    const bool incremental = std::exchange(next().incremental, false);  // X and Z are absolute in G91 too
    if ((block().words & axis_words) != 0 && !targets(false)) return false;
    next().incremental = incremental;
    plan.start = {travel_.end()[2], travel_.end()[0]};
    travel_.end() = stays;
    if (!feed_of(begin_move(MoveKind::feed))) return false;
    next().motion = no_motion;
    turning_ = plan;
    return true;
}

bool Interpreter::turning_allowed(std::int16_t code) {
    const std::string name = name_of_g(code);
    const auto refuse = [&](GrblStatus status, const std::string& why) {
        return words_.fail_at(block().g_column[g_motion], status, name + why);
    };
    if (words_.language() != Language::program)
        return refuse(GrblStatus::unsupported, ": a single line has no contour to turn; run the program as a file");
    if (block().has_g(g_nonmodal) || words_.axis_words_taken())
        return refuse(GrblStatus::axis_conflict,
                      " must not share its words with other codes; put it on a separate line");
    if (block().has_m(m_stop) || block().has_m(m_io))
        return refuse(GrblStatus::unsupported,
                      " must not share a line with a stop, an end or an output; put that on a separate line");
    if (next().plane != 1)
        return refuse(GrblStatus::no_plane_axis, " turns in the plane of X and Z; write G18 before it");
    if (settings_.point_to_point)
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
            return words_.fail_word(letter, GrblStatus::unused_word,
                                    fmt::format("{}: {} moves X and Z only; put the other axes on a separate line",
                                                words_.word_text(letter), name));
    }
    return true;
}

bool Interpreter::turning_words(std::int16_t code, LatheCycle& plan) {
    if (!block().has('Q')) {
        return words_.fail_at(
            block().g_column[g_motion], GrblStatus::word_missing,
            fmt::format("Q word missing: {} needs the number of the sub with the contour; write e.g. {} Q100 X30 Z2",
                        name_of_g(code), name_of_g(code)));
    }
    if (!words_.need_integer('Q', 0, 1e9, "the number of the sub with the contour")) return false;
    contour_label_ = fmt::format("{:.0f}", block()['Q']);
    words_.use(letter_bit('Q') | letter_bit('D'));
    for (const char letter : {'D', 'E', 'R'}) {
        if (block().has(letter) && block()[letter] < 0)
            return words_.fail_word(
                letter, GrblStatus::negative_value,
                fmt::format("{} is negative; it is a distance, 0 or more", words_.word_text(letter)));
    }
    if (block().has('D')) plan.distance = scaled('D');
    if (code == finishing) {
        words_.use(letter_bit('E') | letter_bit('P'));
        if (block().has('E')) plan.end_distance = scaled('E');
        if (block().has('P') && !words_.need_integer('P', 1, max_passes, "the number of passes")) return false;
        if (block().has('P')) plan.passes = static_cast<std::int32_t>(block()['P']);
        return true;
    }
    words_.use(letter_bit('I') | letter_bit('R'));
    const double unit = next().inch ? 25.4 : 1;
    plan.depth = block().has('I') ? scaled('I') : unit;
    plan.retract = block().has('R') ? scaled('R') : 0.5 * unit;
    if (plan.depth >= min_depth) return true;
    return words_.fail_word(
        'I', GrblStatus::bad_target,
        fmt::format("{}: I is the depth of each cut; it must be {} mm or more", words_.word_text('I'), min_depth));
}

Interpreter Interpreter::contour_interpreter() const {
    Interpreter reader = *this;
    reader.travel_.remove_limits();
    reader.settings_.probe = reader.settings_.point_to_point = false;
    reader.turning_.reset();
    reader.steps_.clear();
    Point start = travel_.position();
    start[2] = turning_->start.first;
    start[0] = turning_->start.second;
    reader.travel_.move_to(start);
    return reader;
}

Outcome<void> Interpreter::turn(std::vector<ContourSegment> contour) {
    const std::size_t column = block().g_column[g_motion];
    std::vector<LatheMove> moves;
    const std::string fault =
        gcode::make_lathe_moves(*turning_, std::move(contour), {travel_.position()[2], travel_.position()[0]}, moves);
    const std::string name = name_of_g(turning_->code);
    turning_.reset();
    if (!fault.empty()) words_.fail_at(column, GrblStatus::bad_target, fmt::format("{}: {}", name, fault));
    if (!fault.empty() || !turning_within_limits(moves)) {
        steps_.clear();
        return words_.problem_of(words_.number());
    }
    if (moves.empty()) return {};
    Point end = travel_.position();
    end[2] = moves.back().to.first;
    end[0] = moves.back().to.second;
    travel_.move_to(end);
    steps_.moving().move.end = end;
    steps_.add_turning(std::move(moves));
    return {};
}

bool Interpreter::turning_within_limits(const std::vector<LatheMove>& moves) {
    const std::size_t column = block().g_column[g_motion];
    PlanePoint from = {travel_.position()[2], travel_.position()[0]};
    for (const LatheMove& move : moves) {
        if (!reach(2, move.to.first, column) || !reach(0, move.to.second, column)) return false;
        if (move.kind == MoveKind::arc && !arc_within_limits(from, move.to, move.centre, move.turns)) return false;
        from = move.to;
    }
    return true;
}

}  // namespace motionrack::control::gcode
