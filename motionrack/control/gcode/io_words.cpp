// Numbered outputs and inputs.
#include <fmt/format.h>

#include <motionrack/control/gcode/io_words.hpp>
#include <motionrack/control/gcode/words.hpp>

namespace motionrack::control::gcode {

namespace {

/// Number of ports of each kind: digital and analog inputs and outputs.
constexpr int max_ports = 64;

/// Wait modes of M66, by their L word.
enum Wait : std::uint8_t { at_once, rise, fall, high, low };

constexpr std::int16_t wait_on_input = 66;

bool is_analog_output(int code) {
    return code >= 67;
}

}  // namespace

bool IoWords::read() {
    const int code = block().m[m_io];
    if (code == wait_on_input) return read_input();
    const bool analog = is_analog_output(code);
    if (!claim_for_m(code, rule_of_m(code).letters) || !port_number(analog ? 'E' : 'P', '\0')) return false;
    if (analog && !block().has('Q')) {
        return fail_at(
            block().m_column[m_io], GrblStatus::word_missing,
            fmt::format("Q word missing: M{} needs the value for its output; write e.g. M{} E0 Q2.5", code, code));
    }
    steps().add_port(analog ? block()['Q'] : code == 62 || code == 64 ? 1 : 0);
    return true;
}

/// Interprets M66: P or E, wait mode L, timeout Q.
bool IoWords::read_input() {
    if (!claim_for_m(wait_on_input, rule_of_m(wait_on_input).letters) || !port_number('P', 'E')) return false;
    if (block().has('L') && !need_integer('L', at_once, low, "how to wait (0 not at all, 1 rise, 2 fall, 3 on, 4 off)"))
        return false;
    const Wait wait = block().has('L') ? static_cast<Wait>(block()['L']) : at_once;
    if (block().has('E') && wait != at_once)
        return fail_word(
            'L', GrblStatus::unsupported,
            fmt::format("{}: waiting for an analog input is not possible; write L0, or P and a digital input",
                        word_text('L')));
    if (wait != at_once && !(block().has('Q') && block()['Q'] > 0)) {
        constexpr const char* why =
            "M66 waits for at most Q seconds, which must be above 0; write e.g. M66 P0 L3 Q5, or L0 to read it without "
            "waiting";
        return block().has('Q')
                   ? fail_word('Q', GrblStatus::bad_target, fmt::format("{}: {}", word_text('Q'), why))
                   : fail_at(block().m_column[m_io], GrblStatus::word_missing, fmt::format("Q word missing: {}", why));
    }
    const bool comes = wait == at_once || wait == low;
    steps().add_port(comes ? 0 : -1);
    if (!comes) steps().add_wait(block()['Q']);
    return true;
}

/// Requires exactly one of the two words, with the number of an input or output.
bool IoWords::port_number(char letter, char other) {
    const int code = block().m[m_io];
    const bool second = other != '\0' && block().has(other);
    if (block().has(letter) && second)
        return fail_word(
            other, GrblStatus::unsupported,
            fmt::format("{}: M{} reads one input, digital (P) or analog (E); leave one out", word_text(other), code));
    if (!block().has(letter) && !second) {
        return fail_at(block().m_column[m_io], GrblStatus::word_missing,
                       fmt::format("{} word missing: M{} needs the number of its {}; write e.g. M{} {}0{}", letter,
                                   code, code == wait_on_input ? "input" : "output", code, letter,
                                   is_analog_output(code) ? " Q2.5" : ""));
    }
    return need_integer(second ? other : letter, 0, max_ports - 1,
                        code == wait_on_input ? "the number of an input" : "the number of an output");
}

}  // namespace motionrack::control::gcode
