// Language elements beyond words with numbers: values from parameters, assignments, O words, and comments with values.
#include <fmt/format.h>

#include <cmath>
#include <motionrack/control/gcode/language/machine_parameters.hpp>
#include <motionrack/control/gcode/scanner.hpp>

namespace motionrack::control::gcode {

namespace {

/// Maximum distance of a computed code, G[#1], from a tenth.
constexpr double code_slack = 0.001;

bool begins_with(std::string_view text, std::string_view word) {
    if (text.size() < word.size()) return false;
    for (std::size_t i = 0; i < word.size(); ++i)
        if ((is_letter(text[i]) ? upper(text[i]) : text[i]) != word[i]) return false;
    return true;
}

}  // namespace

/// Scans a word whose number is not a plain one.
bool Scanner::word_of_language(char letter, std::size_t column, const Number& plain) {
    if (options_.language == Language::words || plain.fault != NumberFault::no_digits)
        return bad_number(plain, letter, column);
    ExpressionParser reader(text_, *options_.parameters);
    if (!reader.begins(at_)) return bad_number(plain, letter, column);
    double value = 0;
    if (!reader.value(at_, value)) return fail_at(reader.fault_at(), GrblStatus::bad_number, reader.fault());
    if (std::fabs(value) > largest_number) {
        return fail_at(
            column, GrblStatus::bad_number,
            fmt::format("{} evaluates to {:.6g}; the largest number is 1000000000", word_at(text_, column), value));
    }
    Number number;
    number.value = value;
    const double tenths = std::floor(value * 10 + 0.5);
    number.exact = std::fabs(value * 10 - tenths) < code_slack * 10;
    number.mantissa = static_cast<std::int64_t>(tenths);
    number.decimals = 1;
    return take(letter, column, number);
}

/// Scans an assignment, #1 = 2. It takes effect after the whole line was read, so the line still has the previous
/// value.
bool Scanner::assignment() {
    const std::size_t column = here();
    ExpressionParser reader(text_, *options_.parameters);
    Assignment found;
    if (!reader.parameter(at_, found.parameter))
        return fail_at(reader.fault_at(), GrblStatus::bad_number, reader.fault());
    if (at_ == end_ || *at_ != '=') {
        return fail_at(column, GrblStatus::expected_letter,
                       "a parameter alone has no effect; write a letter before it (X#1) or give it a value (#1 = 2)");
    }
    ++at_;
    if (!reader.value(at_, found.value)) return fail_at(reader.fault_at(), GrblStatus::bad_number, reader.fault());
    const ParameterName& name = found.parameter;
    if (name.number > 0 ? MachineParameters::is_read_only(name.number) : MachineParameters::is_read_only(name.name)) {
        return fail_at(
            column, GrblStatus::unsupported,
            fmt::format("{} is a read-only value of the machine; offsets are set by G10 and G92, reference points "
                        "by G28.1 and G30.1",
                        name.number > 0 ? fmt::format("#{}", name.number) : fmt::format("#<{}>", name.name)));
    }
    block_.assignments.push_back(std::move(found));
    return true;
}

/// Scans an O word, which must be first on its line; ProgramFlow reads the rest of the line.
bool Scanner::o_word(std::size_t column) {
    if ((block_.words & ~letter_bit('N')) != 0 || (block_.g_groups | block_.m_groups) != 0 ||
        !block_.assignments.empty()) {
        return fail_at(column, GrblStatus::unsupported,
                       "an O word must be first on its line; put the words before it on a separate line");
    }
    block_.has_o_word = true;
    block_.flow_column = static_cast<std::uint16_t>(column);
    at_ = end_;
    return true;
}

/// Detects (MSG,text), and where the language has parameters (DEBUG,text) and (PRINT,text).
bool Scanner::comment_kind(std::string_view body, Comment& found) {
    const bool values =
        options_.language != Language::words && (begins_with(body, "DEBUG,") || begins_with(body, "PRINT,"));
    if (!values && !begins_with(body, "MSG,")) return true;
    found.message = true;
    found.values = values;
    found.text = body.substr(body.find(',') + 1);
    return true;
}

}  // namespace motionrack::control::gcode
