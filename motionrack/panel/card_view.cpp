// Describes a card of any type as JSON.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <motionrack/panel/card_view.hpp>
#include <motionrack/panel/channel_registry.hpp>

namespace motionrack::panel {

using nlohmann::json;

namespace {

std::string_view name_of(Access access) {
    switch (access) {
        case Access::read:
            return "read";
        case Access::write:
            return "write";
        case Access::read_clears:
            return "read clears";
    }
    return "";
}

json fields_of(const RegisterInfo& reg) {
    json out = json::array();
    for (const FieldInfo& field : reg.fields)
        out.push_back({{"name", field.name},
                       {"mask", field.mask},
                       {"low", std::countr_zero(field.mask)},
                       {"bits", std::popcount(field.mask)},
                       {"meaning", field.meaning}});
    return out;
}

json commands_of(const CardMap& map) {
    json out = json::array();
    for (const CommandInfo& command : map.commands)
        out.push_back({{"name", command.name},
                       {"code", command.code},
                       {"data_bytes", command.data_bytes},
                       {"min", command.min},
                       {"max", command.max},
                       {"unit", command.unit},
                       {"answer_bytes", command.answer_bytes},
                       {"reproduced", command.reproduced},
                       {"meaning", command.meaning}});
    return out;
}

json machines_of(const CardMap& map) {
    json out = json::array();
    for (const MachineInfo& machine : map.machines) {
        json states = json::array(), ways = json::array();
        for (const StateInfo& state : machine.states)
            states.push_back({{"name", state.name}, {"meaning", state.meaning}});
        for (const TransitionInfo& transition : machine.transitions)
            ways.push_back({{"from", transition.from}, {"to", transition.to}, {"when", transition.when}});
        out.push_back({{"name", machine.name},
                       {"meaning", machine.meaning},
                       {"states", std::move(states)},
                       {"transitions", std::move(ways)}});
    }
    return out;
}

const rack::RackCard& config_of(const rack::Rack& rack, const rack::Card& card) {
    return *rack.config().card(card.name());
}

}  // namespace

json card_facts(operate::Machine& machine, const rack::Card& card) {
    rack::Rack& rack = machine.rack();
    const operate::LivePlace* const live = machine.service().live_place(card.name());
    const rack::RackCard& config = config_of(rack, card);
    const rack::CardType& type = *rack::find_card_type(config.type);
    const CardMap& map = card.map();
    json registers = json::array();
    for (const RegisterInfo& reg : map.registers)
        registers.push_back({{"name", reg.name},
                             {"offset", reg.offset},
                             {"width", reg.width},
                             {"access", name_of(reg.access)},
                             {"per_axis", reg.per_axis},
                             {"bank", reg.bank},
                             {"meaning", reg.meaning},
                             {"fields", fields_of(reg)}});
    json pins = json::array(), values = json::array(), quantities = json::array();
    if (live == nullptr) values = card.value_names(), quantities = card.quantity_names();
    for (const rack::CardPin& pin : live == nullptr ? rack::pins_of(config) : std::vector<rack::CardPin>())
        pins.push_back({{"name", pin.name},
                        {"direction", pin.direction == PinDirection::input ? "input" : "output"},
                        {"volts", pin.volts > 0},
                        {"bits", pin.bits},
                        {"meaning", pin.doc}});
    json axes = json::array();
    for (const rack::RackAxis& axis : rack.config().axes)
        if (axis.card == card.name())
            axes.push_back({{"letter", std::string(1, axis.letter)}, {"channel", axis.channel}});
    json widths = json::array();
    for (const int width : card.bus_widths()) widths.push_back(width);
    json channels = json::array();
    for (int channel = 0; channel < type.channel_count(); ++channel) channels.push_back(type.channel_name(channel));
    return {{"name", card.name()},
            {"type", config.type},
            {"title", map.title},
            {"slot", config.slot.value_or(-1)},
            {"live", live == nullptr ? json() : json(live->place)},
            {"about", type.doc},
            {"bus", {{"base", card.bus_base()}, {"widths", std::move(widths)}, {"while_moving", type.measures_only}}},
            {"axes", std::move(axes)},
            {"registers", std::move(registers)},
            {"commands", commands_of(map)},
            {"machines", machines_of(map)},
            {"pins", std::move(pins)},
            {"values", std::move(values)},
            {"quantities", std::move(quantities)},
            {"functions", card.library_functions().size()},
            {"channels", std::move(channels)}};
}

namespace {

json register_json(const std::string& name, const RegisterInfo& reg, std::uint32_t word) {
    json fields = json::object();
    for (const FieldInfo& field : reg.fields)
        fields[std::string(field.name)] = (word & field.mask) >> std::countr_zero(field.mask);
    return {{"name", name}, {"register", reg.name}, {"word", word}, {"fields", std::move(fields)}};
}

/// Returns "RR0", or "x.RR1" for one axis, as on the virtual card.
std::string live_name(const std::string& axis, std::string_view name) {
    if (axis.empty()) return std::string(name);
    return fmt::format("{}.{}", static_cast<char>(std::tolower(static_cast<unsigned char>(axis.front()))), name);
}

json live_now(operate::Machine& machine, const operate::LivePlace& place) {
    const operate::LiveCard* const live = machine.service().live();
    json out = {{"name", place.card},      {"at", to_seconds(machine.now())}, {"registers", json::array()},
                {"values", json::array()}, {"quantities", json::array()},     {"pins", json::object()}};
    if (live == nullptr || live->place().card != place.card) {
        out["reason"] =
            fmt::format("The real card at {} is read while it is in service only. Begin its service.", place.place);
        return out;
    }
    const operate::LiveRegisters& seen = live->registers();
    out["at"] = to_seconds(seen.at);
    if (live->lost()) out["reason"] = live->lost()->message;
    for (const rack::RegisterSnapshot& one : seen.view.registers)
        out["registers"].push_back(register_json(live_name(one.axis, one.reg->name), *one.reg, one.word));
    for (const rack::ValueSnapshot& one : seen.view.values)
        out["values"].push_back({{"name", live_name(one.axis, one.name)}, {"value", one.value}});
    return out;
}

}  // namespace

json card_now(operate::Machine& machine, rack::Card& card) {
    if (const operate::LivePlace* const live = machine.service().live_place(card.name()))
        return live_now(machine, *live);
    const rack::RackCard& config = config_of(machine.rack(), card);
    const rack::CardType& type = *rack::find_card_type(config.type);
    json registers = json::array();
    for (const RegisterInfo& reg : card.map().registers) {
        if (reg.access == Access::write) continue;
        for (const std::string& name : register_names(type, reg))
            if (const Result<std::int64_t> word = card.inspect(name))
                registers.push_back(register_json(name, reg, static_cast<std::uint32_t>(*word)));
    }
    json values = json::array(), quantities = json::array(), pins = json::object();
    for (const std::string& name : card.value_names())
        if (const Result<std::int64_t> value = card.inspect(name))
            values.push_back({{"name", name}, {"value", *value}});
    for (const std::string_view name : card.quantity_names())
        if (const std::optional<double> value = card.quantity(name))
            quantities.push_back({{"name", name}, {"value", *value}});
    for (const rack::CardPin& pin : rack::pins_of(config))
        if (const Result<double> level = machine.wires().get(card.name() + "." + pin.name)) pins[pin.name] = *level;
    return {{"name", card.name()},         {"at", to_seconds(machine.now())},     {"registers", std::move(registers)},
            {"values", std::move(values)}, {"quantities", std::move(quantities)}, {"pins", std::move(pins)}};
}

}  // namespace motionrack::panel
