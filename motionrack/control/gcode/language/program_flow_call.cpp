// Calls: target sub, arguments and return value.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/control/gcode/language/machine_parameters.hpp>
#include <motionrack/control/gcode/language/oword_values.hpp>
#include <motionrack/control/gcode/language/program_flow.hpp>
#include <motionrack/control/gcode/number.hpp>

namespace motionrack::control::gcode {

namespace {

/// Maximum number of subprogram files in one program.
constexpr std::size_t max_files = 100;

/// Returns true for a name that can only be a file in the folder of the program.
bool is_plain(std::string_view name) {
    const auto plain = [](char c) { return (c >= 'a' && c <= 'z') || is_digit(c) || c == '_' || c == '-' || c == '.'; };
    return !name.empty() && name.front() != '.' && std::all_of(name.begin(), name.end(), plain);
}

std::string_view without_marks(std::string_view label) {
    if (label.starts_with('<')) label = label.substr(1, label.size() - 2);
    return label;
}

/// Describes a call and its target for an error message.
std::string asks_for(const std::string& label, bool numbered) {
    return numbered ? fmt::format("M98 P{}", label) : fmt::format("o{} call", label);
}
std::string text_of(const std::string& label, bool numbered) {
    return numbered ? fmt::format("O{}", label) : fmt::format("o{} sub", label);
}

std::string too_deep(const std::string& asks) {
    return fmt::format("{}: {} nested calls; check that the sub does not call itself endlessly", asks, max_call_depth);
}

}  // namespace

bool ProgramFlow::evaluate(const OWordLocation& location, Interpreter& interpreter, double& value) {
    if (std::optional<OWordFault> fault = evaluate_condition(location, interpreter, value))
        return fail(location, fault->column, std::move(fault->message));
    return true;
}

/// Returns the computed label of a call, a number.
bool ProgramFlow::label_of_call(const OWordLocation& location, Interpreter& interpreter, std::string& label) {
    OWordStatement words;
    if (!parse_oword(location.text, location.column, words, problem_)) return false;
    label = words.label;
    if (!words.computed) return true;
    const MachineParameters known(interpreter);
    ExpressionParser reader(location.text, known);
    const char* at = location.text.data() + location.column + 1;
    double value = 0;
    if (!reader.value(at, value)) return fail(location, reader.fault_at(), reader.fault());
    if (value < 0 || value != std::floor(value) || value > largest_number)
        return fail(location, location.column, fmt::format("o{:.6g}: the number of a sub is whole, 0 or more", value));
    label = fmt::format("{:.0f}", value);
    return true;
}

bool ProgramFlow::call(const OWordLocation& location, Interpreter& interpreter) {
    std::string label;
    SubTarget target{};
    if (!label_of_call(location, interpreter, label) || !find_sub(location, label, false, target)) return false;
    std::vector<double> values;
    if (std::optional<OWordFault> fault = evaluate_values(location, max_arguments, interpreter, values))
        return fail(location, fault->column, std::move(fault->message));
    if (!interpreter.parameters().enter(values))
        return fail(location, location.column, too_deep(asks_for(label, false)));
    interpreter.parameters().forget_returned();
    enter(target, no_location, 0);
    return true;
}

void ProgramFlow::enter(const SubTarget& target, std::int32_t program, std::int64_t times) {
    frames_.push_back({lines_, source_, called_at_, program, times});
    repeats_.enter_call();
    if (called_at_ == 0 && target.source != source_) called_at_ = lines_.number();
    source_ = target.source;
    jump(place_at(target.location));
}

/// Finds a sub or a numbered program in the same text, in a text read before, or in a file.
bool ProgramFlow::find_sub(const OWordLocation& location, const std::string& label, bool numbered, SubTarget& target) {
    if (texts_.find(*source_, label, numbered, target)) return true;
    if (texts_.find(*source_, label, !numbered, target)) {
        return fail(location, location.column,
                    fmt::format("{}: {} is {}; call it by {}", asks_for(label, numbered), text_of(label, !numbered),
                                numbered ? "a sub" : "a numbered program", asks_for(label, !numbered)));
    }
    return load(location, label, numbered, target);
}

bool ProgramFlow::load(const OWordLocation& location, const std::string& label, bool numbered, SubTarget& target) {
    const std::string name(without_marks(label)), asks = asks_for(label, numbered), wanted = text_of(label, numbered);
    if (!subprogram_) {
        return fail(
            location, location.column,
            fmt::format("{}: this program has no {}, and no folder to search for its file; put it into the program",
                        asks, wanted));
    }
    if (!is_plain(name)) {
        return fail(location, location.column,
                    fmt::format("{}: this program has no {}, and the name cannot be a file in its folder (letters, "
                                "digits, '_', '-' and '.')",
                                asks, wanted));
    }
    if (texts_.size() > max_files)
        return fail(location, location.column,
                    fmt::format("a program may use {} files of subprograms; this is one more", max_files));
    Result<std::string> text = subprogram_(name);
    if (!text) {
        fail(location, location.column,
             fmt::format("{}: this program has no {}, and {}", asks, wanted, text.error().message));
        problem_.kind = text.error().kind;
        return false;
    }
    ProgramTexts::ProgramSource& kept = texts_.add(std::move(*text), name + ".ngc");
    if (!make_index(kept)) {
        problem_ = take_fault();
        return false;
    }
    const auto& named = numbered ? kept.index->programs : kept.index->subs;
    const auto found = named.find(label);
    if (found == named.end())
        return fail(location, location.column, fmt::format("{}: {} has no {}", asks, kept.file, wanted));
    target = {&kept, found->second};
    return true;
}

bool ProgramFlow::return_sub(const OWordLocation& location, Interpreter& interpreter) {
    std::vector<double> values;
    std::optional<OWordFault> fault = evaluate_values(location, 1, interpreter, values);
    bool good = !fault || fail(location, fault->column, std::move(fault->message));
    if (frames_.empty()) return good;
    good =
        end_call(location, interpreter, values.empty() ? std::nullopt : std::optional<double>(values.front())) && good;
    back_to_caller();
    return good;
}

bool ProgramFlow::end_call(const OWordLocation& location, Interpreter& interpreter, std::optional<double> returned) {
    if (interpreter.end_call(returned)) return true;
    return fail(location, location.column,
                "M73 restores another plane, unit, work offset or feed mode here, which cannot change while cutter "
                "compensation is on; write G40 and a straight move before the sub ends");
}

void ProgramFlow::back_to_caller() {
    const CallFrame& frame = frames_.back();
    lines_ = frame.back;
    counted_from_ = lines_.number();
    source_ = frame.source;
    called_at_ = frame.called_at;
    repeats_.leave_call();
    frames_.pop_back();
}

// ---- numbered programs

/// Executes M98 and M99: calls without arguments, repeated L times.
Outcome<void> ProgramFlow::follow_program(Interpreter& interpreter) {
    if (!source_->index && !make_index(*source_)) return tl::unexpected<Problem>(take_fault());
    const Block& block = interpreter.block();
    const OWordLocation location = this_line(block, block.m_column[m_program]);
    if (!within_budget(location) ||
        !(block.m[m_program] == 98 ? call_program(location, interpreter) : leave_program(location, interpreter)))
        return tl::unexpected<Problem>(problem_);
    return {};
}

OWordLocation ProgramFlow::this_line(const Block& block, std::size_t column) const {
    OWordLocation location(lines_, lines_);
    location.text = block.text;
    location.column = static_cast<std::uint16_t>(column);
    location.line = lines_.number();
    return location;
}

bool ProgramFlow::call_program(const OWordLocation& location, Interpreter& interpreter) {
    const Block& block = interpreter.block();
    const auto times = block.has('L') ? static_cast<std::int64_t>(block['L']) : 1;
    const std::string label = fmt::format("{:.0f}", block['P']);
    SubTarget target{};
    if (!find_sub(location, label, true, target)) return false;
    if (times == 0) return true;
    if (!interpreter.parameters().enter()) return fail(location, location.column, too_deep(asks_for(label, true)));
    interpreter.parameters().forget_returned();
    enter(target, target.location, times);
    return true;
}

/// Repeats the program or returns to the caller. Ends the main program.
bool ProgramFlow::leave_program(const OWordLocation& location, Interpreter& interpreter) {
    if (frames_.empty()) {
        over_ = true;
        return true;
    }
    if (frames_.back().program == no_location)
        return fail(location, location.column,
                    "M99 ends a numbered program (O100 .. M99), but this is a sub; it ends with endsub, or earlier "
                    "with return");
    const bool good = end_call(location, interpreter, std::nullopt);
    CallFrame& frame = frames_.back();
    if (--frame.left == 0) {
        back_to_caller();
        return good;
    }
    repeats_.end_all();
    (void)interpreter.parameters().enter();
    jump(place_at(frame.program));
    return good;
}

/// Handles the end of a text; reports a numbered program without M99.
bool ProgramFlow::text_ended() {
    if (frames_.empty() || frames_.back().program == no_location || has_faults()) return false;
    over_ = true;
    const OWordLocation& begin = place_at(frames_.back().program);
    fail(begin, begin.column, "the text ends in this numbered program, which M98 has called; end it with M99");
    texts_.add_fault(problem_);
    return false;
}

}  // namespace motionrack::control::gcode
