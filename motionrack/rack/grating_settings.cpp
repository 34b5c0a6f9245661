// Settings of grating-bus cards, and conflicts between them.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/rack/grating.hpp>

namespace motionrack::rack {

namespace {

namespace gb = grating_bus;

/// Returns true for a motion card on the lines of this rack's bus.
bool is_grating(const RackCard& card) {
    return card.type == "grating_bus" && grating_bus_in(card).role != GratingRole::remote;
}
bool is_decoder(const RackCard& card) {
    return card.type == "grating_decoder";
}

Duration ns(double value) {
    return from_seconds(value * 1e-9);
}

gb::Shifter shifter(GratingShifter direction) {
    return static_cast<gb::Shifter>(direction);
}

gb::CardSettings settings_among(const RackCard& card, std::span<const RackCard> before) {
    return grating_settings(card, std::none_of(before.begin(), before.end(), is_grating));
}

/// Returns the conflict between a card and a decoder, if any.
std::optional<CardFlaw> no_fit(const RackCard& card, const gb::CardSettings& settings, const RackCard& decoder) {
    const Result<void> fits = gb::check(settings, decoder_settings(decoder));
    if (fits) return std::nullopt;
    return CardFlaw{"type", fmt::format("Card {} cannot work with the decoder {}: {}", card.name, decoder.name,
                                        fits.error().message)};
}

/// Checks the list of addresses itself, and against the keys that it replaces.
std::optional<CardFlaw> list_flaw(const RackCard& card) {
    const GratingBusSettings& own = grating_bus_in(card);
    if (own.addresses.empty()) return std::nullopt;
    const auto list = gb::addresses_from_text(own.addresses);
    if (!list) return CardFlaw{"addresses", fmt::format("Card {}: {}", card.name, list.error().message)};
    const GratingBusSettings left_out;
    const bool counted = own.scales == left_out.scales || own.scales == static_cast<std::int64_t>(list->size());
    if (counted && own.first == left_out.first) return std::nullopt;
    return CardFlaw{"addresses", fmt::format("Card {} has a list of {} addresses, but also scales = {} and first = {}; "
                                             "leave those two out.",
                                             card.name, list->size(), own.scales, own.first)};
}

}  // namespace

std::vector<int> wanted_scales(const RackCard& card) {
    const GratingBusSettings& own = grating_bus_in(card);
    std::vector<int> out;
    if (own.addresses.empty())
        for (std::int64_t k = 0; k < own.scales; ++k) out.push_back(static_cast<int>(own.first + k));
    else if (auto list = gb::addresses_from_text(own.addresses))
        out = std::move(*list);
    return out;
}

gb::CardSettings grating_settings(const RackCard& card, bool first) {
    const GratingBusSettings& s = grating_bus_in(card);
    gb::CardSettings out;
    const bool host = s.role == GratingRole::host || (s.role == GratingRole::first_is_host && first);
    out.role = s.role == GratingRole::remote ? gb::CardRole::remote : host ? gb::CardRole::host : gb::CardRole::slave;
    out.scales = static_cast<int>(s.scales);
    out.first = static_cast<int>(s.first);
    if (!s.addresses.empty()) {
        out.addresses = wanted_scales(card);
        out.scales = static_cast<int>(out.addresses.size());
    }
    out.timing = {ns(s.t1_ns), ns(s.t2_ns), ns(s.t3_ns), ns(s.clock_ns)};
    out.period = from_seconds(s.period_us * 1e-6);
    out.offset = ns(s.offset_ns);
    out.clock_shifter = shifter(s.clock_shifter);
    out.address_shifter = shifter(s.address_shifter);
    out.verify_lines = s.verify_lines;
    out.seed = static_cast<std::uint32_t>(s.seed);
    return out;
}

gb::DecoderSettings decoder_settings(const RackCard& card) {
    const GratingDecoderSettings& s = grating_decoder_in(card);
    return {static_cast<int>(s.scales), ns(s.latch_ns), ns(s.output_ns)};
}

std::optional<CardFlaw> grating_bus_flaw(const RackCard& card, std::span<const RackCard> before) {
    if (const auto flaw = list_flaw(card)) return flaw;
    const gb::CardSettings own = settings_among(card, before);
    if (const Result<void> good = gb::check(own); !good)
        return CardFlaw{"scales", fmt::format("Card {}: {}", card.name, good.error().message)};
    if (own.role == gb::CardRole::remote) return std::nullopt;
    for (std::size_t i = 0; i < before.size(); ++i) {
        const RackCard& other = before[i];
        if (is_decoder(other))
            if (const auto flaw = no_fit(card, own, other)) return flaw;
        if (!is_grating(other)) continue;
        const gb::CardSettings its = settings_among(other, before.first(i));
        if (own.scales != its.scales)
            return CardFlaw{
                "scales",
                fmt::format(
                    "Card {} reads {} scales and card {} reads {}; all cards of a bus read the same number of scales.",
                    other.name, its.scales, card.name, own.scales)};
        if (own.period != its.period)
            return CardFlaw{
                "period_us",
                fmt::format(
                    "Card {} has a period of {} us and card {} one of {} us; all cards of a bus must have the same.",
                    other.name, grating_bus_in(other).period_us, card.name, grating_bus_in(card).period_us)};
    }
    return std::nullopt;
}

std::optional<CardFlaw> grating_decoder_flaw(const RackCard& card, std::span<const RackCard> before) {
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (is_decoder(before[i]))
            return CardFlaw{"type", fmt::format("The rack has two decoders, {} and {}; a bus has one, with all scales.",
                                                before[i].name, card.name)};
        if (!is_grating(before[i])) continue;
        if (const auto flaw = no_fit(before[i], settings_among(before[i], before.first(i)), card)) return flaw;
    }
    return std::nullopt;
}

std::size_t grating_decoder_pin_count(const RackCard& card) {
    return 2 * static_cast<std::size_t>(std::clamp<std::int64_t>(grating_decoder_in(card).scales, 1, gb::max_scales));
}

}  // namespace motionrack::rack
