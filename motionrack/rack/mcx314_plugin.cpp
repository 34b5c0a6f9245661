// Description of an MCX314 for the rack file reader, and its register view, function library and stop reactions.
#include <array>
#include <motionrack/cards/mcx314/chip/chip.hpp>
#include <motionrack/cards/mcx314/chip/general_outputs.hpp>
#include <motionrack/cards/mcx314/library/library.hpp>
#include <motionrack/cards/mcx314/map.hpp>
#include <motionrack/rack/mcx314_card.hpp>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::rack {

namespace {

using enum PinDirection;

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

// Returns the highest pulse rate, pulses/s: one pulse every four clocks (R = 16,000, V = 8,000: every second tick of
// the halved clock).
double mcx314_pulse_hz(const RackCard& card) {
    return static_cast<double>(mcx314_in(card).clock_hz) / 4;
}

// Returns the highest change of the pulse rate: A = 8,000 at multiple 500, 8,000 * 125 * 500 pulses/s2.
double mcx314_accel_hz_s(const RackCard&) {
    return 8000.0 * 125 * 500;
}

// Returns the highest count rate, counts/s: the inputs are sampled at every second clock; shorter states are missed.
double mcx314_encoder_hz(const RackCard& card) {
    return static_cast<double>(mcx314_in(card).clock_hz) / 2;
}

void* mcx314_of(RackCard& card) {
    return &card.settings.edit<Mcx314Settings>();
}

bool mcx314_latches(const RackCard& card) {
    return mcx314_in(card).variant == Mcx314Variant::mcx314as;
}

constexpr std::array<std::string_view, 2> mcx314_template_wires = {
    "# \"motion.xin1\" = \"X.home\"              # the home switch of X also at stop input 1",
    "# \"motion.xin2\" = \"open\"                # the encoder's index not connected"};
constexpr std::array<Lamp, 3> mcx314_lamps = {{{"alarm", "alarm", 0}, {"capture", "in3", 0}, {"compare", "out4"}}};
constexpr std::array<StopPin, 4> mcx314_stop_pins = {{
    {"emgn", StopSource::emergency_stop},
    {"alarm", StopSource::drive_alarm},
    {"lmtp", StopSource::limit_switch, 0, +1},
    {"lmtm", StopSource::limit_switch, 0, -1},
}};
constexpr std::array<std::string_view, 4> mcx314_stops = {"in0", "in1", "in2", "in3"};

std::unique_ptr<FunctionLibrary> mcx314_library(const CardBus& bus) {
    return std::make_unique<mcx314::Library>(*bus.registers, *bus.host);
}
constexpr std::string_view mcx314_axes = "XYZU";

struct ValueCommand {
    std::string_view name;
    const CommandInfo& command;
    std::string_view meaning;
};

constexpr ValueCommand mcx314_values[] = {
    {"LP", command_named(mcx314::map::commands, "READ_LP"), "pulses sent"},
    {"EP", command_named(mcx314::map::commands, "READ_EP"), "encoder counts"},
    {"CV", command_named(mcx314::map::commands, "READ_CV"), "present speed, units of V"},
    {"CA", command_named(mcx314::map::commands, "READ_CA"), "present acceleration, units of A"},
};

bool is_read_by_the_host(const RegisterInfo& reg) {
    return reg.access != Access::write && reg.bank.empty();
}

/// Reads all RR registers, and LP, EP, CV, CA of each axis. Writes WR0 only, with NOP (to select the axis) and read
/// commands. These change no motion, only RR6, RR7 and the selected axis; the card must not be used by others
/// meanwhile. `clearing`: also reads RR3, which clears its flags and releases the interrupt line.
Result<RegisterView> mcx314_view(const CardBus& bus, bool clearing) {
    RegisterPort& port = *bus.registers;
    RegisterView view;
    const std::span<const RegisterInfo> registers = mcx314::card_map().registers;
    for (const RegisterInfo& reg : registers)
        if (is_read_by_the_host(reg) && !reg.per_axis) view.registers.push_back({&reg, "", port.read(reg.offset)});
    for (unsigned axis = 0; axis < mcx314_axes.size(); ++axis) {
        const std::string letter(1, mcx314_axes[axis]);
        const unsigned chosen = 0x0100u << axis;
        port.write(mcx314::reg::WR0, static_cast<std::uint16_t>(chosen | mcx314::cmd::NOP));
        for (const RegisterInfo& reg : registers)
            if (is_read_by_the_host(reg) && reg.per_axis && (clearing || reg.access != Access::read_clears))
                view.registers.push_back({&reg, letter, port.read(reg.offset)});
        for (const auto& [name, command, meaning] : mcx314_values) {
            port.write(mcx314::reg::WR0, static_cast<std::uint16_t>(chosen | command.code));
            const std::uint32_t low = port.read(mcx314::reg::RR6);
            const std::uint32_t high = command.data_bytes > 2 ? port.read(mcx314::reg::RR7) : 0;
            view.values.push_back({name, letter, static_cast<std::int32_t>(high << 16 | low), meaning});
        }
    }
    return view;
}

void clear_general_outputs(Rack& rack, const StopReaction&) {
    for (const auto& card : rack.cards())
        if (auto* chip = dynamic_cast<mcx314::Chip*>(card->registers()); chip != nullptr)
            mcx314::Chip::GeneralOutputs::clear(*chip);
}

constexpr std::array<StopReaction, 5> mcx314_reactions = {{
    {"mcx314", only_emergency_stop, StopCategory::category_0, StopBy::card,
     "the chip ends all pulses at once, at its input emgn", milliseconds(1)},
    {"mcx314", stop_bits({StopSource::limit_switch}), StopCategory::category_2, StopBy::card,
     "the chip decelerates the axis moving towards the switch, and with it the path; the drive ends with the current "
     "segment; at standstill: motion is blocked",
     milliseconds(1), true},
    {"mcx314",
     stop_bits({StopSource::stop_command, StopSource::drive_alarm, StopSource::watchdog, StopSource::following_error}),
     StopCategory::category_2, StopBy::drive, "all axes decelerate along their path and hold their positions",
     stop_slice, true},
    {"mcx314 outputs", only_emergency_stop, StopCategory::category_0, StopBy::latch,
     "the general outputs OUT0 to OUT7 go low: servo-on and open brakes end", milliseconds(2), false,
     clear_general_outputs},
    {"mcx314 outputs", but_emergency_stop, StopCategory::category_2, StopBy::card,
     "the general outputs keep their levels, because the ramp and holding a position need servo-on and open brakes",
     Duration{}},
}};

}  // namespace

constinit const CardPlugin mcx314_plugin = {.type = {.name = "mcx314",
                                                     .doc = "four-axis pulse chip with interpolation",
                                                     .channels = "xyzu",
                                                     .channel_pins = mcx314_channel_pins,
                                                     .chip_pins = mcx314_chip_pins,
                                                     .default_wires = mcx314_wires,
                                                     .estop_pin = "emgn",
                                                     .settings = mcx314_settings,
                                                     .settings_of = mcx314_of,
                                                     .max_pulse_hz = mcx314_pulse_hz,
                                                     .max_accel_hz_s = mcx314_accel_hz_s,
                                                     .max_encoder_hz = mcx314_encoder_hz,
                                                     .home_pins = mcx314_stops,
                                                     .index_pins = mcx314_stops,
                                                     .lamps = mcx314_lamps,
                                                     .template_wires = mcx314_template_wires,
                                                     .probe_pin = "in3",
                                                     .latches = mcx314_latches,
                                                     .latches_with = "variant = \"mcx314as\"",
                                                     .stop_pins = mcx314_stop_pins},
                                            .map = mcx314::card_map,
                                            .make = make_mcx314,
                                            .view = mcx314_view,
                                            .library = mcx314_library,
                                            .stop_reactions = mcx314_reactions};

}  // namespace motionrack::rack
