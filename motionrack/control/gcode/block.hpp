// One line of G-code divided into words, before interpretation.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/control/gcode/language/expression_parser.hpp>
#include <motionrack/control/gcode/problem.hpp>
#include <string_view>
#include <vector>

namespace motionrack::control::gcode {

/// Maximum number of characters in a line, without its end.
inline constexpr std::size_t max_line_length = 1024;

/// Modal groups of G codes. G codes are stored in tenths (G1 = 10, G38.2 = 382), M codes as they are.
enum GroupG : std::uint8_t {
    g_nonmodal = 0,  ///< G4 G10 G28 G28.1 G30 G30.1 G53 G92 G92.1 G92.2 G92.3
    g_motion,        ///< G0 G1 G2 G3 G5 G5.1 G38.2 .. G38.5 G70 .. G72.2, G73 G74 G80 G81 .. G86 G89
    g_plane,         ///< G17 G18 G19
    g_distance,      ///< G90 G91
    g_arc_distance,  ///< G90.1 G91.1
    g_feed_mode,     ///< G93 G94
    g_units,         ///< G20 G21
    g_cutter,        ///< G40 G41 G41.1 G42 G42.1
    g_tool_length,   ///< G43 G43.1 G43.2 G49
    g_retract,       ///< G98 G99
    g_system,        ///< G54 .. G59, G59.1 G59.2 G59.3
    g_path,          ///< G61 G61.1 G64
    g_spindle,       ///< G97
    g_group_count,
    g_refused = 254,  ///< known, but not supported by this machine
    g_unknown = 255
};

enum GroupM : std::uint8_t {
    m_stop = 0,     ///< M0 M1 M2 M30 M60
    m_tool,         ///< M6 M61
    m_spindle,      ///< M3 M4 M5
    m_mist,         ///< M7
    m_flood,        ///< M8
    m_coolant_off,  ///< M9
    m_override,     ///< M48 .. M53
    m_state,        ///< M70 .. M73
    m_io,           ///< M62 .. M68
    m_program,      ///< M98 M99
    m_group_count,
    m_unknown = 255
};

constexpr std::uint32_t letter_bit(char letter) {
    return std::uint32_t{1} << (letter - 'A');
}
constexpr int letter_index(char letter) {
    return letter - 'A';
}

inline constexpr std::uint32_t linear_words = letter_bit('X') | letter_bit('Y') | letter_bit('Z');
inline constexpr std::uint32_t rotary_words = letter_bit('A') | letter_bit('B') | letter_bit('C');
inline constexpr std::uint32_t axis_words = linear_words | rotary_words;
inline constexpr std::uint32_t offset_words = letter_bit('I') | letter_bit('J') | letter_bit('K');

struct Comment {
    std::string_view text;      ///< without the delimiters
    bool message = false;       ///< (MSG,text), (DEBUG,text), (PRINT,text): `text` follows the comma
    bool values = false;        ///< DEBUG and PRINT: parameters in it are replaced by their values
    bool rest_of_line = false;  ///< written with ';'
};

/// The part of the language that a line may use.
enum class Language : std::uint8_t {
    words,        ///< words with numbers, as Grbl 1.1
    expressions,  ///< also parameters and expressions: everything that needs no other line of the program
    program       ///< also O words
};

struct Assignment {
    ParameterName parameter;
    double value = 0;
};

struct Block {
    std::string_view text;       ///< the line
    std::uint32_t words = 0;     ///< letters that are present, except G and M; A = bit 0
    std::uint32_t g_groups = 0;  ///< G groups that have a code, one bit each
    std::uint32_t m_groups = 0;
    bool percent = false;     ///< the line is a lone %
    bool deleted = false;     ///< a line with '/' that was skipped
    bool has_o_word = false;  ///< an O word starts at `flow_column`; the rest of the line was not read
    std::uint16_t flow_column = 0;
    std::array<double, 26> value;          ///< valid for the letters in `words`
    std::array<std::uint16_t, 26> column;  ///< column of the letter, from 0
    std::array<std::int16_t, g_group_count> g;
    std::array<std::uint16_t, g_group_count> g_column;
    std::array<std::int16_t, m_group_count> m;
    std::array<std::uint16_t, m_group_count> m_column;
    std::vector<Comment> comments;
    std::vector<Assignment> assignments;  ///< assignments, in the order of the line

    bool has(char letter) const { return (words & letter_bit(letter)) != 0; }
    double operator[](char letter) const { return value[letter_index(letter)]; }
    bool has_g(GroupG group) const { return (g_groups >> group & 1) != 0; }
    bool has_m(GroupM group) const { return (m_groups >> group & 1) != 0; }
};

struct ScanOptions {
    bool block_delete = false;
    Language language = Language::words;
    const ParameterSource* parameters = nullptr;  ///< required except for Language::words
};

/// Divides a line into words. Checks the letters, the numbers, the codes, modal groups and repeated words. Returns
/// false with the error in `problem` (without the line number) and an unusable `block`.
bool scan_line(std::string_view text, const ScanOptions& options, Block& block, Problem& problem);

/// Returns the word that starts at `column` (from 0), with its number or first bracket, without trailing blanks.
std::string_view word_at(std::string_view text, std::size_t column);

/// Fills `problem`; `column` counts from 0.
void set_problem(Problem& problem, std::string_view text, std::size_t column, GrblStatus status, std::string message,
                 ErrorKind trouble = ErrorKind::invalid_input);

}  // namespace motionrack::control::gcode
