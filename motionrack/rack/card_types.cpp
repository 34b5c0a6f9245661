// Table of card types. Those that move axes are in card_types_axes.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <motionrack/cards/grating_bus/map.hpp>
#include <motionrack/cards/ioflex02/image.hpp>
#include <motionrack/cards/ioflex02/map.hpp>
#include <motionrack/cards/rtc5/map.hpp>
#include <motionrack/rack/card_type_rows.hpp>
#include <motionrack/rack/card_types.hpp>
#include <motionrack/rack/grating.hpp>

namespace motionrack::rack {
namespace {

using enum PinDirection;

/// Copies the card's own list of pins; `volts` applies to pins whose names begin with "vout".
template <std::size_t n>
constexpr std::array<PinType, n> own_pins(const PinInfo* pins) {
    std::array<PinType, n> out{};
    for (std::size_t i = 0; i < n; ++i)
        out[i] = {pins[i].name,    pins[i].direction,
                  pins[i].meaning, pins[i].name.substr(0, 4) == "vout" ? 1e-6 : 0,
                  PinKind::plain,  1,
                  pins[i].same_as};
    return out;
}

// ---- ioflex02

constexpr auto ioflex02_pins = own_pins<std::size(ioflex02::map::pins)>(ioflex02::map::pins);

constexpr std::array<Field, 6> ioflex02_settings = {
    field<&Ioflex02Settings::base_address>("base_address", 0, 0xFF00, "",
                                           "address on the host's bus: a multiple of 256"),
    field<&Ioflex02Settings::serial>("serial", 0, 65'535, "", "its serial number"),
    field<&Ioflex02Settings::configuration_ms>(
        "configuration_ms", 0, 60'000, "ms", "time from the last byte of a configuration image to the running project"),
    formerly("loaded", field<&Ioflex02Settings::preloaded>(
                           "preloaded", 0, 0, "", "true: its project runs from the start; false: the host loads it")),
    absent_means(field<&Ioflex02Settings::image>(
                     "image", 0, 2 * ioflex02::max_image_file, "",
                     "its configuration image in hexadecimal digits, as `motionrack image show --hex` prints it: it "
                     "runs from the start, and Init of the function libraries loads it"),
                 "the built-in one"),
    field<&Ioflex02Settings::bus_access_ns>("bus_access_ns", 0, 100'000, "ns",
                                            "time that one access of the host takes"),
};

double nothing(const RackCard&) {
    return 0;
}

void* ioflex02_of(RackCard& card) {
    return &card.ioflex02;
}

/// Returns the header data of its image, if valid.
Result<ioflex02::ImageInfo> ioflex02_image(const Ioflex02Settings& settings) {
    MOTIONRACK_TRY(const auto file, ioflex02::bytes_of_hex(settings.image));
    MOTIONRACK_TRY(const auto raw, ioflex02::unpacked(file));
    return ioflex02::inspect(raw);
}

std::optional<CardFlaw> ioflex02_flaw(const RackCard& card, std::span<const RackCard> before) {
    for (const RackCard& other : before)
        if (other.type == card.type && other.ioflex02.serial == card.ioflex02.serial)
            return CardFlaw{"serial", fmt::format("Cards {} and {} have the same serial number {}; it must be unique.",
                                                  other.name, card.name, card.ioflex02.serial)};
    if (!card.ioflex02.image.empty())
        if (const auto raw = ioflex02_image(card.ioflex02); !raw) return CardFlaw{"image", raw.error().message};
    if (card.ioflex02.base_address % 256 == 0) return std::nullopt;
    return CardFlaw{"base_address",
                    fmt::format("base_address of card {} is {}; it must be a multiple of 256, such as {}.", card.name,
                                card.ioflex02.base_address, card.ioflex02.base_address / 256 * 256)};
}

// ---- grating_bus, grating_decoder

constexpr auto grating_bus_pins = own_pins<std::size(grating_bus::map::pins)>(grating_bus::map::pins);
constexpr auto grating_decoder_pins = [] {
    std::array<PinType, std::size(grating_bus::map::scale_pins)> out{};
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = {grating_bus::map::scale_pins[i].view(), input, grating_bus::map::decoder_pins[i % 2].meaning};
    return out;
}();

constexpr std::array<std::string_view, 4> grating_roles = {"first is host", "host", "slave", "remote"};
constexpr std::array<std::string_view, 3> shifter_ways = {"as role", "out", "in"};

constexpr std::array<Field, 15> grating_bus_settings = {
    with_choices(field<&GratingBusSettings::role>(
                     "role", 0, 0, "",
                     "the host drives clock and addresses, slaves only read; the first card of the rack is the host by "
                     "default; a remote one listens to a bus on another computer (motionrack "
                     "frames feed)"),
                 grating_roles),
    field<&GratingBusSettings::scales>("scales", 1, 128, "", "scales of a frame"),
    field<&GratingBusSettings::first>("first", 0, 127, "", "address of the first scale"),
    field<&GratingBusSettings::addresses>(
        "addresses", 0, 600, "",
        "addresses of the scales in the order in which they are read, as in \"5, 2, 9\", each 0 to 127 and only once; "
        "excludes scales and first; empty: from first on, as many as scales"),
    field<&GratingBusSettings::t1_ns>("t1_ns", 0.1, 6'000, "ns", "wait until the decoder has latched"),
    field<&GratingBusSettings::t2_ns>("t2_ns", 0.1, 6'000, "ns", "wait from the address to stable data"),
    field<&GratingBusSettings::t3_ns>("t3_ns", 0.1, 6'000, "ns", "wait until the data are latched"),
    field<&GratingBusSettings::clock_ns>("clock_ns", 0.1, 6'000, "ns", "period of the logic's clock"),
    field<&GratingBusSettings::period_us>("period_us", 1, 100'000, "us", "period of the frames"),
    field<&GratingBusSettings::offset_ns>("offset_ns", 0, 1e8, "ns", "time of a host's first frame, at most a period"),
    with_choices(field<&GratingBusSettings::clock_shifter>("clock_shifter", 0, 0, "",
                                                           "direction of the level shifter of clk, hold and read_n"),
                 shifter_ways),
    with_choices(field<&GratingBusSettings::address_shifter>("address_shifter", 0, 0, "",
                                                             "direction of the level shifter of addr"),
                 shifter_ways),
    formerly("checks", field<&GratingBusSettings::verify_lines>("verify_lines", 0, 0, "",
                                                                "frames with wrong line levels are not published")),
    field<&GratingBusSettings::seed>("seed", 0, 2'147'483'647, "", "of the jitter that can be injected"),
    field<&GratingBusSettings::bus_access_ns>("bus_access_ns", 0, 100'000, "ns",
                                              "time that one access of the processor takes"),
};

constexpr std::array<Field, 4> grating_decoder_settings = {
    field<&GratingDecoderSettings::scales>("scales", 1, 128, "",
                                           "number of scales that it counts, each with a pair of pins a0 b0, a1 b1 .."),
    field<&GratingDecoderSettings::latch_ns>("latch_ns", 0, 6'000, "ns", "from HOLD to valid counts"),
    field<&GratingDecoderSettings::output_ns>("output_ns", 0.1, 6'000, "ns", "from the address to valid data"),
    field<&GratingDecoderSettings::bus_access_ns>("bus_access_ns", 0, 100'000, "ns",
                                                  "time that one access of the host takes"),
};

void* grating_bus_of(RackCard& card) {
    return &card.grating_bus;
}

void* grating_decoder_of(RackCard& card) {
    return &card.grating_decoder;
}

// ---- rtc5

constexpr auto rtc5_pins = [] {
    auto out = own_pins<std::size(rtc5::map::pins)>(rtc5::map::pins.data());
    for (std::size_t i = 0; i < out.size(); ++i) out[i].bits = rtc5::map::lines[i].bits;
    return out;
}();

constexpr std::array<Field, 1> rtc5_settings = {
    field<&Rtc5Settings::list_memory>("list_memory", rtc5::min_list_memory, rtc5::max_list_memory, "",
                                      "positions for list commands; a copy of the rack copies them all"),
};

void* rtc5_of(RackCard& card) {
    return &card.rtc5;
}

// clang-format off
const std::array<CardType, 6>& card_type_table() {
    static const std::array<CardType, 6> rows = {{
    mcx314_type(),
    databoard4002_type(),
    {"ioflex02", "position card for four encoders with calibration and time; it moves no axis, and its lines are wires",
     "", {},
     ioflex02_pins, {}, "", ioflex02_settings, ioflex02_of, nothing, nothing, nothing, 8'388'607, {}, {}, false,
     ioflex02_flaw, nullptr, {}, {}, {}, true},
    {"grating_bus",
     "motion card of a grating bus: all such cards of a rack read the same scales at the same instant, one as host, "
     "the others listening", "", {},
     grating_bus_pins, {}, "", grating_bus_settings, grating_bus_of, nothing, nothing, nothing, 2'147'483'647, {}, {},
     false, grating_bus_flaw},
    {"grating_decoder",
     "decoder card of the grating bus: counts up to 128 scales and freezes them at HOLD; a rack of grating_bus cards "
     "without one gets one called `decoder`", "", {},
     grating_decoder_pins, {}, "", grating_decoder_settings, grating_decoder_of, nothing, nothing, nothing,
     2'147'483'647, {}, {}, false, grating_decoder_flaw,
     grating_decoder_pin_count},
    {"rtc5",
     "control of a laser scan head that marks moving parts; it moves no axis and has no bus: programs use the commands "
     "of its library", "", {},
     rtc5_pins, {}, "", rtc5_settings, rtc5_of, nothing, nothing, nothing, 2'147'483'647},
    }};
    return rows;
}
// clang-format on

}  // namespace

std::span<const CardType> card_types() {
    return card_type_table();
}

const CardType* find_card_type(std::string_view name) {
    const auto found = std::find_if(card_type_table().begin(), card_type_table().end(),
                                    [&](const CardType& type) { return type.name == name; });
    return found != card_type_table().end() ? &*found : nullptr;
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
