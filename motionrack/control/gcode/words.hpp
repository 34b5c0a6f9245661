// The table of G and M codes: one row for each code, with all properties that other parts use.
//
// A new code is a row here and the function that executes it.
#pragma once

#include <motionrack/control/gcode/block.hpp>
#include <span>
#include <string>
#include <string_view>

namespace motionrack::control::gcode {

struct InterpreterState;

/// Largest M code that a line from a sender may have, as in Grbl 1.1.
inline constexpr int max_m_of_senders = 30;

/// The codes of a line are executed phase by phase; in a phase, in the order of their groups.
enum class WordPhase : std::uint8_t {
    none,
    program,  ///< M98, M99
    machine,  ///< S and T, then spindle, coolant, tool, overrides and stops
    modes,    ///< modal G codes, then F
    once,     ///< non-modal G codes
    motion,   ///< the active motion code, by MotionWords
    io,       ///< M62 .. M68, which use the words that are left
    saving    ///< M70, M71, M73: when the line is valid
};

/// Executes a code. Returns false after it has stored the error of the line.
using WordHandler = bool (*)(InterpreterState& state, std::int16_t code);

struct WordRule {
    std::int16_t code;   ///< G code in tenths; M code as written
    std::uint8_t group;  ///< GroupG or GroupM
    WordPhase phase = WordPhase::none;
    WordHandler handler = nullptr;  ///< null: the handlers of other words check for the code
    std::uint32_t letters = 0;      ///< words that the code may use, besides F, N, S and T
    std::string_view help = {};
    bool stands_first = false;  ///< all earlier motion ends before this code, as in Grbl
    /// Reason why the code is refused, with a remedy; follows the name of the code in messages. A code with a group is
    /// refused only in lines from a sender.
    std::string_view refusal = {};
};

std::span<const WordRule> words_g();
std::span<const WordRule> words_m();

/// Returns the row of a G code in tenths, or one with g_unknown.
const WordRule& rule_of_g(int tenths);
/// Returns the row of an M code, or one with m_unknown.
const WordRule& rule_of_m(int code);

/// Returns the text of docs/reference/gcode.md, generated from the table.
std::string gcode_reference();

/// Executes the codes of the last line that belong to this phase.
bool run_words(InterpreterState& state, WordPhase phase);

/// Returns true if the block has a code before which all earlier motion ends.
bool stands_first(const Block& block);

}  // namespace motionrack::control::gcode
