// Output of a card's map.
#include <fmt/format.h>

#include <motionrack/base/describe.hpp>

namespace motionrack {

namespace {

const char* access_text(Access access) {
    switch (access) {
        case Access::read:
            return "read";
        case Access::write:
            return "write";
        case Access::read_clears:
            return "read, clears";
    }
    return "";
}

std::string bits_text(std::uint32_t mask) {
    int low = 0, high = 31;
    while (!(mask >> low & 1)) ++low;
    while (!(mask >> high & 1)) --high;
    return low == high ? fmt::format("D{}", low) : fmt::format("D{}-D{}", high, low);
}

/// Inserts commas between thousands.
std::string grouped(std::int64_t number) {
    std::string out = fmt::format("{}", number);
    for (std::size_t i = out.size(); i > (number < 0 ? 4u : 3u);) out.insert(i -= 3, 1, ',');
    return out;
}

std::string range_text(const CommandInfo& command) {
    if (command.data_bytes == 0 || command.data_bytes > 4) return "";
    return fmt::format("{} .. {}", grouped(command.min), grouped(command.max));
}

/// The data written with a command and read after it.
std::string data_text(const CommandInfo& command) {
    if (command.answer_bytes == 0) return command.data_bytes ? fmt::format("{} bytes", command.data_bytes) : "-";
    if (command.data_bytes == 0) return fmt::format("{} bytes back", command.answer_bytes);
    return fmt::format("{} bytes, or {} back", command.data_bytes, command.answer_bytes);
}

/// The meaning with its restrictions.
std::string remarked(const CommandInfo& command) {
    std::string out(command.meaning);
    if (!command.variant.empty()) out += fmt::format(" ({} only)", command.variant);
    if (!command.reproduced) out += " (not reproduced)";
    return out;
}

/// A cell of a Markdown table.
std::string cell(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '|' || c == '*') out += '\\';
        out += c;
    }
    return out;
}

const char* direction_text(PinDirection direction) {
    return direction == PinDirection::input ? "input" : "output";
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

template <class T>
std::string list(std::span<const T> items);  // a list of the json() texts of the items

void add_markdown(std::string& out, const RegisterInfo& reg) {
    out += fmt::format("\n### {} (offset {:02X}h, {}{}{})\n\n{}\n", reg.name, reg.offset, access_text(reg.access),
                       reg.per_axis ? ", one an axis" : "", reg.bank.empty() ? "" : fmt::format(", {}", reg.bank),
                       reg.meaning);
    if (reg.fields.empty()) return;
    out += "\n| bits | field | meaning |\n|---|---|---|\n";
    for (const FieldInfo& field : reg.fields)
        out += fmt::format("| {} | {} | {} |\n", bits_text(field.mask), field.name, cell(field.meaning));
}

void add_markdown(std::string& out, const MachineInfo& machine) {
    out += fmt::format("\n## States: {}\n\n{}\n\n| state | meaning | goes to |\n|---|---|---|\n", machine.name,
                       machine.meaning);
    for (const StateInfo& state : machine.states) {
        std::string next;
        for (const TransitionInfo& t : machine.transitions)
            if (t.from == state.name) next += fmt::format("{}{}: {}", next.empty() ? "" : "; ", t.to, t.when);
        out += fmt::format("| {} | {} | {} |\n", state.name, cell(state.meaning), cell(next));
    }
}

std::string json(const FieldInfo& field) {
    return fmt::format(R"(    {{"name": {}, "mask": {}, "meaning": {}}})", quoted(field.name), field.mask,
                       quoted(field.meaning));
}

std::string json(const RegisterInfo& reg) {
    return fmt::format(R"(  {{"name": {}, "offset": {}, "width": {}, "access": {}, "per_axis": {}, "bank": {}, )"
                       R"("meaning": {}, "fields": {}}})",
                       quoted(reg.name), reg.offset, reg.width, quoted(access_text(reg.access)), reg.per_axis,
                       quoted(reg.bank), quoted(reg.meaning), list(reg.fields));
}

std::string json(const CommandInfo& command) {
    return fmt::format(
        R"(  {{"name": {}, "code": {}, "data_bytes": {}, "min": {}, "max": {}, "unit": {}, "variant": {}, )"
        R"("reproduced": {}, "answer_bytes": {}, "meaning": {}}})",
        quoted(command.name), command.code, command.data_bytes, command.min, command.max, quoted(command.unit),
        quoted(command.variant), command.reproduced, command.answer_bytes, quoted(command.meaning));
}

std::string json(const StateInfo& state) {
    return fmt::format(R"(    {{"name": {}, "meaning": {}, "final": {}}})", quoted(state.name), quoted(state.meaning),
                       state.final);
}

std::string json(const TransitionInfo& transition) {
    return fmt::format(R"(    {{"from": {}, "to": {}, "when": {}}})", quoted(transition.from), quoted(transition.to),
                       quoted(transition.when));
}

std::string json(const MachineInfo& machine) {
    return fmt::format(R"(  {{"name": {}, "meaning": {}, "states": {}, "transitions": {}}})", quoted(machine.name),
                       quoted(machine.meaning), list(machine.states), list(machine.transitions));
}

std::string json(const PinInfo& pin) {
    return fmt::format(R"(  {{"name": {}, "direction": {}, "active_low": {}, "meaning": {}}})", quoted(pin.name),
                       quoted(direction_text(pin.direction)), pin.active_low, quoted(pin.meaning));
}

template <class T>
std::string list(std::span<const T> items) {
    std::string out;
    for (const T& item : items) out += (out.empty() ? "[\n" : ",\n") + json(item);
    return out.empty() ? "[]" : out + "]";
}

}  // namespace

std::string describe_text(const CardMap& map) {
    std::string out = fmt::format("{}: {}\n\nRegisters\n", map.name, map.title);
    for (const RegisterInfo& reg : map.registers) {
        out += fmt::format("  {:<5} {:02X}h  {:<13}{}{} {}\n", reg.name, reg.offset, access_text(reg.access),
                           reg.per_axis ? "per axis  " : "", reg.bank.empty() ? "" : fmt::format("[{}] ", reg.bank),
                           reg.meaning);
        for (const FieldInfo& field : reg.fields)
            out += fmt::format("          {:<9}{:<8} {}\n", bits_text(field.mask), field.name, field.meaning);
    }
    out += "\nCommands\n";
    for (const CommandInfo& command : map.commands)
        out += fmt::format("  {:02X}h  {:<30} {:<32} {}{}\n", command.code, command.name, range_text(command),
                           remarked(command), command.answer_bytes ? fmt::format(" ({})", data_text(command)) : "");
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
        out += fmt::format("  {:<8} {:<7}{:<11} {}\n", pin.name, direction_text(pin.direction),
                           pin.active_low ? "active low" : "", pin.meaning);
    out += "\nNot reproduced: the virtual card ignores and reports it.\n";
    return out;
}

std::string describe_markdown(const CardMap& map) {
    std::string out = fmt::format(
        "# {}\n\n{}\n\nThis page is made from the card's map: `motionrack describe {} --markdown`. Functions "
        "that are not reproduced exist on the real\ncard; the virtual one ignores and reports them.\n\n## Registers\n",
        map.name, map.title, map.name);
    for (const RegisterInfo& reg : map.registers) add_markdown(out, reg);
    out += "\n## Commands\n\n| code | name | data | range | unit | meaning |\n|---|---|---|---|---|---|\n";
    for (const CommandInfo& command : map.commands)
        out += fmt::format("| {:02X}h | {} | {} | {} | {} | {} |\n", command.code, command.name, data_text(command),
                           range_text(command), cell(command.unit), cell(remarked(command)));
    for (const MachineInfo& machine : map.machines) add_markdown(out, machine);
    out +=
        "\n## Pins\n\n`*` stands for the axis letter.\n\n| pin | direction | active | meaning |\n|---|---|---|---|\n";
    for (const PinInfo& pin : map.pins)
        out += fmt::format("| {} | {} | {} | {} |\n", cell(pin.name), direction_text(pin.direction),
                           pin.active_low ? "low" : "high", cell(pin.meaning));
    return out;
}

std::string describe_json(const CardMap& map) {
    return fmt::format(
        "{{\n\"name\": {}, \"title\": {},\n\"registers\": {},\n\"commands\": {},\n\"machines\": {},\n\"pins\": "
        "{}\n}}\n",
        quoted(map.name), quoted(map.title), list(map.registers), list(map.commands), list(map.machines),
        list(map.pins));
}

}  // namespace motionrack
