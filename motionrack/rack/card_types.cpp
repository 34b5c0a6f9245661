// Pins and channels of a type of card.
#include <fmt/format.h>

#include <motionrack/rack/card_types.hpp>

namespace motionrack::rack {

std::string card_types_text(bool (*holds)(const CardType& type)) {
    return fmt::format("{}", fmt::join(card_types_that(holds), " or "));
}

std::vector<CardPin> pins_of(const RackCard& card) {
    const CardType* type = find_card_type(card.type);
    if (type == nullptr) return {};
    CardType own = *type;
    if (type->chip_pin_count != nullptr) own.chip_pins = own.chip_pins.first(type->chip_pin_count(card));
    return pins_of(own);
}

std::vector<CardPin> pins_of(const CardType& type) {
    std::vector<CardPin> out;
    for (int channel = 0; channel < type.channel_count(); ++channel)
        for (const PinType& pin : type.channel_pins)
            out.push_back({std::string(type.channel_name(channel)).append(pin.name),
                           pin.direction,
                           channel,
                           pin.volts,
                           pin.kind,
                           pin.bits,
                           pin.doc,
                           {}});
    for (const PinType& pin : type.chip_pins)
        out.push_back({std::string(pin.name), pin.direction, -1, pin.volts, pin.kind, pin.bits, pin.doc, pin.same_as});
    return out;
}

int CardType::channel_of(std::string_view channel_name) const {
    if (channels.empty()) return channel_name.empty() ? channel_count() - 1 : -1;
    const std::size_t at = channels.find(channel_name);
    return channel_name.size() != 1 || at == std::string_view::npos ? -1 : static_cast<int>(at);
}

}  // namespace motionrack::rack
