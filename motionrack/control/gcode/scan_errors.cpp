// Error messages for lines that cannot be divided into words.
#include <fmt/format.h>

#include <motionrack/control/gcode/scanner.hpp>

namespace motionrack::control::gcode {

bool Scanner::repeated(char letter, std::size_t column) {
    return fail_at(
        column, GrblStatus::word_repeated,
        fmt::format("{} is the second {} word on this line (the first is {}); a line takes one, leave one out",
                    word_at(text_, column), letter, word_at(text_, block_.column[letter_index(letter)])));
}

bool Scanner::bad_number(const Number& number, char letter, std::size_t column) {
    const std::string_view written = word_at(text_, column);
    if (number.fault == NumberFault::two_points) {
        return fail_at(column, GrblStatus::bad_number,
                       fmt::format("{}: the number has two decimal points; write e.g. {}1.5", written, letter));
    }
    if (number.fault == NumberFault::too_large) {
        return fail_at(column, GrblStatus::bad_number,
                       fmt::format("{}: the number is too large; the largest is 1000000000", written));
    }
    if (at_ < end_ && (*at_ == '#' || *at_ == '[')) {
        return fail_at(
            column, GrblStatus::bad_number,
            fmt::format(
                "{}{}: lines from a sender must not have parameters and expressions; run the program as a file, or "
                "write the number out, e.g. {}12.5",
                letter, *at_, letter));
    }
    return fail_at(
        column, GrblStatus::bad_number,
        fmt::format("{} has no number (digits with at most one decimal point); write e.g. {}12.5", written, letter));
}

bool Scanner::bad_letter(char letter, std::size_t column) {
    if (letter == 'E' && column > 0 && (is_digit(text_[column - 1]) || text_[column - 1] == '.')) {
        std::size_t begin = column;
        while (begin > 0 && !is_letter(text_[begin - 1])) --begin;
        if (begin > 0) --begin;
        return fail_at(begin, GrblStatus::bad_number,
                       fmt::format("{}{}: numbers of G-code have no exponent; write 1000, not 1e3",
                                   text_.substr(begin, column - begin), word_at(text_, column)));
    }
    if (letter == 'O') {
        return fail_at(column, GrblStatus::unsupported,
                       "lines from a sender must not have O words (subprograms, loops, conditions); run the program as "
                       "a file, or write the lines out");
    }
    const char* hint = letter == 'E'                                     ? "; the machine has no extruder"
                       : letter == 'U' || letter == 'V' || letter == 'W' ? "; axes are X Y Z A B C"
                                                                         : "";
    return fail_at(column, GrblStatus::unsupported,
                   fmt::format("{}: unknown word {}{}", word_at(text_, column), letter, hint));
}

bool Scanner::bad_character() {
    const auto c = static_cast<unsigned char>(*at_);
    const std::size_t column = here();
    if (c == '#' || c == '[' || c == ']' || c == '=' || c == '<' || c == '>') {
        return fail_at(column, GrblStatus::unsupported,
                       options_.language == Language::words
                           ? fmt::format("'{}': lines from a sender must not have parameters and expressions; run the "
                                         "program as a file, or write the numbers out",
                                         static_cast<char>(c))
                           : fmt::format("'{}' is not expected here; an expression follows a letter, e.g. X[#1 + "
                                         "2], and #1 = 2 gives a value to #1",
                                         static_cast<char>(c)));
    }
    if (c == '$') {
        return fail_at(column, GrblStatus::system_command,
                       "'$' begins a system command of Grbl, which is not part of a program; leave the line out");
    }
    if (c == '*')
        return fail_at(column, GrblStatus::expected_letter, "'*': checksums are not supported; leave them out");
    if (c == ')') return fail_at(column, GrblStatus::expected_letter, "')' without '(' before it; take it out");
    constexpr std::string_view of_numbers = "0123456789.-+";
    if (of_numbers.find(*at_) != std::string_view::npos) {
        const std::string_view behind = text_.substr(column, 20);
        const std::string_view number = behind.substr(0, behind.find_first_not_of(of_numbers));
        return fail_at(column, GrblStatus::expected_letter,
                       fmt::format("{} has no letter before it; write e.g. X{}", number, number));
    }
    if (c < 0x20 || c >= 0x7f) {
        return fail_at(
            column, GrblStatus::expected_letter,
            fmt::format("byte 0x{:02X} is not a character of G-code (ASCII only, UTF-8 in comments); is this a text "
                        "file?",
                        c));
    }
    return fail_at(
        column, GrblStatus::expected_letter,
        fmt::format("'{}' is not expected here; a word is a letter and a number, e.g. X12.5", static_cast<char>(c)));
}

}  // namespace motionrack::control::gcode
