// Base of the classes that interpret the words of a line: the parts of the interpreter under short names.
//
// A reader lives while it reads one line. It returns false after it has stored the error of the line; what it changed
// is dropped then, because only a valid line is committed.
#pragma once

#include <motionrack/control/gcode/interpreter_state.hpp>
#include <string>
#include <string_view>
#include <utility>

namespace motionrack::control::gcode {

class WordReader {
  public:
    explicit WordReader(InterpreterState& state) : in_(state) {}

  protected:
    const Settings& settings() const { return in_.settings; }
    const Block& block() const { return in_.words.block(); }
    const ModalState& modes() const { return in_.modes.now(); }  ///< modal state after the last line
    ModalState& next() const { return in_.modes.next(); }        ///< modal state after this line
    Offsets& offsets() const { return in_.offsets; }
    const WorkFrame& frame() const { return in_.offsets.frame(); }           ///< frame after the last line
    const WorkFrame& frame_now() const { return in_.offsets.next_frame(); }  ///< frame with the changes of this line
    WorkFrame& edit_frame() const { return in_.offsets.edit_frame(); }
    const ToolTable& tools() const { return in_.offsets.tools(); }
    Travel& travel() const { return in_.travel; }
    StepQueue& steps() const { return in_.steps; }

    std::int32_t line_number() const { return in_.words.number(); }
    Language language() const { return in_.words.language(); }
    void use(std::uint32_t letters) { in_.words.use(letters); }
    bool claim_for_g(std::int16_t tenths, std::uint32_t letters) { return in_.words.claim(letters, tenths); }
    bool claim_for_m(int code, std::uint32_t letters) {
        return in_.words.claim(letters, static_cast<std::int16_t>(~code));
    }
    void take_axis_words() { in_.words.take_axis_words(); }
    bool axis_words_taken() const { return in_.words.axis_words_taken(); }
    std::string_view word_text(char letter) const { return in_.words.word_text(letter); }
    std::size_t error_column() const { return in_.words.error_column(); }
    bool fail_at(std::size_t column, GrblStatus status, std::string message,
                 ErrorKind trouble = ErrorKind::invalid_input) {
        return in_.words.fail_at(column, status, std::move(message), trouble);
    }
    bool fail_word(char letter, GrblStatus status, std::string message) {
        return in_.words.fail_word(letter, status, std::move(message));
    }
    bool need_integer(char letter, double low, double high, const char* meaning) {
        return in_.words.need_integer(letter, low, high, meaning);
    }

    double scale_of(int axis) const { return axis < 3 && next().inch ? 25.4 : 1.0; }
    double scaled(char letter) const { return next().inch ? block()[letter] * 25.4 : block()[letter]; }
    static std::size_t axis_letter(int axis) { return static_cast<std::size_t>(letter_index(axis_letters[axis])); }

    bool require_tool(char letter, std::int32_t number);
    const Tool* tool_of_table(std::int32_t number, char letter, GroupG code);

    InterpreterState& in_;
};

}  // namespace motionrack::control::gcode
