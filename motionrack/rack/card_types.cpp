// The table of card types.
#include <algorithm>
#include <array>
#include <motionrack/rack/card_types.hpp>

namespace motionrack::rack {
namespace {

using enum PinDirection;

// ---- mcx314 -----------------------------------------------------------------------------------------------------

constexpr std::array<PinType, 23> mcx314_channel_pins = {{
    {"pp", output, "pulse (one-pulse mode), or pulses in the + direction"},
    {"pm", output, "direction (one-pulse mode), or pulses in the - direction"},
    {"eca", input, "encoder A"},
    {"ecb", input, "encoder B"},
    {"in0", input, "stop input 0"},
    {"in1", input, "stop input 1"},
    {"in2", input, "stop input 2"},
    {"in3", input, "stop input 3"},
    {"lmtp", input, "limit in the + direction"},
    {"lmtm", input, "limit in the - direction"},
    {"alarm", input, "alarm of the motor's drive"},
    {"inpos", input, "in position, from the motor's drive"},
    {"expp", input, "external operation +"},
    {"expm", input, "external operation -"},
    {"drive", output, "high while the axis drives; of an mcx314as also the deviation counter clear pulse"},
    {"out0", output, "general output 0"},
    {"out1", output, "general output 1"},
    {"out2", output, "general output 2"},
    {"out3", output, "general output 3"},
    {"out4", output, "general output 4"},
    {"out5", output, "general output 5"},
    {"out6", output, "general output 6"},
    {"out7", output, "general output 7"},
}};

constexpr std::array<PinType, 3> mcx314_chip_pins = {{
    {"emgn", input, "emergency stop of all axes, active low"},
    {"expls_n", input, "external pulse of interpolation, active low"},
    {"int_n", output, "interrupt, active low"},
}};

constexpr std::array<DefaultWire, 8> mcx314_wires = {{
    {"pp", "step"},
    {"pm", "dir"},
    {"eca", "enc_a"},
    {"ecb", "enc_b"},
    {"in2", "enc_z"},
    {"in0", "home"},
    {"lmtp", "limit_plus"},
    {"lmtm", "limit_minus"},
}};

constexpr std::array<std::string_view, 2> mcx314_variants = {"mcx314", "mcx314as"};
constexpr std::array<std::string_view, 2> bus_widths = {"16-bit", "8-bit"};

constexpr std::array<std::string_view, 2> slow_drives = {"at V", "at SV"};
constexpr std::array<std::string_view, 2> software_limits = {"beyond", "at"};

constexpr std::array<Field, 7> mcx314_settings = {
    with_choices(field<&Mcx314Settings::variant>("variant", 0, 0, "",
                                                 "the chip: the original, or the one with filters, automatic home "
                                                 "search, synchronous actions and wide ranges"),
                 mcx314_variants),
    with_choices(field<&Mcx314Settings::slow_drives>("slow_drives", 0, 0, "",
                                                     "the speed of a drive with V <= SV; the sources do not agree"),
                 slow_drives),
    with_choices(field<&Mcx314Settings::software_limits>(
                     "software_limits", 0, 0, "",
                     "whether + software limits begin beyond COMP+ or at it; the sources do not agree"),
                 software_limits),
    field<&Mcx314Settings::ao_after_reset>("ao_after_reset", 0, 65'535, "pulses",
                                           "AO until the host writes it; the sources do not say"),
    field<&Mcx314Settings::clock_hz>("clock_hz", 16'000'000, 16'000'000, "Hz",
                                     "the chip's clock; the model knows the documented one"),
    with_choices(field<&Mcx314Settings::bus>("bus", 0, 0, "", "how wide the host's bus is"), bus_widths),
    field<&Mcx314Settings::bus_access_ns>("bus_access_ns", 0, 100'000, "ns",
                                          "time that one access of the host takes; two of them to a register on 8 bits"),
};

// One pulse at most every four clocks (R = 16,000, V = 8,000: every second tick of the halved clock).
double mcx314_pulse_hz(const RackCard& card) {
    return static_cast<double>(card.mcx314.clock_hz) / 4;
}

// A = 8,000 at multiple 500: 8,000 * 125 * 500 pulses/s2.
double mcx314_accel_hz_s(const RackCard&) {
    return 8000.0 * 125 * 500;
}

// The inputs are sampled at every second clock; a state that is shorter is not seen.
double mcx314_encoder_hz(const RackCard& card) {
    return static_cast<double>(card.mcx314.clock_hz) / 2;
}

void* mcx314_of(RackCard& card) {
    return &card.mcx314;
}

constexpr std::array<CardType, 1> table = {{
    {"mcx314", "four-axis pulse chip with interpolation", "xyzu", mcx314_channel_pins, mcx314_chip_pins, mcx314_wires,
     "emgn", mcx314_settings, mcx314_of, mcx314_pulse_hz, mcx314_accel_hz_s, mcx314_encoder_hz},
}};

}  // namespace

std::span<const CardType> card_types() {
    return table;
}

const CardType* find_card_type(std::string_view name) {
    const auto found =
        std::find_if(table.begin(), table.end(), [&](const CardType& type) { return type.name == name; });
    return found != table.end() ? &*found : nullptr;
}

std::vector<Pin> pins_of(const CardType& type) {
    std::vector<Pin> out;
    for (std::size_t channel = 0; channel < type.channels.size(); ++channel) {
        for (const PinType& pin : type.channel_pins) {
            out.push_back({type.channels[channel] + std::string(pin.name), pin.direction, static_cast<int>(channel)});
        }
    }
    for (const PinType& pin : type.chip_pins) out.push_back({std::string(pin.name), pin.direction, -1});
    return out;
}

}  // namespace motionrack::rack
