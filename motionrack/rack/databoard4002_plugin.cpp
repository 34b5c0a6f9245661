// Description of a DataBoard 4002 for the rack file reader, and its register view, faults and stop reactions.
#include <fmt/format.h>

#include <array>
#include <limits>
#include <motionrack/cards/databoard4002/driver/driver.hpp>
#include <motionrack/cards/databoard4002/library/library.hpp>
#include <motionrack/cards/databoard4002/map.hpp>
#include <motionrack/cards/databoard4002/trim_text.hpp>
#include <motionrack/rack/databoard4002_card.hpp>
#include <motionrack/rack/register_view.hpp>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::rack {

namespace {

namespace db = databoard4002;
using enum PinDirection;

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

constexpr std::array<std::string_view, 2> databoard4002_template_wires = {
    "# \"motion.ref\" = \"X.limit_minus\"        # the end stop is also the reference",
    "# \"motion.esr\" = \"open\"                 # a broken wire: the input is active"};
constexpr std::array<StopPin, 3> databoard4002_stop_pins = {{
    {"ems", StopSource::emergency_stop, 1},
    {"esr", StopSource::limit_switch, 1, +1},
    {"esl", StopSource::limit_switch, 1, -1},
}};
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

// Returns the highest pulse rate, pulses/s: rate 16383 of the card's firmware.
double databoard4002_pulse_hz(const RackCard&) {
    return 400'000;
}

double any_accel(const RackCard&) {
    return std::numeric_limits<double>::infinity();
}

// Returns the highest count rate, counts/s: all edges; an up or down pulse counts as one.
double databoard4002_encoder_hz(const RackCard& card) {
    const Databoard4002Settings& own = databoard4002_in(card);
    return (own.single_ended ? 50'000.0 : 100'000.0) * (own.count_mode == Databoard4002CountMode::up_down ? 1 : 4);
}

void* databoard4002_of(RackCard& card) {
    return &card.settings.edit<Databoard4002Settings>();
}

std::optional<CardFlaw> databoard4002_flaw(const RackCard& card, std::span<const RackCard> before) {
    const Databoard4002Settings& own = databoard4002_in(card);
    for (const RackCard& other : before)
        if (other.type == card.type && databoard4002_in(other).card_number == own.card_number)
            return CardFlaw{
                "card_number",
                fmt::format("Cards {} and {} are on one bus and have both the number {}; give one of them another "
                            "`card_number` (0 .. 31).",
                            other.name, card.name, own.card_number)};
    if (const auto trim = db::trim_from_text(own.trim); !trim)
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

std::unique_ptr<FunctionLibrary> databoard4002_library(const CardBus& bus) {
    return std::make_unique<db::CommandLibrary>(*bus.bytes, *bus.host, bus.select);
}
std::uint8_t databoard4002_select(const RackCard& card) {
    return static_cast<std::uint8_t>(databoard4002_in(card).card_number);
}

RegisterView view_of_status(std::uint8_t stat) {
    RegisterView view;
    for (const RegisterInfo& reg : db::card_map().registers)
        if (reg.name == "STAT") view.registers.push_back({&reg, "", stat});
    return view;
}

/// Reads STAT, and POSITION and RATE by the card's commands P and R. These change no motion and no event; an unfinished
/// sequence of argument bytes ends. Errors: machine if no card answers, or it is not Ready in time.
Result<RegisterView> databoard4002_view(const CardBus& bus, bool) {
    db::DriverSettings settings;
    settings.select = bus.select;
    db::Driver driver(*bus.bytes, *bus.host, settings);
    constexpr std::uint8_t empty_slot = 0xFF;
    const std::uint8_t stat = driver.status().word;
    if (stat == empty_slot)
        return fail(ErrorKind::machine, fmt::format("No card answers under the number {} (STAT reads FFh). Nothing was "
                                                    "changed. Check the number, its straps and its power.",
                                                    bus.select));
    MOTIONRACK_TRY(const std::int64_t position, driver.position());
    MOTIONRACK_TRY(const int rate, driver.rate());
    RegisterView view = view_of_status(stat);
    view.values = {{"POSITION", "", position, "counts"}, {"RATE", "", rate, "rate at the output, 0 at standstill"}};
    return view;
}
/// Reads STAT alone: the driver selects the card and reads STAT at any time, also within a command.
RegisterView databoard4002_view_while_waiting(const CardBus& bus) {
    db::DriverSettings settings;
    settings.select = bus.select;
    return view_of_status(db::Driver(*bus.bytes, *bus.host, settings).status().word);
}

constexpr std::array<CardFault, 5> databoard4002_faults = {{
    {"watchdog.hang", 0, 1, "", "1: the firmware hangs until the watchdog restarts it"},
    {"esl.broken", 0, 1, "", "1: the wire of the limit switch on the left is broken; 0 repairs it"},
    {"esr.broken", 0, 1, "", "1: the wire of the limit switch on the right is broken; 0 repairs it"},
    {"ems.broken", 0, 1, "", "1: the wire of the emergency stop is broken; 0 repairs it"},
    {"ref.broken", 0, 1, "", "1: the wire of the reference switch is broken; 0 repairs it"},
}};

constexpr std::array<StopReaction, 3> databoard4002_stops = {{
    {"databoard4002", only_emergency_stop, StopCategory::category_0, StopBy::card,
     "the relay disconnects the amplifier's voltage, at its input ems; the amplifier brakes the axis", milliseconds(1),
     true},
    {"databoard4002", stop_bits({StopSource::limit_switch, StopSource::watchdog}), StopCategory::category_0,
     StopBy::card, "the card ends the move by itself, without a ramp: 0 V", milliseconds(1), true},
    {"databoard4002", stop_bits({StopSource::stop_command, StopSource::drive_alarm, StopSource::following_error}),
     StopCategory::category_2, StopBy::drive, "the axis decelerates with its own acceleration and holds its position",
     stop_slice, true},
}};

}  // namespace

constinit const CardPlugin databoard4002_plugin = {
    .type = {.name = "databoard4002",
             .doc = "intelligent positioning card for one axis, which has a servo or a stepping motor; with no axis on "
                    "it an ideal motor follows its pulses, one count each",
             .channel_pins = databoard4002_channel_pins,
             .chip_pins = databoard4002_pins,
             .default_wires = databoard4002_wires,
             .estop_pin = "ems",
             .settings = databoard4002_settings,
             .settings_of = databoard4002_of,
             .max_pulse_hz = databoard4002_pulse_hz,
             .max_accel_hz_s = any_accel,
             .max_encoder_hz = databoard4002_encoder_hz,
             .max_position = 8'388'607,
             .home_pins = databoard4002_references,
             .index_pins = databoard4002_zeros,
             .select = databoard4002_select,
             .position_loop = true,
             .flaw = databoard4002_flaw,
             .template_wires = databoard4002_template_wires,
             .stop_pins = databoard4002_stop_pins},
    .map = db::card_map,
    .make = make_databoard4002,
    .view = databoard4002_view,
    .view_while_waiting = databoard4002_view_while_waiting,
    .library = databoard4002_library,
    .stop_reactions = databoard4002_stops,
    .faults = databoard4002_faults};

}  // namespace motionrack::rack
