// Reads the contour of a lathe cycle: the moves of a sub, which are not executed.
#include <fmt/format.h>

#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/language/contour_reader.hpp>
#include <motionrack/control/gcode/language/program_flow.hpp>

namespace motionrack::control::gcode {

Outcome<void> ProgramFlow::follow_contour(Interpreter& interpreter) {
    const Block& block = interpreter.block();
    const OWordLocation here = this_line(block, block.g_column[g_motion]);
    const auto failed = [&]() -> Outcome<void> { return tl::unexpected<Problem>(problem_); };
    if (!source_->index && !make_index(*source_)) return tl::unexpected<Problem>(take_fault());
    SubTarget target{};
    if (!within_budget(here) || !find_sub(here, interpreter.contour_label(), false, target)) return failed();
    Interpreter reader = interpreter.contour_interpreter();
    if (!reader.parameters().enter({})) {
        fail(here, here.column,
             fmt::format("{} is nested in {} calls; check that the sub does not call itself endlessly",
                         name_of_g(block.g[g_motion]), max_call_depth));
        return failed();
    }
    std::vector<ContourSegment> contour;
    const std::size_t depth = frames_.size();
    enter(target, no_location, 0);
    const bool good = read_contour(reader, contour);
    while (frames_.size() > depth) back_to_caller();
    over_ = has_faults();
    if (!good) return failed();
    if (contour.empty()) {
        fail(here, here.column,
             fmt::format("{}: o{} sub has no contour; it needs a straight move to the start of the contour, and one or "
                         "more after it",
                         name_of_g(block.g[g_motion]), interpreter.contour_label()));
        return failed();
    }
    if (auto turned = interpreter.turn(std::move(contour)); !turned) {
        location(turned.error());
        return turned;
    }
    return {};
}

/// Executes the sub with a separate interpreter.
bool ProgramFlow::read_contour(Interpreter& reader, std::vector<ContourSegment>& contour) {
    const std::size_t depth = frames_.size();
    ContourReader moves;
    for (std::string_view line; frames_.size() >= depth && next(line);) {
        if (auto done = reader.line(line, lines_.number(), Language::program); !done) {
            problem_ = done.error();
            location(problem_);
            return false;
        }
        const Block& block = reader.block();
        const OWordLocation here = this_line(block, 0);
        if (reader.is_lathe_cycle())
            return fail(here, block.g_column[g_motion],
                        fmt::format("{} stands within the contour of another cycle; end that first",
                                    name_of_g(block.g[g_motion])));
        if (auto taken = line_accepted(reader); !taken) {
            problem_ = taken.error();
            return false;
        }
        if (std::optional<std::string> fault = moves.add(reader, here.line)) return fail(here, 0, std::move(*fault));
    }
    contour = moves.take();
    return true;
}

}  // namespace motionrack::control::gcode
