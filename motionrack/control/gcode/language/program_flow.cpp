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
      block_delete_(settings.block_delete),
      end_(settings.block_delete),
      max_lines_(settings.max_lines),
      subprogram_(settings.subprogram) {
    sources_.push_back(std::make_unique<ProgramSource>());
    source_ = sources_.back().get();
    source_->text = text;
    source_->file = std::move(file);
}

void ProgramFlow::see_end(std::string_view line) {
    if (source_ == sources_.front().get() && end_.is_at(line)) over_ = true;
}

void ProgramFlow::place(Problem& problem) const {
    problem.place.line = lines_.number();
    problem.file = source_->file;
}

void ProgramFlow::line_rejected(std::string_view text, Problem& problem) {
    place(problem);
    see_end(text);
}

Problem ProgramFlow::take_fault() {
    Problem first = std::move(faults_.front());
    faults_.erase(faults_.begin());
    return first;
}

bool ProgramFlow::fail(const OWordLocation& place, std::size_t column, std::string message) {
    set_problem(problem_, place.text, column, GrblStatus::unsupported, std::move(message));
    problem_.place.line = place.line;
    problem_.file = source_->file;
    return false;
}

bool ProgramFlow::make_index(ProgramSource& source) {
    source.index = index_owords(source.text, block_delete_);
    for (Problem& problem : source.index->problems) {
        problem.file = source.file;
        faults_.push_back(std::move(problem));
    }
    over_ = over_ || !faults_.empty();
    return faults_.empty();
}

Outcome<void> ProgramFlow::follow(Interpreter& interpreter) {
    if (!source_->index && !make_index(*source_)) return tl::unexpected<Problem>(take_fault());
    const std::int32_t at = source_->index->at_line(lines_.number());
    if (at == no_location) {
        const Block& block = interpreter.block();
        set_problem(problem_, block.text, block.flow_column, GrblStatus::unsupported,
                    "this O word was not indexed; put it first on its line");
        place(problem_);
        return tl::unexpected<Problem>(problem_);
    }
    const OWordLocation place = place_at(at);
    if (!within_budget(place) || !execute(place, at, interpreter)) return tl::unexpected<Problem>(problem_);
    return {};
}

/// Enforces the budget: loops and calls may execute more lines than the program has.
bool ProgramFlow::within_budget(const OWordLocation& place) {
    furthest_ = highest_line();
    walked_ += lines_.number() - counted_from_;
    counted_from_ = lines_.number();
    const ProgramSource& main = *sources_.front();
    if (walked_ <= max_lines_ + (main.index ? main.index->lines : source_->index->lines)) return true;
    over_ = true;
    return fail(place, place.column,
                fmt::format("the program has executed {} lines without an end; check that this loop or call ends. The "
                            "rest was not read",
                            walked_));
}

void ProgramFlow::jump(const OWordLocation& place) {
    lines_ = place.after;
    counted_from_ = place.line;
}

bool ProgramFlow::execute(const OWordLocation& place, std::int32_t at, Interpreter& interpreter) {
    switch (place.word) {
        case OWord::sub:
            jump(place_at(place.end));
            return true;
        case OWord::call:
            return call(place, interpreter);
        case OWord::endsub:
        case OWord::return_sub:
            return return_sub(place, interpreter);
        case OWord::if_true:
            return choose(at, interpreter);
        case OWord::else_if:
        case OWord::else_branch:
            jump(place_at(place.end));
            return true;
        case OWord::while_true: {
            double value = 0;
            const bool good = evaluate(place, interpreter, value);
            const OWordLocation& begin = place_at(place.begin);
            if (begin.word == OWord::do_once) {
                if (good && value != 0) jump(begin);
            } else if (!good || value == 0) {
                jump(place_at(place.end));
            }
            return good;
        }
        case OWord::endwhile:
            continue_loop(place_at(place.begin));
            return true;
        case OWord::repeat:
            return begin_repeat(place, at, interpreter);
        case OWord::endrepeat:
            end_repeat(place);
            return true;
        case OWord::break_loop:
            break_loop(place_at(place.begin));
            return true;
        case OWord::continue_loop:
            continue_loop(place_at(place.begin));
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
        const OWordLocation& place = place_at(at);
        if (place.word == OWord::else_branch || place.word == OWord::endif) {
            jump(place);
            return true;
        }
        ++walked_;
        double value = 0;
        if (!evaluate(place, interpreter, value)) {
            jump(place_at(place.end));
            return false;
        }
        if (value != 0) {
            jump(place);
            return true;
        }
        at = place.branch;
    }
}

bool ProgramFlow::begin_repeat(const OWordLocation& place, std::int32_t at, Interpreter& interpreter) {
    double times = 0;
    const bool good = evaluate(place, interpreter, times);
    times = std::floor(std::min(times, max_loop_repeats) + 0.5);
    if (!good || times < 1) {
        jump(place_at(place.end));
        return good;
    }
    repeats_.push_back({at, static_cast<std::int64_t>(times)});
    return true;
}

void ProgramFlow::end_repeat(const OWordLocation& place) {
    if (repeats_.empty() || repeats_.back().place != place.begin) return;
    if (--repeats_.back().left > 0)
        jump(place_at(place.begin));
    else
        repeats_.pop_back();
}

/// Removes the repeats of this call between two locations.
void ProgramFlow::forget_repeats(std::int32_t first, std::int32_t last) {
    const std::size_t outer = frames_.empty() ? 0 : frames_.back().repeats;
    while (repeats_.size() > outer && repeats_.back().place >= first && repeats_.back().place < last)
        repeats_.pop_back();
}

void ProgramFlow::break_loop(const OWordLocation& loop) {
    forget_repeats(loop.begin, loop.end);
    jump(place_at(loop.end));
}

/// Starts the next iteration of a loop, or leaves it.
void ProgramFlow::continue_loop(const OWordLocation& loop) {
    forget_repeats(loop.begin + 1, loop.end);
    const OWordLocation& decides = loop.word == OWord::while_true ? loop : place_at(loop.end);
    // The deciding line is executed again: returns to the end of the line before it.
    lines_ = decides.before;
    counted_from_ = decides.line - 1;
}

}  // namespace motionrack::control::gcode
