// Executes O words: jumps within a text, calls between texts.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/control/gcode/language/machine_parameters.hpp>
#include <motionrack/control/gcode/language/program_flow.hpp>

namespace motionrack::control::gcode {

namespace {

constexpr double max_loop_repeats = 1e9;

}  // namespace

ProgramFlow::ProgramFlow(std::string_view text, const Settings& settings, std::string file)
    : lines_(text),
      end_(settings.block_delete),
      max_lines_(settings.max_lines),
      subprogram_(settings.subprogram),
      texts_(text, std::move(file), settings.block_delete),
      source_(&texts_.program()) {}

void ProgramFlow::see_end(std::string_view line) {
    if (source_ == &texts_.program() && end_.is_at(line)) over_ = true;
}

void ProgramFlow::location(Problem& problem) const {
    problem.location.line = lines_.number();
    problem.file = source_->file;
}

void ProgramFlow::line_rejected(std::string_view text, Problem& problem) {
    location(problem);
    see_end(text);
}

bool ProgramFlow::fail(const OWordLocation& location, std::size_t column, std::string message) {
    set_problem(problem_, location.text, column, GrblStatus::unsupported, std::move(message));
    problem_.location.line = location.line;
    problem_.file = source_->file;
    return false;
}

bool ProgramFlow::make_index(ProgramTexts::ProgramSource& source) {
    const bool good = texts_.make_index(source);
    over_ = over_ || !good;
    return good;
}

Outcome<void> ProgramFlow::follow(Interpreter& interpreter) {
    if (!source_->index && !make_index(*source_)) return tl::unexpected<Problem>(take_fault());
    const std::int32_t at = source_->index->at_line(lines_.number());
    if (at == no_location) {
        const Block& block = interpreter.block();
        set_problem(problem_, block.text, block.flow_column, GrblStatus::unsupported,
                    "this O word was not indexed; put it first on its line");
        location(problem_);
        return tl::unexpected<Problem>(problem_);
    }
    const OWordLocation location = place_at(at);
    if (!within_budget(location) || !execute(location, at, interpreter)) return tl::unexpected<Problem>(problem_);
    return {};
}

/// Enforces the budget: loops and calls may execute more lines than the program has.
bool ProgramFlow::within_budget(const OWordLocation& location) {
    furthest_ = highest_line();
    walked_ += lines_.number() - counted_from_;
    counted_from_ = lines_.number();
    const ProgramTexts::ProgramSource& main = texts_.program();
    if (walked_ <= max_lines_ + (main.index ? main.index->lines : source_->index->lines)) return true;
    over_ = true;
    return fail(location, location.column,
                fmt::format("the program has executed {} lines without an end; check that this loop or call ends. The "
                            "rest was not read",
                            walked_));
}

void ProgramFlow::jump(const OWordLocation& location) {
    lines_ = location.after;
    counted_from_ = location.line;
}

bool ProgramFlow::execute(const OWordLocation& location, std::int32_t at, Interpreter& interpreter) {
    switch (location.word) {
        case OWord::sub:
            jump(place_at(location.end));
            return true;
        case OWord::call:
            return call(location, interpreter);
        case OWord::endsub:
        case OWord::return_sub:
            return return_sub(location, interpreter);
        case OWord::if_true:
            return choose(at, interpreter);
        case OWord::else_if:
        case OWord::else_branch:
            jump(place_at(location.end));
            return true;
        case OWord::while_true: {
            double value = 0;
            const bool good = evaluate(location, interpreter, value);
            const OWordLocation& begin = place_at(location.begin);
            if (begin.word == OWord::do_once) {
                if (good && value != 0) jump(begin);
            } else if (!good || value == 0) {
                jump(place_at(location.end));
            }
            return good;
        }
        case OWord::endwhile:
            continue_loop(place_at(location.begin));
            return true;
        case OWord::repeat:
            return begin_repeat(location, at, interpreter);
        case OWord::endrepeat:
            if (repeats_.next(location.begin)) jump(place_at(location.begin));
            return true;
        case OWord::break_loop:
            break_loop(place_at(location.begin));
            return true;
        case OWord::continue_loop:
            continue_loop(place_at(location.begin));
            return true;
        case OWord::endif:
        case OWord::do_once:
        case OWord::numbered:
            return true;
    }
    return true;
}

/// Continues behind the first branch whose condition holds, or behind the endif.
bool ProgramFlow::choose(std::int32_t at, Interpreter& interpreter) {
    for (;;) {
        const OWordLocation& location = place_at(at);
        if (location.word == OWord::else_branch || location.word == OWord::endif) {
            jump(location);
            return true;
        }
        ++walked_;
        double value = 0;
        if (!evaluate(location, interpreter, value)) {
            jump(place_at(location.end));
            return false;
        }
        if (value != 0) {
            jump(location);
            return true;
        }
        at = location.branch;
    }
}

bool ProgramFlow::begin_repeat(const OWordLocation& location, std::int32_t at, Interpreter& interpreter) {
    double times = 0;
    const bool good = evaluate(location, interpreter, times);
    times = std::floor(std::min(times, max_loop_repeats) + 0.5);
    if (!good || times < 1) {
        jump(place_at(location.end));
        return good;
    }
    repeats_.begin(at, static_cast<std::int64_t>(times));
    return true;
}

void ProgramFlow::break_loop(const OWordLocation& loop) {
    repeats_.end_between(loop.begin, loop.end);
    jump(place_at(loop.end));
}

/// Starts the next iteration of a loop, or leaves it.
void ProgramFlow::continue_loop(const OWordLocation& loop) {
    repeats_.end_between(loop.begin + 1, loop.end);
    const OWordLocation& decides = loop.word == OWord::while_true ? loop : place_at(loop.end);
    // The deciding line is executed again: returns to the end of the line before it.
    lines_ = decides.before;
    counted_from_ = decides.line - 1;
}

}  // namespace motionrack::control::gcode
