// Divides a line of G-code in one pass, without allocation unless there is a comment or an error.
#include <fmt/format.h>

#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/scanner.hpp>
#include <motionrack/control/gcode/words.hpp>

namespace motionrack::control::gcode {

namespace {

constexpr std::uint32_t word_letters = axis_words | offset_words | letter_bit('D') | letter_bit('F') | letter_bit('L') |
                                       letter_bit('N') | letter_bit('P') | letter_bit('Q') | letter_bit('R') |
                                       letter_bit('S') | letter_bit('T') | letter_bit('G') | letter_bit('M') |
                                       letter_bit('H') | letter_bit('E');

/// Returns the code in tenths, or -1 with more decimals or outside the table.
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

}  // namespace

bool Scanner::code_g(const Number& number, std::size_t column) {
    const int tenths = tenths_of(number);
    const GroupG group = group_of_g(tenths);
    if (group >= g_group_count || (options_.language == Language::words && !is_for_senders(tenths))) {
        const bool named = tenths >= 0 && tenths < 1000;
        const GrblStatus status = group == g_system ? GrblStatus::no_such_system : GrblStatus::unsupported;
        return fail_at(
            column, status,
            named ? why_not_g(tenths)
                  : fmt::format("{} is not a known command; the line was not executed", word_at(text_, column)));
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
    const bool beyond_senders = options_.language == Language::words && code > max_m_of_senders;
    if (group == m_unknown || beyond_senders) {
        return fail_at(
            column, GrblStatus::unsupported,
            group != m_unknown ? fmt::format("M{}: lines from a sender may use M0 to M{}; run the program as a file",
                                             code, max_m_of_senders)
            : code >= 0
                ? why_not_m(code)
                : fmt::format("{} is not a known command; known are {}", word_at(text_, column), known_m_codes()));
    }
    constexpr std::uint32_t coolants = 1u << m_mist | 1u << m_flood;
    const bool clash = (group == m_coolant_off && (block_.m_groups & coolants) != 0) ||
                       ((group == m_mist || group == m_flood) && block_.has_m(m_coolant_off));
    if (block_.has_m(group) || clash) {
        const int first = block_.has_m(group) ? block_.m[group] : group == m_coolant_off ? 8 : 9;
        return fail_at(
            column, GrblStatus::modal_group,
            clash ? fmt::format("M{} with M7 or M8 on one line: coolant cannot be turned on and off at once", code)
                  : fmt::format("M{} and M{} exclude each other: a line takes one of {}; put them on two lines", first,
                                code, members_of_m(group)));
    }
    block_.m_groups |= 1u << group;
    block_.m[group] = static_cast<std::int16_t>(code);
    block_.m_column[group] = static_cast<std::uint16_t>(column);
    return true;
}

bool Scanner::other() {
    switch (*at_) {
        case '(':
        case ';':
            return comment();
        case '#':
            return options_.language == Language::words ? bad_character() : assignment();
        case '/':
            return slash();
        case '%':
            if (text_.find_first_not_of(" \t", here() + 1) != std::string_view::npos || !nothing_yet()) {
                return fail_at(here(), GrblStatus::unsupported,
                               "% must be alone on its line; it marks the beginning and the end of a program");
            }
            block_.percent = true;
            ++at_;
            return true;
        default:
            return bad_character();
    }
}

bool Scanner::slash() {
    if (text_.find_first_not_of(" \t") != here()) {
        return fail_at(here(), GrblStatus::unsupported,
                       options_.language == Language::words
                           ? "'/' (block delete) must be the first character of the line"
                           : "'/' is block delete only as the first character of the line; a division stands in "
                             "brackets, e.g. X[#1 / 2]");
    }
    ++at_;
    if (options_.block_delete) {
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
    if (!rest && !comment_kind(body, found)) return false;
    block_.comments.push_back(found);
    at_ = text_.data() + close + (rest ? 0 : 1);
    return true;
}

/// Inlined into its only caller, because most of the reading time is spent here.
[[gnu::always_inline]] inline bool Scanner::scan() {
    while (at_ < end_) {
        const char c = *at_;
        if (is_letter(c)) {
            const char letter = upper(c);
            const std::size_t column = here();
            ++at_;
            while (at_ < end_ && is_blank(*at_)) ++at_;
            if ((letter_bit(letter) & word_letters) == 0 ||
                ((letter == 'H' || letter == 'E') && options_.language == Language::words)) {
                if (letter == 'O' && options_.language == Language::program ? o_word(column)
                                                                            : bad_letter(letter, column))
                    continue;
                return false;
            }
            const Number number = scan_number(at_, end_);
            if (number.fault == NumberFault::none ? !take(letter, column, number)
                                                  : !word_of_language(letter, column, number))
                return false;
        } else if (is_blank(c)) {
            ++at_;
        } else if (!other()) {
            return false;
        }
    }
    return true;
}

bool scan_line(std::string_view text, const ScanOptions& options, Block& block, Problem& problem) {
    block.text = text;
    block.words = block.g_groups = block.m_groups = 0;
    block.percent = block.deleted = block.has_o_word = false;
    if (!block.comments.empty()) block.comments.clear();
    if (!block.assignments.empty()) block.assignments.clear();
    if (text.size() > max_line_length) {
        set_problem(problem, text, max_line_length, GrblStatus::line_too_long,
                    fmt::format("the line is longer than {} characters; break it up (is this a G-code file?)",
                                max_line_length));
        problem.word.clear();
        return false;
    }
    return Scanner(text, options, block, problem).scan();
}

std::string_view word_at(std::string_view text, std::size_t column) {
    if (column >= text.size()) return {};
    std::size_t stop = column + 1;
    const auto part_of_number = [](char c) { return is_digit(c) || is_blank(c) || c == '.' || c == '-' || c == '+'; };
    while (is_letter(text[column]) && stop < text.size() && part_of_number(text[stop])) ++stop;
    if (is_letter(text[column]) && stop < text.size() && (text[stop] == '[' || text[stop] == '#')) {
        const std::size_t close = text.find_first_of(text[stop] == '[' ? "]" : " \t>", stop);
        stop = close == std::string_view::npos ? text.size() : close + 1;
    }
    while (stop > column + 1 && is_blank(text[stop - 1])) --stop;
    return text.substr(column, stop - column);
}

void set_problem(Problem& problem, std::string_view text, std::size_t column, GrblStatus status, std::string message,
                 ErrorKind trouble) {
    problem.kind = trouble;
    problem.message = std::move(message);
    problem.location = {0, static_cast<int>(column) + 1};
    problem.status = status;
    problem.word = std::string(word_at(text, column));
}

}  // namespace motionrack::control::gcode
