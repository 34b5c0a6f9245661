// Parses O words.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <motionrack/control/gcode/language/oword.hpp>
#include <motionrack/control/gcode/number.hpp>
#include <motionrack/control/gcode/scanner.hpp>
#include <span>
#include <utility>

namespace motionrack::control::gcode {

namespace {

/// Names of the O words, in the order of OWord.
constexpr std::array<std::string_view, 16> names = {
    "sub",   "endsub",   "call", "return", "if",        "elseif", "else",     "endif",
    "while", "endwhile", "do",   "repeat", "endrepeat", "break",  "continue", "(a numbered program)"};
/// Number of names that stand in a program.
constexpr std::size_t of_words = 15;

void skip_blanks(std::string_view text, std::size_t& at) {
    while (at < text.size() && is_blank(text[at])) ++at;
}

/// Skips blanks and closed comments.
void skip_comments(std::string_view text, std::size_t& at) {
    for (skip_blanks(text, at); at < text.size() && text[at] == '('; skip_blanks(text, at)) {
        const std::size_t close = text.find(')', at);
        if (close == std::string_view::npos) return;
        at = close + 1;
    }
}

/// Returns the start of a line behind '/' and comments; its size if it is empty or deleted.
std::size_t find_first(std::string_view text, bool block_delete) {
    std::size_t at = 0;
    skip_comments(text, at);
    if (at == text.size() || text[at] != '/') return at;
    if (block_delete) return text.size();
    ++at;
    skip_comments(text, at);
    return at;
}

/// Returns the end of a computed label: skips paired brackets, names and digits.
std::size_t end_of_value(std::string_view text, std::size_t at) {
    int open = 0;
    for (; at < text.size(); ++at) {
        const char c = text[at];
        open += (c == '[' || c == '<') - (c == ']' || c == '>');
        if (open == 0 && is_letter(c)) break;
    }
    return at;
}

}  // namespace

std::string_view name_of(OWord word) {
    return names[static_cast<std::size_t>(word)];
}

bool is_rest_empty(std::string_view text, std::size_t at) {
    skip_comments(text, at);
    return at == text.size() || text[at] == ';';
}

bool ProgramEndDetector::is_at(std::string_view line) {
    const std::size_t at = find_first(line, block_delete_);
    if (at >= line.size() || line[at] == ';') return false;
    return std::exchange(begun_, true) && line[at] == '%';
}

std::size_t find_oword(std::string_view text, bool block_delete) {
    std::size_t at = find_first(text, block_delete);
    if (at < text.size() && upper(text[at]) == 'N') {
        for (++at; at < text.size() && (is_digit(text[at]) || is_blank(text[at])); ++at) continue;
        skip_comments(text, at);
    }
    return at < text.size() && upper(text[at]) == 'O' ? at : std::string_view::npos;
}

bool parse_oword(std::string_view text, std::size_t column, OWordStatement& line, Problem& problem) {
    const auto fail = [&](std::size_t at, std::string message) {
        set_problem(problem, text, at, GrblStatus::unsupported, std::move(message));
        return false;
    };
    line.column = static_cast<std::uint16_t>(column);
    std::size_t at = column + 1;
    skip_blanks(text, at);
    const std::size_t label_at = at;
    if (at < text.size() && text[at] == '<') {
        const std::size_t close = text.find('>', at);
        if (close == std::string_view::npos)
            return fail(column, "the name of this O word is not closed: '>' is missing");
        for (; at <= close; ++at)
            if (!is_blank(text[at])) line.label += to_lower(text[at]);
    } else if (at < text.size() && (text[at] == '#' || text[at] == '[')) {
        line.computed = true;
        at = end_of_value(text, at);
    } else {
        for (; at < text.size() && (is_digit(text[at]) || is_blank(text[at])); ++at) {
            if (line.label == "0") line.label.clear();  // o0100 is o100
            if (is_digit(text[at])) line.label += text[at];
        }
    }
    if (!line.computed && (line.label.empty() || line.label == "<>"))
        return fail(column, "an O word needs a number or a name, e.g. o100 or o<drill>");
    skip_blanks(text, at);
    std::string word;
    for (; at < text.size() && is_letter(text[at]); ++at) word += to_lower(text[at]);
    const auto words = std::span(names).first<of_words>();
    const auto found = std::find(words.begin(), words.end(), word);
    const bool numbered = word.empty() && is_digit(text[label_at]) && is_rest_empty(text, at);
    if (found == words.end() && !numbered) {
        return fail(column, word.empty() ? fmt::format("o{} has no effect alone; it needs one of {}",
                                                       text.substr(label_at, at - label_at), fmt::join(words, " "))
                                         : fmt::format("'{}' is not valid after an O word; known are {}", word,
                                                       fmt::join(words, " ")));
    }
    line.word = numbered ? OWord::numbered : static_cast<OWord>(found - words.begin());
    line.rest = static_cast<std::uint16_t>(at);
    if (line.computed && line.word != OWord::call)
        return fail(column, fmt::format("only a call may compute its O number; {} needs a number or a name",
                                        name_of(line.word)));
    return true;
}

}  // namespace motionrack::control::gcode
