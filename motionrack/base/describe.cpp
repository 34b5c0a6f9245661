// Writing a card's map.
#include <fmt/format.h>

#include <motionrack/base/describe.hpp>

namespace motionrack {

namespace {

const char* access_text(Access access) {
    switch (access) {
        case Access::read: return "read";
        case Access::write: return "write";
        case Access::read_clears: return "read, clears";
    }
    return "";
}

std::string bits_text(std::uint32_t mask) {
    int low = 0, high = 31;
    while (!(mask >> low & 1)) ++low;
    while (!(mask >> high & 1)) --high;
    return low == high ? fmt::format("D{}", low) : fmt::format("D{}-D{}", high, low);
}

std::string range_text(const CommandInfo& command) {
    return command.data_bytes == 0 || command.least == command.greatest ? "" : fmt::format("{} .. {}", command.least, command.greatest);
}

std::string quoted(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        if (static_cast<unsigned char>(c) < 0x20)
            out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
        else
            out += c;
    }
    return out + '"';
}

template <class T, class Call>
std::string joined(std::span<const T> items, const Call& call) {
    std::string out;
    for (const T& item : items) out += (out.empty() ? "\n" : ",\n") + call(item);
    return out + "\n";
}

}  // namespace

std::string describe_text(const CardMap& map) {
    std::string out = fmt::format("{}: {}\n\nRegisters\n", map.name, map.title);
    for (const RegisterInfo& reg : map.registers) {
        out += fmt::format("  {:<5} {:02X}h  {:<13}{}{} {}\n", reg.name, reg.offset, access_text(reg.access), reg.per_axis ? "per axis  " : "",
                           reg.bank.empty() ? "" : fmt::format("[{}] ", reg.bank), reg.meaning);
        for (const FieldInfo& field : reg.fields) out += fmt::format("          {:<9}{:<8} {}\n", bits_text(field.mask), field.name, field.meaning);
    }
    out += "\nCommands\n";
    for (const CommandInfo& command : map.commands)
        out += fmt::format("  {:02X}h  {:<26}{:<28}{}{}\n", command.code, command.name, range_text(command), command.meaning,
                           command.variant.empty() ? "" : fmt::format(" ({} only)", command.variant));
    for (const MachineInfo& machine : map.machines) {
        out += fmt::format("\n{}: {}\n", machine.name, machine.meaning);
        for (const StateInfo& state : machine.states) {
            out += fmt::format("  {:<20}{}\n", state.name, state.meaning);
            for (const TransitionInfo& t : machine.transitions)
                if (t.from == state.name) out += fmt::format("      -> {:<16}{}\n", t.to, t.when);
        }
    }
    out += "\nPins (* stands for the axis letter)\n";
    for (const PinInfo& pin : map.pins)
        out += fmt::format("  {:<8} {:<7}{:<11} {}\n", pin.name, pin.direction == PinDirection::input ? "input" : "output",
                           pin.active_low ? "active low" : "", pin.meaning);
    return out;
}

std::string describe_markdown(const CardMap& map) {
    std::string out = fmt::format("# {}\n\n{}\n\nThis page is made from the card's map: `motionrack describe {} --markdown`.\n\n## Registers\n",
                                  map.name, map.title, map.name);
    for (const RegisterInfo& reg : map.registers) {
        out += fmt::format("\n### {} (offset {:02X}h, {}{}{})\n\n{}\n", reg.name, reg.offset, access_text(reg.access),
                           reg.per_axis ? ", one an axis" : "", reg.bank.empty() ? "" : fmt::format(", {}", reg.bank), reg.meaning);
        if (reg.fields.empty()) continue;
        out += "\n| bits | field | meaning |\n|---|---|---|\n";
        for (const FieldInfo& field : reg.fields) out += fmt::format("| {} | {} | {} |\n", bits_text(field.mask), field.name, field.meaning);
    }
    out += "\n## Commands\n\n| code | name | data | range | unit | meaning |\n|---|---|---|---|---|---|\n";
    for (const CommandInfo& command : map.commands)
        out += fmt::format("| {:02X}h | {} | {} | {} | {} | {}{} |\n", command.code, command.name,
                           command.data_bytes ? fmt::format("{} bytes", command.data_bytes) : "-", range_text(command), command.unit,
                           command.meaning, command.variant.empty() ? "" : fmt::format(" ({} only)", command.variant));
    for (const MachineInfo& machine : map.machines) {
        out += fmt::format("\n## States: {}\n\n{}\n\n| state | meaning | goes to |\n|---|---|---|\n", machine.name, machine.meaning);
        for (const StateInfo& state : machine.states) {
            std::string next;
            for (const TransitionInfo& t : machine.transitions)
                if (t.from == state.name) next += fmt::format("{}{}: {}", next.empty() ? "" : "; ", t.to, t.when);
            out += fmt::format("| {} | {} | {} |\n", state.name, state.meaning, next);
        }
    }
    out += "\n## Pins\n\n`*` stands for the axis letter.\n\n| pin | direction | active | meaning |\n|---|---|---|---|\n";
    for (const PinInfo& pin : map.pins)
        out += fmt::format("| {} | {} | {} | {} |\n", pin.name, pin.direction == PinDirection::input ? "input" : "output",
                           pin.active_low ? "low" : "high", pin.meaning);
    return out;
}

std::string describe_json(const CardMap& map) {
    std::string out = fmt::format("{{\n\"name\": {}, \"title\": {},\n\"registers\": [", quoted(map.name), quoted(map.title));
    out += joined(map.registers, [](const RegisterInfo& reg) {
        return fmt::format(R"(  {{"name": {}, "offset": {}, "width": {}, "access": {}, "per_axis": {}, "bank": {}, "meaning": {}, "fields": [{}  ]}})",
                           quoted(reg.name), reg.offset, reg.width, quoted(access_text(reg.access)), reg.per_axis, quoted(reg.bank),
                           quoted(reg.meaning), joined(reg.fields, [](const FieldInfo& field) {
                               return fmt::format(R"(    {{"name": {}, "mask": {}, "meaning": {}}})", quoted(field.name), field.mask,
                                                  quoted(field.meaning));
                           }));
    });
    out += "],\n\"commands\": [" + joined(map.commands, [](const CommandInfo& command) {
        return fmt::format(R"(  {{"name": {}, "code": {}, "data_bytes": {}, "least": {}, "greatest": {}, "unit": {}, "variant": {}, "meaning": {}}})",
                           quoted(command.name), command.code, command.data_bytes, command.least, command.greatest, quoted(command.unit),
                           quoted(command.variant), quoted(command.meaning));
    });
    out += "],\n\"machines\": [" + joined(map.machines, [](const MachineInfo& machine) {
        return fmt::format(R"(  {{"name": {}, "meaning": {}, "states": [{}  ], "transitions": [{}  ]}})", quoted(machine.name),
                           quoted(machine.meaning), joined(machine.states, [](const StateInfo& state) {
                               return fmt::format(R"(    {{"name": {}, "meaning": {}, "final": {}}})", quoted(state.name), quoted(state.meaning),
                                                  state.final);
                           }),
                           joined(machine.transitions, [](const TransitionInfo& t) {
                               return fmt::format(R"(    {{"from": {}, "to": {}, "when": {}}})", quoted(t.from), quoted(t.to), quoted(t.when));
                           }));
    });
    out += "],\n\"pins\": [" + joined(map.pins, [](const PinInfo& pin) {
        return fmt::format(R"(  {{"name": {}, "direction": {}, "active_low": {}, "meaning": {}}})", quoted(pin.name),
                           quoted(pin.direction == PinDirection::input ? "input" : "output"), pin.active_low, quoted(pin.meaning));
    });
    return out + "]\n}\n";
}

}  // namespace motionrack
