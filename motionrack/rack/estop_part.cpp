// The emergency stop as a part: its signal, and the wires of the safety contacts.
#include <fmt/format.h>

#include <array>
#include <motionrack/rack/card_types.hpp>
#include <motionrack/rack/part_catalogue.hpp>
#include <motionrack/rack/rack.hpp>
#include <string>
#include <vector>

namespace motionrack::rack {

namespace {

constexpr std::array<SignalRow<RackSafety>, 1> estop_signals = {{
    {{}, PinDirection::output, "the emergency stop button: low while it is pressed"},
}};

std::string estop_name_of(const RackConfig&, std::size_t) {
    return "estop";
}

std::vector<PartSignal> signals_of_estop(const RackConfig& config) {
    std::vector<PartSignal> out;
    append_signals(estop_signals, config.safety, {EndOwner::estop, 0, "estop", "the emergency stop", {}}, out);
    return out;
}

/// Joins the emergency stop to each card that has an input for it.
void join_estop(const RackConfig& config, const JoinPins& join) {
    for (const RackCard& card : config.cards) {
        const CardType* type = find_card_type(card.type);
        if (type != nullptr && !type->estop_pin.empty())
            join(fmt::format("{}.{}", card.name, type->estop_pin), "estop");
    }
}

/// Lists the wires of the emergency stop and of the contacts that the rack file declares.
std::vector<PartWire> wires_of_contacts(Rack& rack) {
    std::vector<PartWire> out;
    for (const char* contact : {"estop", "estop1", "estop2", "door"})
        if (const sim::WireId wire = rack.kernel().find_wire(contact); wire != sim::WireId::none)
            out.push_back({contact, wire});
    return out;
}

constexpr PartSignals estop_part_signals = {
    EndOwner::estop,   [] { return declared_signals<RackSafety>(estop_signals, "estop"); },
    signals_of_estop,  estop_name_of,
    wires_of_contacts, join_estop,
};

}  // namespace

constexpr PartKind estop_part_kind = {"estop", nullptr, nullptr, nullptr, nullptr, &estop_part_signals};

}  // namespace motionrack::rack
