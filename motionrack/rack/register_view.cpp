// Reads all registers and decodes their bits.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/cards/mcx314/map.hpp>
#include <motionrack/rack/register_view.hpp>
#include <nlohmann/json.hpp>

namespace motionrack::rack {

namespace {

constexpr std::string_view axis_letters = "XYZU";

std::uint32_t field_of(std::uint16_t word, const FieldInfo& field) {
    return (word & field.mask) / (field.mask & (~field.mask + 1u));
}

struct ValueCommand {
    std::string_view name;
    const CommandInfo& command;
    std::string_view meaning;
};

constexpr ValueCommand mcx314_values[] = {
    {"LP", command_named(mcx314::map::commands, "READ_LP"), "pulses sent"},
    {"EP", command_named(mcx314::map::commands, "READ_EP"), "encoder counts"},
    {"CV", command_named(mcx314::map::commands, "READ_CV"), "present speed, units of V"},
    {"CA", command_named(mcx314::map::commands, "READ_CA"), "present acceleration, units of A"},
};

bool is_reading(const RegisterInfo& reg) {
    return reg.access != Access::write && reg.bank.empty();
}

}  // namespace

RegisterView view_mcx314(RegisterPort& port, bool clearing) {
    RegisterView view;
    const std::span<const RegisterInfo> registers = mcx314::card_map().registers;
    for (const RegisterInfo& reg : registers)
        if (is_reading(reg) && !reg.per_axis) view.registers.push_back({&reg, "", port.read(reg.offset)});
    for (unsigned axis = 0; axis < axis_letters.size(); ++axis) {
        const std::string letter(1, axis_letters[axis]);
        const unsigned chosen = 0x0100u << axis;
        port.write(mcx314::reg::WR0, static_cast<std::uint16_t>(chosen | mcx314::cmd::NOP));
        for (const RegisterInfo& reg : registers)
            if (is_reading(reg) && reg.per_axis && (clearing || reg.access != Access::read_clears))
                view.registers.push_back({&reg, letter, port.read(reg.offset)});
        for (const auto& [name, command, meaning] : mcx314_values) {
            port.write(mcx314::reg::WR0, static_cast<std::uint16_t>(chosen | command.code));
            const std::uint32_t low = port.read(mcx314::reg::RR6);
            const std::uint32_t high = command.data_bytes > 2 ? port.read(mcx314::reg::RR7) : 0;
            view.values.push_back({name, letter, static_cast<std::int32_t>(high << 16 | low), meaning});
        }
    }
    return view;
}

std::string view_text(const RegisterView& view, bool all) {
    std::string out;
    for (const RegisterSnapshot& seen : view.registers) {
        out += fmt::format("{:<4} {:<2} {:0{}X}h  {}\n", seen.reg->name, seen.axis, seen.word, seen.reg->width / 4,
                           seen.reg->meaning);
        for (const FieldInfo& field : seen.reg->fields)
            if (const std::uint32_t value = field_of(seen.word, field); value != 0 || all)
                out += fmt::format("          {:<6} {:<5} {}\n", field.name, value, field.meaning);
    }
    for (const ValueSnapshot& seen : view.values)
        out += fmt::format("{:<4} {:<2} {:<11} {}\n", seen.name, seen.axis, seen.value, seen.meaning);
    return out;
}

std::string view_json(const RegisterView& view) {
    nlohmann::ordered_json out;
    out["registers"] = nlohmann::ordered_json::array();
    for (const RegisterSnapshot& seen : view.registers) {
        nlohmann::ordered_json one = {{"name", seen.reg->name}, {"axis", seen.axis}, {"word", seen.word}};
        for (const FieldInfo& field : seen.reg->fields)
            one["fields"][std::string(field.name)] = field_of(seen.word, field);
        out["registers"].push_back(std::move(one));
    }
    out["values"] = nlohmann::ordered_json::array();
    for (const ValueSnapshot& seen : view.values)
        out["values"].push_back({{"name", seen.name}, {"axis", seen.axis}, {"value", seen.value}});
    return out.dump(2) + "\n";
}

}  // namespace motionrack::rack
