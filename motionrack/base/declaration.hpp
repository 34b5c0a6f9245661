// What is wrong with a declaration, as a sentence that the compiler prints: tables of registers, commands, states and
// pins are looked through while they are compiled.
//
//   static_assert(declared<registers_flaw(registers)>());
//   error: ... [with DeclarationError flaw = DeclarationError{"WR1: the fields IN0L and IN0E share a bit", 41}]
//
// g++ prints the sentence; clang 14 prints the line of the static_assert and the sentence's characters as numbers.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <string_view>

namespace motionrack {

/// The first thing wrong with a declaration; empty if nothing is. Longer than 159 characters is cut.
struct DeclarationError {
    char sentence[160] = {};
    std::size_t size = 0;

    constexpr DeclarationError() = default;
    constexpr DeclarationError(std::initializer_list<std::string_view> pieces) {
        for (const std::string_view piece : pieces)
            for (const char c : piece)
                if (size + 1 < sizeof sentence) sentence[size++] = c;
    }
    constexpr bool empty() const { return size == 0; }
    constexpr std::string_view text() const { return {sentence, size}; }
};

/// Does not compile if there is a flaw.
template <DeclarationError flaw>
consteval bool declared() {
    static_assert(flaw.empty(), "a declaration is wrong; the sentence that says how is the template argument 'flaw'");
    return true;
}

/// No entry without a name, none without a meaning, no name twice. `kind` is what the entries are: "register".
template <class Table>
constexpr DeclarationError names_flaw(std::string_view owner, std::string_view kind, const Table& table) {
    for (std::size_t i = 0; i < table.size(); ++i) {
        if (table[i].name.empty()) return {owner, ": a ", kind, " has no name"};
        if (table[i].meaning.empty()) return {owner, ": the ", kind, " ", table[i].name, " has no meaning"};
        for (std::size_t j = 0; j < i; ++j)
            if (table[i].name == table[j].name) return {owner, ": two of the ", kind, "s are called ", table[i].name};
    }
    return {};
}

}  // namespace motionrack
