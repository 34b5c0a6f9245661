// Cards: their maps, registers with and without side effects, interrupts.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <motionrack/rack/bus_access.hpp>
#include <motionrack/rack/card_types.hpp>
#include <motionrack/rack/register_view.hpp>
#include <python/src/bindings.hpp>
#include <python/src/map_dict.hpp>
#include <python/src/rack_lock.hpp>

namespace motionrack::python {

namespace {

py::str text(std::string_view view) {
    return py::str(view.data(), view.size());
}

py::dict dict_of(const RegisterInfo& reg) {
    static constexpr const char* access[] = {"read", "write", "read_clears"};
    py::dict out;
    out["name"] = text(reg.name);
    out["offset"] = reg.offset;
    out["width"] = reg.width;
    out["access"] = access[static_cast<std::size_t>(reg.access)];
    out["per_axis"] = reg.per_axis;
    out["bank"] = text(reg.bank);
    out["meaning"] = text(reg.meaning);
    py::list fields;
    for (const FieldInfo& field : reg.fields)
        fields.append(py::make_tuple(text(field.name), field.mask, text(field.meaning)));
    out["fields"] = fields;
    return out;
}

py::dict dict_of(const CommandInfo& command) {
    py::dict out;
    out["name"] = text(command.name);
    out["code"] = command.code;
    out["data_bytes"] = command.data_bytes;
    out["answer_bytes"] = command.answer_bytes;
    out["min"] = command.min;
    out["max"] = command.max;
    out["unit"] = text(command.unit);
    out["variant"] = text(command.variant);
    out["meaning"] = text(command.meaning);
    out["reproduced"] = command.reproduced;
    return out;
}

py::dict dict_of(const MachineInfo& machine) {
    py::dict out;
    out["name"] = text(machine.name);
    out["meaning"] = text(machine.meaning);
    py::list states, transitions;
    for (const StateInfo& state : machine.states) states.append(py::make_tuple(text(state.name), text(state.meaning)));
    for (const TransitionInfo& each : machine.transitions)
        transitions.append(py::make_tuple(text(each.from), text(each.to), text(each.when)));
    out["states"] = states;
    out["transitions"] = transitions;
    return out;
}

}  // namespace

py::dict map_dict(const CardMap& map) {
    py::dict out;
    out["name"] = text(map.name);
    out["title"] = text(map.title);
    py::list registers, commands, machines, pins;
    for (const RegisterInfo& reg : map.registers) registers.append(dict_of(reg));
    for (const CommandInfo& command : map.commands) commands.append(dict_of(command));
    for (const MachineInfo& machine : map.machines) machines.append(dict_of(machine));
    for (const PinInfo& pin : map.pins)
        pins.append(py::make_tuple(text(pin.name), pin.direction == PinDirection::input ? "input" : "output",
                                   pin.active_low, text(pin.meaning)));
    out["registers"] = registers;
    out["commands"] = commands;
    out["machines"] = machines;
    out["pins"] = pins;
    return out;
}

namespace {

const rack::RackCard& config_of_card(RackHandle& world, const std::string& name) {
    for (const rack::RackCard& card : world.config().cards)
        if (card.name == name) return card;
    static_cast<void>(value_of(rack::card_named(world.rack(), name)));
    refuse("The card is unknown.");
}

/// Returns the description of a card: {type, map, channels, widths, base, values, quantities, faults}.
py::dict describe(RackHandle& world, const std::string& name) {
    const rack::Card& card = *value_of(rack::card_named(world.rack(), name));
    const rack::RackCard& config = config_of_card(world, name);
    const rack::CardType& type = *rack::find_card_type(config.type);
    py::dict out;
    out["type"] = config.type;
    out["map"] = map_dict(card.map());
    py::list channels, values, quantities, pins;
    for (int i = 0; i < type.channel_count(); ++i)
        if (!type.channel_name(i).empty()) channels.append(text(type.channel_name(i)));
    for (const std::string& each : card.value_names()) values.append(each);
    for (const std::string_view each : card.quantity_names()) quantities.append(text(each));
    for (const rack::CardPin& pin : rack::pins_of(config)) pins.append(py::make_tuple(pin.name, text(pin.doc)));
    out["channels"] = channels;
    out["values"] = values;
    out["quantities"] = quantities;
    out["pins"] = pins;
    out["widths"] = std::vector<int>(card.bus_widths().begin(), card.bus_widths().end());
    out["base"] = card.bus_base();
    return out;
}

std::uint32_t read(RackHandle& world, const std::string& card, int bits, std::uint32_t address) {
    return run_exclusive(world, [&]() -> Result<std::uint32_t> {
        MOTIONRACK_TRY(rack::Card * on, rack::card_for_access(world.running(), card, bits, address, false));
        return on->bus_read(bits, address);
    });
}

void write_register(RackHandle& world, const std::string& card, int bits, std::uint32_t address, std::int64_t value) {
    run_exclusive(world, [&]() -> Result<void> {
        MOTIONRACK_TRY(rack::Card * on, rack::card_for_access(world.running(), card, bits, address, true));
        if (value < 0 || value >> bits != 0)
            return fail(ErrorKind::refused, fmt::format("{} does not fit into {} bits: 0 to {}; nothing was written.",
                                                        value, bits, (std::int64_t{1} << bits) - 1));
        on->bus_write(bits, address, static_cast<std::uint32_t>(value));
        return {};
    });
}

/// Returns the decoded registers as read through the port.
std::string view(RackHandle& world, const std::string& card, bool clearing) {
    return run_exclusive(world, [&]() -> Result<std::string> {
        MOTIONRACK_TRY(rack::Card * on, rack::card_named(world.running(), card));
        const rack::CardPlugin* plugin = rack::find_card_plugin(config_of_card(world, card).type);
        if (plugin->view == nullptr)
            return fail(
                ErrorKind::refused,
                fmt::format("The registers of a {} cannot be read as a list; nothing was done. Read them one by one.",
                            plugin->type.name));
        MOTIONRACK_TRY(const rack::RegisterView seen,
                       plugin->view(rack::bus_of(*on, config_of_card(world, card)), clearing));
        return rack::view_text(seen, false);
    });
}

}  // namespace

void bind_cards(py::module_& m) {
    m.def(
        "describe_card",
        [](RackHandle& world, const std::string& card) {
            return inspect_rack(world, [&] { return describe(world, card); });
        },
        py::arg("world"), py::arg("card"));
    m.def(
        "peek",
        [](RackHandle& world, const std::string& card, const std::string& name) {
            return inspect_rack(
                world, [&] { return value_of(value_of(rack::card_named(world.running(), card))->inspect(name)); });
        },
        py::arg("world"), py::arg("card"), py::arg("name"));
    m.def("read", &read, py::arg("world"), py::arg("card"), py::arg("bits"), py::arg("address"));
    m.def("write", &write_register, py::arg("world"), py::arg("card"), py::arg("bits"), py::arg("address"),
          py::arg("value"));
    m.def(
        "wait_interrupt",
        [](RackHandle& world, const std::string& card, std::int64_t timeout) {
            const Duration time = timeout_of(timeout);
            return run_exclusive(world, [&]() -> Result<bool> {
                MOTIONRACK_TRY(rack::Card * on, rack::card_named(world.running(), card));
                return on->host().wait(time);
            });
        },
        py::arg("world"), py::arg("card"), py::arg("ticks"));
    m.def("view", &view, py::arg("world"), py::arg("card"), py::arg("clearing"));
}

}  // namespace motionrack::python
