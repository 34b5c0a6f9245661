// Calls: which sub, with which arguments, and what comes back.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/control/gcode/language/known_values.hpp>
#include <motionrack/control/gcode/language/walk.hpp>
#include <motionrack/control/gcode/number.hpp>

namespace motionrack::control::gcode {

namespace {

/// Files of subprograms that one program may use.
constexpr std::size_t most_files = 100;

/// A name that is a file's in the program's own folder, and nowhere else.
bool is_plain(std::string_view name) {
    const auto plain = [](char c) { return (c >= 'a' && c <= 'z') || is_digit(c) || c == '_' || c == '-' || c == '.'; };
    return !name.empty() && name.front() != '.' && std::all_of(name.begin(), name.end(), plain);
}

std::string_view without_marks(std::string_view label) {
    if (label.starts_with('<')) label = label.substr(1, label.size() - 2);
    return label;
}

}  // namespace

/// Values in brackets up to the end of the line.
bool Walk::arguments(const FlowPlace& place, std::size_t most, Interpreter& interpreter, std::vector<double>& values) {
    const KnownValues known(interpreter);
    ExpressionReader reader(place.text, known);
    const char* at = place.text.data() + place.rest;
    const char* end = place.text.data() + place.text.size();
    for (;;) {
        while (at < end && is_blank(*at)) ++at;
        const auto column = static_cast<std::size_t>(at - place.text.data());
        if (at == end || *at != '[') {
            if (is_rest_empty(place.text, column)) return true;
            return fail(place, column, fmt::format("{} takes values in brackets, e.g. [#1 + 2], and comments", name_of(place.word)));
        }
        if (values.size() == most) {
            return fail(place, column, most == 1 ? fmt::format("{} takes one value", name_of(place.word))
                                                 : fmt::format("a call has at most {} arguments", most));
        }
        double value = 0;
        if (!reader.value(at, value)) return fail(place, reader.fault_at(), reader.fault());
        values.push_back(value);
    }
}

/// The one value of a condition.
bool Walk::evaluate(const FlowPlace& place, Interpreter& interpreter, double& value) {
    std::vector<double> values;
    if (!arguments(place, 1, interpreter, values)) return false;
    if (values.empty()) return fail(place, place.column, fmt::format("{} needs a value in brackets, e.g. [#1 LT 5]", name_of(place.word)));
    value = values.front();
    return true;
}

/// The label of a call that computes it is a number.
bool Walk::label_of_call(const FlowPlace& place, Interpreter& interpreter, std::string& label) {
    FlowLine words;
    if (!read_flow(place.text, place.column, words, problem_)) return false;
    label = words.label;
    if (!words.computed) return true;
    const KnownValues known(interpreter);
    ExpressionReader reader(place.text, known);
    const char* at = place.text.data() + place.column + 1;
    double value = 0;
    if (!reader.value(at, value)) return fail(place, reader.fault_at(), reader.fault());
    if (value < 0 || value != std::floor(value) || value > largest_number)
        return fail(place, place.column, fmt::format("o{:.6g}: the number of a sub is whole, 0 or more", value));
    label = fmt::format("{:.0f}", value);
    return true;
}

bool Walk::call(const FlowPlace& place, Interpreter& interpreter) {
    std::string label;
    Target target{};
    std::vector<double> values;
    if (!label_of_call(place, interpreter, label) || !find_sub(place, label, target) || !arguments(place, most_arguments, interpreter, values)) return false;
    if (!interpreter.parameters().enter(values))
        return fail(place, place.column, fmt::format("o{} call: {} calls stand in each other; does the sub call itself without end?", label, deepest_call));
    interpreter.parameters().forget_returned();
    frames_.push_back({lines_, source_, repeats_.size(), called_at_});
    if (called_at_ == 0 && target.source != source_) called_at_ = lines_.number();
    source_ = target.source;
    jump(place_at(target.place));
    return true;
}

/// A sub of the same text, of one read before, or of a file of its own.
bool Walk::find_sub(const FlowPlace& place, const std::string& label, Target& target) {
    const auto look = [&](Source* source) {
        if (!source->index) return false;
        const auto found = source->index->subs.find(label);
        if (found == source->index->subs.end()) return false;
        target = {source, found->second};
        return true;
    };
    if (look(source_)) return true;
    for (const auto& source : sources_)
        if (look(source.get())) return true;
    return load(place, label, target);
}

bool Walk::load(const FlowPlace& place, const std::string& label, Target& target) {
    const std::string name(without_marks(label));
    if (!subprogram_) {
        return fail(place, place.column, fmt::format("o{} call: this program has no o{} sub, and it came without a folder in which another file could have it; put the "
                                                     "sub into it",
                                                     label, label));
    }
    if (!is_plain(name)) {
        return fail(place, place.column, fmt::format("o{} call: this program has no o{} sub, and the name is none of a file in its folder (letters, digits, '_', '-' and '.')",
                                                     label, label));
    }
    if (sources_.size() > most_files) return fail(place, place.column, fmt::format("a program may use {} files of subprograms; this is one more", most_files));
    Result<std::string> text = subprogram_(name);
    if (!text) return fail(place, place.column, fmt::format("o{} call: this program has no o{} sub, and {}", label, label, text.error().message));
    auto source = std::make_unique<Source>();
    source->kept = std::move(*text);
    source->text = source->kept;
    source->file = name + ".ngc";
    Source& kept = *sources_.emplace_back(std::move(source));
    if (!make_index(kept)) {
        problem_ = take_fault();
        return false;
    }
    const auto found = kept.index->subs.find(label);
    if (found == kept.index->subs.end())
        return fail(place, place.column, fmt::format("o{} call: {} has no o{} sub", label, kept.file, label));
    target = {&kept, found->second};
    return true;
}

bool Walk::give_back(const FlowPlace& place, Interpreter& interpreter) {
    std::vector<double> values;
    bool good = arguments(place, 1, interpreter, values);
    if (frames_.empty()) return good;
    if (!interpreter.leave_call(values.empty() ? std::nullopt : std::optional<double>(values.front()))) {
        good = fail(place, place.column, "M73 brings back another plane, unit, work offset or feed mode here, which cannot change while cutter compensation is on; "
                                         "write G40 and a straight move before the sub ends");
    }
    const Frame& frame = frames_.back();
    lines_ = frame.back;
    counted_from_ = lines_.number();
    source_ = frame.source;
    called_at_ = frame.called_at;
    repeats_.resize(frame.repeats);
    frames_.pop_back();
    return good;
}

}  // namespace motionrack::control::gcode
