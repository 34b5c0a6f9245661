// Table of the card types that move axes.
#include <fmt/format.h>

#include <array>
#include <limits>
#include <motionrack/cards/databoard4002/trim_text.hpp>
#include <motionrack/rack/card_type_rows.hpp>

namespace motionrack::rack {
namespace {

using enum PinDirection;

// ---- mcx314

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
    {"drive", output, "high while the axis moves; of an mcx314as also the deviation counter clear pulse"},
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

constexpr std::array<std::string_view, 2> low_speed_drives = {"at V", "at SV"};
constexpr std::array<std::string_view, 2> software_limits = {"beyond", "at"};

constexpr std::array<Field, 8> mcx314_settings = {
    with_choices(field<&Mcx314Settings::variant>("variant", 0, 0, "",
                                                 "the chip: the original, or the one with filters, automatic home "
                                                 "search, synchronous actions and wide ranges"),
                 mcx314_variants),
    with_choices(formerly("slow_drives", field<&Mcx314Settings::low_speed_drive>(
                                             "low_speed_drive", 0, 0, "",
                                             "the speed of a drive with V <= SV; the sources do not agree")),
                 low_speed_drives),
    with_choices(field<&Mcx314Settings::software_limits>(
                     "software_limits", 0, 0, "",
                     "whether + software limits begin beyond COMP+ or at it; the sources do not agree"),
                 software_limits),
    field<&Mcx314Settings::ao_after_reset>("ao_after_reset", 0, 65'535, "pulses",
                                           "initial AO; not stated in the sources"),
    field<&Mcx314Settings::clock_hz>("clock_hz", 16'000'000, 16'000'000, "Hz",
                                     "the chip's clock; the model knows the documented one"),
    with_choices(field<&Mcx314Settings::bus>("bus", 0, 0, "", "width of the host's bus"), bus_widths),
    field<&Mcx314Settings::bus_access_ns>(
        "bus_access_ns", 0, 100'000, "ns",
        "time that one access of the host takes; two of them to a register on 8 bits"),
    field<&Mcx314Settings::host_latency_us>(
        "host_latency_us", 0, 10'000, "us",
        "from an interrupt of the card to the host's first access; path segments are at least this long"),
};

// At most one pulse every four clocks (R = 16,000, V = 8,000: every second tick of the halved clock).
double mcx314_pulse_hz(const RackCard& card) {
    return static_cast<double>(card.mcx314.clock_hz) / 4;
}

// A = 8,000 at multiple 500: 8,000 * 125 * 500 pulses/s2.
double mcx314_accel_hz_s(const RackCard&) {
    return 8000.0 * 125 * 500;
}

// The inputs are sampled at every second clock; shorter states are missed.
double mcx314_encoder_hz(const RackCard& card) {
    return static_cast<double>(card.mcx314.clock_hz) / 2;
}

void* mcx314_of(RackCard& card) {
    return &card.mcx314;
}

// ---- databoard4002

constexpr std::array<PinType, 11> databoard4002_channel_pins = {{
    {"o1", input, "encoder track A, or down pulses"},
    {"o2", input, "encoder track B, or up pulses"},
    {"zero", input, "zero pulse of the encoder"},
    {"ref", input, "reference; high, without current, is active", 0, PinKind::contact},
    {"esr", input, "end stop right; high, without current, is active", 0, PinKind::contact},
    {"esl", input, "end stop left; high, without current, is active", 0, PinKind::contact},
    {"vout", output, "analog output after the relay, V", 1e-6},
    {"sign", output, "direction, high is +"},
    {"fout", output, "speed as a frequency"},
    {"relay", output, "high while the analog output is connected"},
    {"vdirect", output, "analog output before the relay, on which ems does not act, V", 1e-6},
}};

constexpr std::array<PinType, 4> databoard4002_pins = {{
    {"ems", input, "emergency stop; high, without current, is active", 0, PinKind::contact},
    {"rst", output, "pulse of 10 us at a reset of the card"},
    {"int", output, "interrupt, active high"},
    {"csb", output, "high while the host addresses the card; also drives the LED"},
}};

// Only wires to existing parts of the axis apply: a servo amplifier at the analog output, or a stepping motor at the
// frequency.
constexpr std::array<DefaultWire, 10> databoard4002_wires = {{
    {"vout", "drive"},
    {"fout", "step"},
    {"sign", "dir"},
    {"o1", "enc_a"},
    {"o2", "enc_b"},
    {"zero", "enc_z"},
    {"ref", "cam"},
    {"ref", "home"},
    {"esr", "limit_plus"},
    {"esl", "limit_minus"},
}};

constexpr std::array<Lamp, 3> mcx314_lamps = {{{"alarm", "alarm", 0}, {"capture", "in3", 0}, {"compare", "out4"}}};
constexpr std::array<StopPin, 4> mcx314_stop_pins = {{
    {"emgn", StopSource::emergency_stop},
    {"alarm", StopSource::drive_alarm},
    {"lmtp", StopSource::limit_switch, 0, +1},
    {"lmtm", StopSource::limit_switch, 0, -1},
}};
constexpr std::array<StopPin, 3> databoard4002_stop_pins = {{
    {"ems", StopSource::emergency_stop, 1},
    {"esr", StopSource::limit_switch, 1, +1},
    {"esl", StopSource::limit_switch, 1, -1},
}};
constexpr std::array<std::string_view, 4> mcx314_stops = {"in0", "in1", "in2", "in3"};
constexpr std::array<std::string_view, 1> databoard4002_references = {"ref"}, databoard4002_zeros = {"zero"};

constexpr std::array<std::string_view, 4> databoard4002_count_modes = {"quadrature x4", "quadrature x2",
                                                                       "quadrature x1", "up/down"};

constexpr std::array<Field, 11> databoard4002_settings = {
    formerly("select", field<&Databoard4002Settings::card_number>(
                           "card_number", 0, 31, "", "its number on the bus; the host selects it by port 1")),
    with_choices(formerly("counting", field<&Databoard4002Settings::count_mode>(
                                          "count_mode", 0, 0, "", "counting of O1 and O2, by the straps")),
                 databoard4002_count_modes),
    field<&Databoard4002Settings::first_pair>(
        "first_pair", 0, 3, "", "the first strap pair: 0 A-B, 1 C-D, 2 E-F, 3 G-H; x2 has 0 and 1, x4 only 0"),
    field<&Databoard4002Settings::single_ended>("single_ended", 0, 0, "",
                                                "encoder lines up to 50 kHz instead of 100 kHz"),
    field<&Databoard4002Settings::zeroing>("zeroing", 0, 0, "",
                                           "enabling the zero or reference event arms the zeroing of the counter"),
    field<&Databoard4002Settings::quit_zeroes>("quit_zeroes", 0, 0, "",
                                               "the command Q zeroes the position that P or N has set, as printed"),
    field<&Databoard4002Settings::trim>("trim", 0, 2'000, "",
                                        "the trim table that came with the card, rows of V and rate with commas "
                                        "between, as in \"0.01 13799, 0.025 14051\"; empty: the printed one"),
    field<&Databoard4002Settings::version>("version", 0, 255, "",
                                           "version of the card's program, as the command V returns it"),
    formerly("pass_ticks", field<&Databoard4002Settings::firmware_pass_ticks>(
                               "firmware_pass_ticks", 1, 4'000, "", "ticks of 2.5 us in a pass of the card's program")),
    field<&Databoard4002Settings::byte_time_ns>("byte_time_ns", 2'500, 100'000'000, "ns",
                                                "time that the card's program takes for an access"),
    field<&Databoard4002Settings::bus_access_ns>("bus_access_ns", 0, 100'000, "ns",
                                                 "time that one access of the host takes"),
};

// Highest rate of the card's program: rate 16383.
double databoard4002_pulse_hz(const RackCard&) {
    return 400'000;
}

double any_accel(const RackCard&) {
    return std::numeric_limits<double>::infinity();
}

// Counts all edges; an up or down pulse counts as one pulse.
double databoard4002_encoder_hz(const RackCard& card) {
    const Databoard4002Settings& own = card.databoard4002;
    return (own.single_ended ? 50'000.0 : 100'000.0) * (own.count_mode == Databoard4002CountMode::up_down ? 1 : 4);
}

void* databoard4002_of(RackCard& card) {
    return &card.databoard4002;
}

std::optional<CardFlaw> databoard4002_flaw(const RackCard& card, std::span<const RackCard> before) {
    const Databoard4002Settings& own = card.databoard4002;
    for (const RackCard& other : before)
        if (other.type == card.type && other.databoard4002.card_number == own.card_number)
            return CardFlaw{
                "card_number",
                fmt::format("Cards {} and {} are on one bus and have both the number {}; give one of them another "
                            "`card_number` (0 .. 31).",
                            other.name, card.name, own.card_number)};
    if (const auto trim = databoard4002::trim_from_text(own.trim); !trim)
        return CardFlaw{"trim", fmt::format("Card {}: {}", card.name, trim.error().message)};
    const std::int64_t max_pair = own.count_mode == Databoard4002CountMode::quadrature_2   ? 1
                                  : own.count_mode == Databoard4002CountMode::quadrature_1 ? 3
                                                                                           : 0;
    if (own.first_pair <= max_pair) return std::nullopt;
    return CardFlaw{"first_pair",
                    fmt::format("Card {} has the first strap pair {}, but counted as \"{}\" it is {}.", card.name,
                                own.first_pair, databoard4002_count_modes[static_cast<std::size_t>(own.count_mode)],
                                max_pair == 0 ? "0" : fmt::format("0 .. {}", max_pair))};
}

}  // namespace

CardType mcx314_type() {
    // clang-format off
    return {"mcx314", "four-axis pulse chip with interpolation", "xyzu", mcx314_channel_pins, mcx314_chip_pins,
        mcx314_wires, "emgn", mcx314_settings, mcx314_of, mcx314_pulse_hz, mcx314_accel_hz_s, mcx314_encoder_hz,
        2'147'483'647, mcx314_stops, mcx314_stops, false, nullptr, nullptr, mcx314_lamps, "in3", mcx314_stop_pins};
    // clang-format on
}

CardType databoard4002_type() {
    // clang-format off
    return {"databoard4002",
        "intelligent positioning card for one axis, which has a servo or a stepping motor; with no axis on it an ideal "
        "motor follows its pulses, one count each",
        "", databoard4002_channel_pins, databoard4002_pins, databoard4002_wires, "ems", databoard4002_settings,
        databoard4002_of, databoard4002_pulse_hz, any_accel, databoard4002_encoder_hz, 8'388'607,
        databoard4002_references, databoard4002_zeros, true, databoard4002_flaw, nullptr, {}, {},
        databoard4002_stop_pins};
    // clang-format on
}

}  // namespace motionrack::rack
