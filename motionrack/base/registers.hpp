// Declaration of a card's registers: once, as constexpr tables that the compiler checks.
#pragma once

#include <cstdint>
#include <motionrack/base/declaration.hpp>
#include <span>
#include <string_view>

namespace motionrack {

enum class Access : std::uint8_t {
    read,        ///< the host reads it
    write,       ///< the host writes it
    read_clears  ///< reading it clears it
};

struct FieldInfo {
    std::string_view name;
    std::uint32_t mask = 0;    ///< adjacent bits
    std::string_view meaning;  ///< one line
};

struct RegisterInfo {
    std::string_view name;
    std::uint32_t offset = 0;  ///< byte offset on the bus
    int width = 16;            ///< bits, 1 .. 32
    Access access = Access::read;
    bool per_axis = false;  ///< exists per axis; the last command selects the axis
    std::string_view bank;  ///< registers of different banks may share an offset ("": always accessible)
    std::string_view meaning;
    std::span<const FieldInfo> fields;
};

/// Checks the fields of a register: disjoint, within its width, contiguous, not empty, with unique names.
constexpr DeclarationError fields_flaw(const RegisterInfo& reg) {
    if (reg.width < 1 || reg.width > 32) return {reg.name, ": the width must be 1 to 32 bits"};
    if (const DeclarationError flaw = names_flaw(reg.name, "field", reg.fields); !flaw.empty()) return flaw;
    for (std::size_t i = 0; i < reg.fields.size(); ++i) {
        const FieldInfo& field = reg.fields[i];
        if (field.mask == 0) return {reg.name, ": the field ", field.name, " has no bits"};
        if ((std::uint64_t{field.mask} >> reg.width) != 0)
            return {reg.name, ": the field ", field.name, " has bits outside the register's width"};
        const std::uint64_t above = std::uint64_t{field.mask} + (field.mask & (~field.mask + 1u));
        if ((above & field.mask) != 0) return {reg.name, ": the bits of the field ", field.name, " are not neighbours"};
        for (std::size_t j = 0; j < i; ++j)
            if ((reg.fields[j].mask & field.mask) != 0)
                return {reg.name, ": the fields ", reg.fields[j].name, " and ", field.name, " share a bit"};
    }
    return {};
}

/// Checks the fields of all registers, unique names, and unique offsets per direction and bank.
constexpr DeclarationError registers_flaw(std::span<const RegisterInfo> registers) {
    if (const DeclarationError flaw = names_flaw("the registers", "register", registers); !flaw.empty()) return flaw;
    for (std::size_t i = 0; i < registers.size(); ++i) {
        if (const DeclarationError flaw = fields_flaw(registers[i]); !flaw.empty()) return flaw;
        for (std::size_t j = 0; j < i; ++j) {
            const RegisterInfo &a = registers[j], &b = registers[i];
            const bool tangent_angle_rad = (a.access == Access::write) == (b.access == Access::write);
            if (a.offset == b.offset && tangent_angle_rad && a.bank == b.bank)
                return {"the registers ", a.name, " and ", b.name, " are at one offset in one direction and bank"};
        }
    }
    return {};
}

/// Returns the register of that name; an undeclared name does not compile.
consteval const RegisterInfo& register_named(std::span<const RegisterInfo> registers, std::string_view name) {
    for (const RegisterInfo& reg : registers)
        if (reg.name == name) return reg;
    throw "unknown register name";
}

/// Returns the mask of a field; an undeclared name, or a register wider than 16 bits, does not compile.
consteval std::uint16_t mask_of(const RegisterInfo& reg, std::string_view field) {
    if (reg.width > 16) throw "the register is wider than a Field";
    for (const FieldInfo& info : reg.fields)
        if (info.name == field) return static_cast<std::uint16_t>(info.mask);
    throw "the register has no field of that name";
}

/// A field of a word; constants of this type have no run-time cost.
struct Field {
    std::uint16_t mask = 0;
    constexpr bool test(unsigned word) const { return (word & mask) != 0; }
    constexpr unsigned get(unsigned word) const { return (word & mask) / (mask & (~mask + 1u)); }
    constexpr std::uint16_t set(unsigned word, unsigned value) const {
        return static_cast<std::uint16_t>((word & ~unsigned{mask}) | ((value * (mask & (~mask + 1u))) & mask));
    }
};

}  // namespace motionrack
