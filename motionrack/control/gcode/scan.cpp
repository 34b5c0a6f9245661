// Taking a line of G-code apart: one pass over its characters, no allocation unless there is a comment or a fault.
#include <fmt/format.h>

#include <motionrack/control/gcode/block.hpp>
#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/number.hpp>

namespace motionrack::control::gcode {

namespace {

constexpr std::uint32_t value_letters = axis_words | offset_words | letter_bit('D') | letter_bit('F') | letter_bit('L') |
                                        letter_bit('N') | letter_bit('P') | letter_bit('Q') | letter_bit('R') |
                                        letter_bit('S') | letter_bit('T');

bool is_letter(char c) {
    return static_cast<unsigned char>((c | 0x20) - 'a') < 26;
}

char upper(char c) {
    return static_cast<char>(c & ~0x20);
}

/// A line being taken apart; every method returns false after it has filled the problem.
class Scanner {
  public:
    Scanner(std::string_view text, Block& block, Problem& problem)
        : text_(text), at_(text.data()), end_(text.data() + text.size()), block_(block), problem_(problem) {}

    bool scan(bool block_delete);

  private:
    bool word();
    bool code_g(const Number& number, std::size_t column);
    bool code_m(const Number& number, std::size_t column);
    bool other(bool block_delete);
    bool comment();
    bool slash(bool block_delete);
    bool bad_number(const Number& number, char letter, std::size_t column);
    bool bad_letter(char letter, std::size_t column);
    bool bad_character();
    bool repeated(char letter, std::size_t column);
    bool fail_at(std::size_t column, GrblStatus status, std::string message) {
        set_problem(problem_, text_, column, status, std::move(message));
        return false;
    }
    std::size_t here() const { return static_cast<std::size_t>(at_ - text_.data()); }
    bool nothing_yet() const { return (block_.words | block_.g_groups | block_.m_groups) == 0; }

    std::string_view text_;
    const char* at_;
    const char* end_;
    Block& block_;
    Problem& problem_;
};

bool Scanner::scan(bool block_delete) {
    while (at_ < end_) {
        const char c = *at_;
        if (is_letter(c)) {
            if (!word()) return false;
        } else if (is_blank(c)) {
            ++at_;
        } else if (!other(block_delete)) {
            return false;
        }
    }
    return true;
}

bool Scanner::word() {
    const char letter = upper(*at_);
    const std::size_t column = here();
    ++at_;
    while (at_ < end_ && is_blank(*at_)) ++at_;
    const std::uint32_t bit = letter_bit(letter);
    if ((bit & (value_letters | letter_bit('G') | letter_bit('M'))) == 0) return bad_letter(letter, column);
    const Number number = scan_number(at_, end_);
    if (number.fault != NumberFault::none) return bad_number(number, letter, column);
    if (letter == 'G') return code_g(number, column);
    if (letter == 'M') return code_m(number, column);
    if ((block_.words & bit) != 0) return repeated(letter, column);
    block_.words |= bit;
    block_.value[letter_index(letter)] = number.value;
    block_.column[letter_index(letter)] = static_cast<std::uint16_t>(column);
    return true;
}

/// The code in tenths, or -1 where it has more decimals or is out of the table.
int tenths_of(const Number& number) {
    if (!number.exact || number.mantissa < 0) return -1;
    std::int64_t mantissa = number.mantissa;
    std::int32_t decimals = number.decimals;
    while (decimals > 1 && mantissa % 10 == 0) {
        mantissa /= 10;
        --decimals;
    }
    if (decimals > 1 || mantissa >= 10'000) return -1;
    return static_cast<int>(decimals == 0 ? mantissa * 10 : mantissa);
}

bool Scanner::code_g(const Number& number, std::size_t column) {
    const int tenths = tenths_of(number);
    const GroupG group = group_of_g(tenths);
    if (group >= g_group_count) {
        const bool named = tenths >= 0 && tenths < 1000;
        const GrblStatus status = tenths >= 591 && tenths <= 593 ? GrblStatus::no_such_system : GrblStatus::unsupported;
        return fail_at(
            column, status,
            named ? why_not_g(tenths)
                  : fmt::format("{} is not a known command; nothing of this line was done", word_at(text_, column)));
    }
    constexpr std::int16_t end_of_cycle = 800;
    if (group == g_motion && block_.has_g(group) && tenths == end_of_cycle && block_.g[group] != end_of_cycle)
        return true;
    const bool replaces =
        group == g_motion && block_.has_g(group) && block_.g[group] == end_of_cycle && tenths != end_of_cycle;
    if (block_.has_g(group) && !replaces) {
        return fail_at(column, GrblStatus::modal_group,
                       fmt::format("{} and {} exclude each other: a line takes one of {}; put them on two lines",
                                   name_of_g(block_.g[group]), name_of_g(tenths), members_of_g(group)));
    }
    block_.g_groups |= 1u << group;
    block_.g[group] = static_cast<std::int16_t>(tenths);
    block_.g_column[group] = static_cast<std::uint16_t>(column);
    return true;
}

bool Scanner::code_m(const Number& number, std::size_t column) {
    const int tenths = tenths_of(number);
    const int code = tenths >= 0 && tenths % 10 == 0 ? tenths / 10 : -1;
    const GroupM group = group_of_m(code);
    if (group == m_unknown) {
        return fail_at(column, GrblStatus::unsupported,
                       code >= 0 ? why_not_m(code)
                                 : fmt::format("{} is not a known command; known are M0 M1 M2 M3 M4 M5 M6 M7 M8 M9 M30",
                                               word_at(text_, column)));
    }
    constexpr std::uint32_t coolants = 1u << m_mist | 1u << m_flood;
    const bool clash = (group == m_coolant_off && (block_.m_groups & coolants) != 0) ||
                       ((group == m_mist || group == m_flood) && block_.has_m(m_coolant_off));
    if (block_.has_m(group) || clash) {
        const int first = block_.has_m(group) ? block_.m[group] : group == m_coolant_off ? 8 : 9;
        return fail_at(
            column, GrblStatus::modal_group,
            clash ? fmt::format("M{} with M7 or M8 on one line: coolant cannot go on and off at once", code)
                  : fmt::format("M{} and M{} exclude each other: a line takes one of {}; put them on two lines", first,
                                code, members_of_m(group)));
    }
    block_.m_groups |= 1u << group;
    block_.m[group] = static_cast<std::int16_t>(code);
    block_.m_column[group] = static_cast<std::uint16_t>(column);
    return true;
}

bool Scanner::other(bool block_delete) {
    switch (*at_) {
        case '(':
        case ';':
            return comment();
        case '/':
            return slash(block_delete);
        case '%':
            if (text_.find_first_not_of(" \t", here() + 1) != std::string_view::npos || !nothing_yet()) {
                return fail_at(here(), GrblStatus::unsupported,
                               "% must stand alone on its line; it marks the beginning and the end of a program");
            }
            block_.percent = true;
            ++at_;
            return true;
        default:
            return bad_character();
    }
}

bool Scanner::slash(bool block_delete) {
    if (text_.find_first_not_of(" \t") != here()) {
        return fail_at(here(), GrblStatus::unsupported,
                       "'/' (block delete) must be the first character of the line; division is not supported");
    }
    ++at_;
    if (block_delete) {
        block_.deleted = true;
        at_ = end_;
    }
    return true;
}

bool Scanner::comment() {
    const std::size_t open = here();
    const bool rest = *at_ == ';';
    const std::size_t close = rest ? text_.size() : text_.find(')', open);
    if (close == std::string_view::npos) {
        return fail_at(open, GrblStatus::unsupported,
                       "this comment is not closed: ')' is missing (a comment ends on the line where it begins)");
    }
    Comment found;
    found.text = text_.substr(open + 1, close - open - 1);
    found.rest_of_line = rest;
    for (std::size_t i = 0; i < found.text.size(); ++i) {
        const auto c = static_cast<unsigned char>(found.text[i]);
        if (c == '(' && !rest) {
            return fail_at(open + 1 + i, GrblStatus::unsupported,
                           "'(' inside a comment: comments do not nest; take it out or use [ ]");
        }
        if ((c < 0x20 && c != '\t') || c == 0x7f) {
            at_ += 1 + i;
            return bad_character();
        }
    }
    std::string_view body = found.text;
    while (!body.empty() && is_blank(body.front())) body.remove_prefix(1);
    if (!rest && body.size() >= 4 && upper(body[0]) == 'M' && upper(body[1]) == 'S' && upper(body[2]) == 'G' &&
        body[3] == ',') {
        found.message = true;
        found.text = body.substr(4);
    }
    block_.comments.push_back(found);
    at_ = text_.data() + close + (rest ? 0 : 1);
    return true;
}

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
        return fail_at(column, GrblStatus::bad_number,
                       fmt::format("{}{}: variables and expressions are not supported; let the CAM program or LinuxCNC "
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
                       "O words (program numbers, subprograms, loops) are not supported; write the lines out, and a "
                       "program's name as a comment");
    }
    const char* hint = letter == 'H'                                     ? "; there is no tool table"
                       : letter == 'E'                                   ? "; there is no extruder"
                       : letter == 'U' || letter == 'V' || letter == 'W' ? "; axes are X Y Z A B C"
                                                                         : "";
    return fail_at(column, GrblStatus::unsupported,
                   fmt::format("{}: there is no word {}{}", word_at(text_, column), letter, hint));
}

bool Scanner::bad_character() {
    const auto c = static_cast<unsigned char>(*at_);
    const std::size_t column = here();
    if (c == '#' || c == '[' || c == ']' || c == '=' || c == '<' || c == '>') {
        return fail_at(
            column, GrblStatus::unsupported,
            fmt::format("'{}': variables and expressions are not supported; let the CAM program or LinuxCNC write "
                        "the numbers out",
                        static_cast<char>(c)));
    }
    if (c == '$') {
        return fail_at(column, GrblStatus::system_command,
                       "'$' begins a system command of Grbl, which is no part of a program; leave the line out");
    }
    if (c == '*')
        return fail_at(column, GrblStatus::expected_letter, "'*': checksums are not supported; leave them out");
    if (c == ')') return fail_at(column, GrblStatus::expected_letter, "')' without '(' before it; take it out");
    if (is_digit(static_cast<char>(c)) || c == '.' || c == '-' || c == '+') {
        std::size_t stop = column;
        while (stop < text_.size() && stop < column + 20 && !is_letter(text_[stop]) && !is_blank(text_[stop])) ++stop;
        return fail_at(column, GrblStatus::expected_letter,
                       fmt::format("{} has no letter before it; write e.g. X{}", text_.substr(column, stop - column),
                                   text_.substr(column, stop - column)));
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

}  // namespace

bool scan_line(std::string_view text, bool block_delete, Block& block, Problem& problem) {
    block.text = text;
    block.words = block.g_groups = block.m_groups = 0;
    block.percent = block.deleted = false;
    if (!block.comments.empty()) block.comments.clear();
    if (text.size() > longest_line) {
        set_problem(
            problem, text, longest_line, GrblStatus::line_too_long,
            fmt::format("the line is longer than {} characters; break it up (is this a G-code file?)", longest_line));
        problem.word.clear();
        return false;
    }
    return Scanner(text, block, problem).scan(block_delete);
}

std::string_view word_at(std::string_view text, std::size_t column) {
    if (column >= text.size()) return {};
    std::size_t stop = column + 1;
    const auto part_of_number = [](char c) { return is_digit(c) || is_blank(c) || c == '.' || c == '-' || c == '+'; };
    while (is_letter(text[column]) && stop < text.size() && part_of_number(text[stop])) ++stop;
    while (stop > column + 1 && is_blank(text[stop - 1])) --stop;
    return text.substr(column, stop - column);
}

void set_problem(Problem& problem, std::string_view text, std::size_t column, GrblStatus status, std::string message,
                 Trouble trouble) {
    problem.trouble = trouble;
    problem.message = std::move(message);
    problem.place = {0, static_cast<int>(column) + 1};
    problem.status = status;
    problem.word = std::string(word_at(text, column));
}

}  // namespace motionrack::control::gcode
