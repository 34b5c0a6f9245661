// Compile-time checks of declarations: tables of registers, commands, states and pins are checked during compilation,
// and the compiler prints the flaw as a sentence.
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

/// The first flaw of a declaration; empty if there is none. Limited to 159 characters.
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

/// Fails to compile if there is a flaw.
template <DeclarationError flaw>
consteval bool declared() {
    static_assert(flaw.empty(), "a declaration is wrong; its error text is the template argument 'flaw'");
    return true;
}

/// Checks that every entry has a meaning and a unique name. `kind`: kind of the entries, such as "register".
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
