// Scanner for a line of G-code, shared by scan.cpp, scan_errors.cpp and language/scan_language.cpp.
#pragma once

#include <motionrack/control/gcode/block.hpp>
#include <motionrack/control/gcode/number.hpp>

namespace motionrack::control::gcode {

inline bool is_letter(char c) {
    return static_cast<unsigned char>((c | 0x20) - 'a') < 26;
}

inline char upper(char c) {
    return static_cast<char>(c & ~0x20);
}

/// State of the scan of one line; every method returns false after it has filled the problem.
class Scanner {
  public:
    Scanner(std::string_view text, const ScanOptions& options, Block& block, Problem& problem)
        : text_(text),
          at_(text.data()),
          end_(text.data() + text.size()),
          options_(options),
          block_(block),
          problem_(problem) {}

    bool scan();

  private:
    bool take(char letter, std::size_t column, const Number& number) {
        if (letter == 'G') return code_g(number, column);
        if (letter == 'M') return code_m(number, column);
        if (block_.has(letter)) return repeated(letter, column);
        block_.words |= letter_bit(letter);
        block_.value[letter_index(letter)] = number.value;
        block_.column[letter_index(letter)] = static_cast<std::uint16_t>(column);
        return true;
    }
    bool code_g(const Number& number, std::size_t column);
    bool code_m(const Number& number, std::size_t column);
    bool other();
    bool comment();
    bool comment_kind(std::string_view body, Comment& found);
    bool word_of_language(char letter, std::size_t column, const Number& plain);
    bool assignment();
    bool o_word(std::size_t column);
    bool slash();
    bool bad_number(const Number& number, char letter, std::size_t column);
    bool bad_letter(char letter, std::size_t column);
    bool bad_character();
    bool repeated(char letter, std::size_t column);
    bool fail_at(std::size_t column, GrblStatus status, std::string message) {
        set_problem(problem_, text_, column, status, std::move(message));
        return false;
    }
    std::size_t here() const { return static_cast<std::size_t>(at_ - text_.data()); }
    bool nothing_yet() const {
        return (block_.words | block_.g_groups | block_.m_groups) == 0 && block_.assignments.empty();
    }

    std::string_view text_;
    const char* at_;
    const char* end_;
    const ScanOptions& options_;
    Block& block_;
    Problem& problem_;
};

}  // namespace motionrack::control::gcode
