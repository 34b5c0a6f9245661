// The words of the line under interpretation: those that a code of the line has used, and the error of the line.
#pragma once

#include <array>
#include <motionrack/control/gcode/block.hpp>
#include <string>
#include <string_view>

namespace motionrack::control::gcode {

class LineWords {
  public:
    /// Divides a line into words; see scan_line().
    bool scan(std::string_view text, const ScanOptions& options) { return scan_line(text, options, block_, problem_); }
    void begin_line(std::int32_t number, Language language) {
        number_ = number;
        language_ = language;
    }
    /// Marks the words that need no other word on their line as used, the others as unused.
    void begin_interpretation() {
        used_ = letter_bit('F') | letter_bit('N') | letter_bit('S') | letter_bit('T');
        axis_words_taken_ = false;
    }

    const Block& block() const { return block_; }
    std::int32_t number() const { return number_; }
    Language language() const { return language_; }

    void use(std::uint32_t letters) { used_ |= letters; }
    /// Uses words that only one code of the line may use: `code` is a G code in tenths, or ~ of an M code. Refuses the
    /// line if another code has claimed one of them.
    bool claim(std::uint32_t letters, std::int16_t code);
    /// Marks the axis words as used by a code that is not a move.
    void take_axis_words() {
        axis_words_taken_ = true;
        used_ |= axis_words;
    }
    bool axis_words_taken() const { return axis_words_taken_; }

    // Each of the following stores the error of the line; all but the last two return false then.
    bool fail_at(std::size_t column, GrblStatus status, std::string message,
                 ErrorKind trouble = ErrorKind::invalid_input);
    bool fail_word(char letter, GrblStatus status, std::string message);
    bool need_integer(char letter, double low, double high, const char* meaning);
    /// Refuses the first unused word, if any; `motion` is the active motion code.
    bool need_all_used(std::int16_t motion) { return (block_.words & ~used_) == 0 || fail_unused(motion); }
    void prefix_problem(std::string_view text) { problem_.message.insert(0, text); }
    /// Returns the stored error as that of line `number`.
    tl::unexpected<Problem> problem_of(std::int32_t number);
    /// Returns the stored error as that of the earlier line `number`, whose text is not kept.
    tl::unexpected<Problem> problem_of_earlier(std::int32_t number);

    std::size_t error_column() const;  ///< column of the motion word, or of the first axis or offset word
    std::string_view word_text(char letter) const;

  private:
    bool fail_claim(char letter, std::int16_t code);
    bool fail_unused(std::int16_t motion);
    bool fail_exponent();

    Block block_;
    Problem problem_;
    std::int32_t number_ = 0;
    Language language_ = Language::words;
    std::uint32_t used_ = 0;
    std::array<std::int16_t, 26> claimed_by_ = {};  ///< valid for the letters in `used_` that a code has claimed
    bool axis_words_taken_ = false;
};

}  // namespace motionrack::control::gcode
