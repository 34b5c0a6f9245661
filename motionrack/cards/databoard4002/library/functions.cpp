// The functions: a command of the card each, then status and events, complete moves and the slope.
#include <fmt/format.h>

#include <array>
#include <deque>
#include <motionrack/cards/databoard4002/driver/slope.hpp>
#include <motionrack/cards/databoard4002/library/calls.hpp>
#include <string>

namespace motionrack::databoard4002::functions {

namespace {

constexpr std::string_view commands = "Commands", events = "Status and events", moves = "Complete moves",
                           slopes = "Slope";
constexpr std::string_view counts = "counts";

// ---- arguments

constexpr ArgumentInfo number(std::string_view name, std::int64_t min, std::int64_t max, std::string_view unit,
                              std::string_view meaning, std::int64_t start) {
    return {name, min, max, unit, meaning, start};
}
constexpr ArgumentInfo counts_of(std::string_view meaning, std::int64_t min = map::min_24) {
    return number("counts", min, map::max_24, counts, meaning, 0);
}
constexpr ArgumentInfo time_out = number("milliseconds", 1, 600'000, "ms", "then Q ends the move", 10'000);
constexpr std::array event_bits = {ValueInfo{event::POSITION, "position reached"}, ValueInfo{event::ZERO, "zero pulse"},
                                   ValueInfo{event::REF, "reference"}, ValueInfo{event::STOP, "a stop became active"}};
constexpr std::array marks = {ValueInfo{event::ZERO, "zero pulse"}, ValueInfo{event::REF, "reference"},
                              ValueInfo{event::ZERO | event::REF, "both at once"}};

constexpr std::array deviation_data = {counts_of("deviation that lock allows", 0)};
constexpr std::array number_data = {counts_of("from the position at the next G")};
constexpr std::array target_data = {counts_of("the absolute target of the next G")};
constexpr std::array rate_data = {number("rate", 0, map::max_rate, {}, map::rate_law, 0)};
constexpr std::array enable_data = {
    ArgumentInfo{"enables", 1, event::maskable, {}, "events to report", event::POSITION, event_bits, true}};
constexpr std::array move_to_data = {counts_of("target"), time_out};
constexpr std::array move_by_data = {counts_of("way, with its direction"), time_out};
constexpr std::array find_zero_data = {
    ArgumentInfo{"marks", event::ZERO, event::ZERO | event::REF, {}, "what sets the counter to 0", event::ZERO, marks},
    number("far", map::min_24, map::max_24, counts, "where the search ends at the latest", map::max_24),
    number("rate", 1, map::max_rate, {}, map::rate_law, 1), time_out};
constexpr std::array slope_data = {
    number("top_speed", 1, 400'000, "counts/s", "speed between the ramps", 10'000),
    number("acceleration", 1, 100'000'000, "counts/s2", "of both ramps", 20'000),
    number("counts_per_1000_pulses", 1, 1'000'000, counts, "of a motor that follows FOUT", 1000),
    number("counts_per_volt", 0, 10'000'000, "counts/s", "of a motor that follows the voltage; 0: it follows FOUT", 0)};

// ---- calls

std::string names_of(std::span<const FieldInfo> fields, std::uint32_t word, const char* none) {
    std::string out;
    for (const FieldInfo& field : fields)
        if ((word & field.mask) != 0)
            out += fmt::format("{}{}: {}", out.empty() ? "" : "; ", field.name, field.meaning);
    return out.empty() ? std::string(none) : out;
}

Result<CallAnswer> status(Driver& driver, Values) {
    const std::uint8_t word = driver.status().word;
    return CallAnswer{word, fmt::format("STAT {:02X}h. {}.", word, names_of(map::stat_fields, word, "No bit is set"))};
}

Result<CallAnswer> free_events(Driver& driver, std::uint8_t enables) {
    MOTIONRACK_TRY(const Events seen, driver.enable_events(enables));
    return CallAnswer{seen.word, fmt::format("EVENT {:02X}h. {}.", seen.word,
                                             names_of(map::event_fields, seen.word, "No event had happened"))};
}

Result<CallAnswer> enable_events(Driver& driver, Values v) {
    return free_events(driver, static_cast<std::uint8_t>(v[0]));
}

Result<CallAnswer> disable_events(Driver& driver, Values) {
    return free_events(driver, 0);
}

Result<CallAnswer> reset(Driver& driver, Values) {
    driver.reset();
    return CallAnswer{{}, "The card was reset; position, rate and slope are cleared."};
}

Result<CallAnswer> stands_at(Driver& driver) {
    MOTIONRACK_TRY(const std::int64_t position, driver.position());
    return CallAnswer{position, fmt::format("The card is at {} counts.", position)};
}

Result<CallAnswer> move_to(Driver& driver, Values v) {
    MOTIONRACK_CHECK(driver.move_to(v[0], milliseconds(v[1])));
    return stands_at(driver);
}

Result<CallAnswer> move_by(Driver& driver, Values v) {
    MOTIONRACK_CHECK(driver.move_by(v[0], milliseconds(v[1])));
    return stands_at(driver);
}

Result<CallAnswer> find_zero(Driver& driver, Values v) {
    MOTIONRACK_CHECK(
        driver.find_zero(static_cast<std::uint8_t>(v[0]), v[1], static_cast<int>(v[2]), milliseconds(v[3])));
    return stands_at(driver);
}

Result<CallAnswer> design(Driver& driver, Values v) {
    SlopeDemand demand;
    demand.top_speed = static_cast<double>(v[0]);
    demand.acceleration = demand.deceleration = static_cast<double>(v[1]);
    SpeedScale scale;
    scale.counts_per_pulse = static_cast<double>(v[2]) / 1000;
    scale.counts_per_volt = static_cast<double>(v[3]);
    scale.analog = v[3] > 0;
    MOTIONRACK_TRY(const SlopeTable table, design_slope(demand, scale));
    MOTIONRACK_CHECK(driver.set_slope(table));
    return CallAnswer{{},
                      fmt::format("Written: 48 intervals up to {} counts/s. on_regulation makes the next move "
                                  "follow them.",
                                  v[0])};
}

/// Makes the row of a function that is one command of the card; `name`: the Driver's function.
LibraryRow row_of(std::string_view name, const CommandInfo& command, Call call,
                  std::span<const ArgumentInfo> arguments = {}, std::string_view returns = {}) {
    static std::deque<std::string> meanings;  // where a string stays in its place
    meanings.push_back(fmt::format("Command {}. {}.", command.name, command.meaning));
    return {{name, commands, meanings.back(), arguments, returns}, call};
}

const std::array rows = {
    row_of("athome", command_named(map::commands, "A"), give<&Driver::athome>),
    row_of("set_deviation", command_named(map::commands, "D"), set<std::int64_t, &Driver::set_deviation>,
           deviation_data),
    row_of("deviation", command_named(map::commands, "D"), ask<std::int64_t, &Driver::deviation>, {}, counts),
    row_of("go", command_named(map::commands, "G"), give<&Driver::go>),
    row_of("initialise", command_named(map::commands, "I"), give<&Driver::initialise>),
    row_of("lock", command_named(map::commands, "L"), give<&Driver::lock>),
    row_of("manual", command_named(map::commands, "M"), give<&Driver::manual>),
    row_of("set_number", command_named(map::commands, "N"), set<std::int64_t, &Driver::set_number>, number_data),
    row_of("on_regulation", command_named(map::commands, "O"), give<&Driver::on_regulation>),
    row_of("set_target", command_named(map::commands, "P"), set<std::int64_t, &Driver::set_target>, target_data),
    row_of("position", command_named(map::commands, "P"), ask<std::int64_t, &Driver::position>, {}, counts),
    row_of("quit", command_named(map::commands, "Q"), give<&Driver::quit>),
    row_of("set_rate", command_named(map::commands, "R"), set<int, &Driver::set_rate>, rate_data),
    row_of("rate", command_named(map::commands, "R"), ask<int, &Driver::rate>, {},
           "negative backwards, 0 at standstill"),
    row_of("version", command_named(map::commands, "V"), ask<int, &Driver::version>, {}, "version of its program"),
    row_of("clear_watch_out", command_named(map::commands, "W"), give<&Driver::clear_watch_out>),
    LibraryRow{{"status", events, "Reads STAT, at any time.", {}, "STAT"}, status},
    LibraryRow{{"enable_events", events, "Writes the enables (C4) and reads the EVENT word, which it frees.",
                enable_data, "EVENT"},
               enable_events},
    LibraryRow{
        {"disable_events", events, "Writes no enables (C4) and reads the EVENT word, which it frees.", {}, "EVENT"},
        disable_events},
    LibraryRow{{"reset", events, "Resets the card (C3).", {}, {}, false, true}, reset},
    LibraryRow{{"move_to", moves, "Moves to a position with the present rate, mode and slope.", move_to_data, counts,
                true, true},
               move_to},
    LibraryRow{{"move_by", moves, "Moves by a distance with the present rate, mode and slope.", move_by_data, counts,
                true, true},
               move_by},
    LibraryRow{{"find_zero", moves, "Moves slowly until a mark sets the counter to 0, and stops.", find_zero_data,
                counts, true, true},
               find_zero},
    LibraryRow{
        {"design_slope", slopes, "Writes a slope (S) for a speed and an acceleration.", slope_data, {}, false, true},
        design},
};

}  // namespace

std::span<const LibraryRow> function_rows() {
    return rows;
}

}  // namespace motionrack::databoard4002::functions
