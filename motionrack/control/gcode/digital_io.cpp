// M62 .. M68: numbered outputs and inputs. They are not connected here: inputs are always 0, as in LinuxCNC.
#include <fmt/format.h>

#include <bit>
#include <motionrack/control/gcode/interpreter.hpp>

namespace motionrack::control::gcode {

namespace {

/// Maximum number of each kind.
constexpr int max_ports = 64;

/// M66 L.
enum Wait : std::uint8_t { at_once, rise, fall, high, low };

constexpr std::int16_t wait_on_input = 66;

bool is_analog_output(int code) {
    return code >= 67;
}

}  // namespace

/// Runs after all other words of the line, so that remaining words belong to these codes.
bool Interpreter::ports() {
    const int code = block().m[m_io];
    if (code == wait_on_input) return read_input();
    const bool analog = is_analog_output(code);
    if (!claim_words(analog ? letter_bit('E') | letter_bit('Q') : letter_bit('P')) ||
        !port_number(analog ? 'E' : 'P', '\0'))
        return false;
    if (analog && !block().has('Q')) {
        return words_.fail_at(
            block().m_column[m_io], GrblStatus::word_missing,
            fmt::format("Q word missing: M{} needs the value for its output; write e.g. M{} E0 Q2.5", code, code));
    }
    steps_.add_port(analog ? block()['Q'] : code == 62 || code == 64 ? 1 : 0);
    return true;
}

/// Interprets M66: P or E, wait mode L, timeout Q.
bool Interpreter::read_input() {
    if (!claim_words(letter_bit('P') | letter_bit('E') | letter_bit('L') | letter_bit('Q')) || !port_number('P', 'E'))
        return false;
    if (block().has('L') &&
        !words_.need_integer('L', at_once, low, "how to wait (0 not at all, 1 rise, 2 fall, 3 on, 4 off)"))
        return false;
    const Wait wait = block().has('L') ? static_cast<Wait>(block()['L']) : at_once;
    if (block().has('E') && wait != at_once)
        return words_.fail_word(
            'L', GrblStatus::unsupported,
            fmt::format("{}: waiting for an analog input is not possible; write L0, or P and a digital input",
                        words_.word_text('L')));
    if (wait != at_once && !(block().has('Q') && block()['Q'] > 0)) {
        constexpr const char* why =
            "M66 waits for at most Q seconds, which must be above 0; write e.g. M66 P0 L3 Q5, or L0 to read it without "
            "waiting";
        return block().has('Q')
                   ? words_.fail_word('Q', GrblStatus::bad_target, fmt::format("{}: {}", words_.word_text('Q'), why))
                   : words_.fail_at(block().m_column[m_io], GrblStatus::word_missing,
                                    fmt::format("Q word missing: {}", why));
    }
    const bool comes = wait == at_once || wait == low;
    steps_.add_port(comes ? 0 : -1);
    if (!comes) steps_.add_wait(block()['Q']);
    return true;
}

/// Requires exactly one of the two words, with the number of an input or output.
bool Interpreter::port_number(char letter, char other) {
    const int code = block().m[m_io];
    const bool second = other != '\0' && block().has(other);
    if (block().has(letter) && second)
        return words_.fail_word(other, GrblStatus::unsupported,
                                fmt::format("{}: M{} reads one input, digital (P) or analog (E); leave one out",
                                            words_.word_text(other), code));
    if (!block().has(letter) && !second) {
        return words_.fail_at(block().m_column[m_io], GrblStatus::word_missing,
                              fmt::format("{} word missing: M{} needs the number of its {}; write e.g. M{} {}0{}",
                                          letter, code, code == wait_on_input ? "input" : "output", code, letter,
                                          is_analog_output(code) ? " Q2.5" : ""));
    }
    return words_.need_integer(second ? other : letter, 0, max_ports - 1,
                               code == wait_on_input ? "the number of an input" : "the number of an output");
}

/// Claims words for M62 .. M68 if no other code of the line uses them.
bool Interpreter::claim_words(std::uint32_t words) {
    const std::uint32_t taken = words & block().words & words_.used();
    words_.use(words);
    if (taken == 0) return true;
    const char letter = static_cast<char>('A' + std::countr_zero(taken));
    return words_.fail_word(
        letter, GrblStatus::axis_conflict,
        fmt::format("{}: M{} and another word of this line both use the {} word; put them on two lines",
                    words_.word_text(letter), block().m[m_io], letter));
}

}  // namespace motionrack::control::gcode
