// The tables of orders and queries.
#include <motionrack/panel/tables.hpp>

#include <algorithm>
#include <array>

namespace motionrack::panel {

namespace {

using authority::Role;

constexpr double far = 1e6, longest_text = 8 << 20;

constexpr FieldRow number(std::string_view name, double least, double greatest, std::string_view unit, std::string_view text, bool required = true) {
    return {name, FieldType::number, required, least, greatest, unit, {}, text};
}
constexpr FieldRow integer(std::string_view name, double least, double greatest, std::string_view text, bool required = true) {
    return {name, FieldType::integer, required, least, greatest, {}, {}, text};
}
constexpr FieldRow text(std::string_view name, double longest, std::string_view about, bool required = true) {
    return {name, FieldType::text, required, 0, longest, {}, {}, about};
}
constexpr FieldRow choice(std::string_view name, std::string_view words, std::string_view about, bool required = true) {
    return {name, FieldType::choice, required, 0, 0, {}, words, about};
}
constexpr FieldRow flag(std::string_view name, std::string_view about, bool required = true) { return {name, FieldType::flag, required, 0, 0, {}, {}, about}; }
constexpr FieldRow texts(std::string_view name, double most, std::string_view about, bool required = true) {
    return {name, FieldType::texts, required, 0, most, {}, {}, about};
}

constexpr FieldRow axis = text("axis", 1, "letter of an axis");
constexpr FieldRow card_name = text("card", 32, "name of a card of the rack");
constexpr FieldRow speed = number("speed", 0, far, "mm/s or degrees/s", "above 0, at most the axis' greatest");

constexpr std::array take_control_fields = {flag("force", "take it from another holder; only while the machine stands", false)};
constexpr std::array enable_fields = {flag("on", "false: what moves is stopped first")};
constexpr std::array home_fields = {text("axes", 6, "letters; without it all that have a home switch", false)};
constexpr std::array jog_fields = {axis, number("speed", -far, far, "mm/s or degrees/s", "the sign is the direction; 0 lets go")};
constexpr std::array jog_by_fields = {axis, number("distance", -far, far, "mm or degrees", "signed"), speed};
constexpr std::array declare_fields = {axis, number("position", -far, far, "mm or degrees", "where the axis stands, machine coordinates")};
constexpr std::array work_zero_fields = {axis, number("value", -far, far, "mm or degrees", "what the present place is called in work coordinates (G10 L20)")};
constexpr std::array begin_fields = {text("name", 200, "of the program, for people"), text("text", longest_text, "the program, G-code")};
constexpr std::array line_fields = {text("text", 1024, "one line of G-code")};
constexpr std::array override_fields = {number("feed", 0, 2, "", "part of the programmed feed; below 0.01 it is 0.01", false),
                                        number("rapid", 0, 1, "", "part of the rapid speed; below 0.01 it is 0.01", false)};
constexpr std::array step_fields = {flag("on", "pause after each line")};
constexpr std::array acknowledge_fields = {integer("alarm", 1, 9e15, "its number")};
constexpr std::array clock_fields = {choice("mode", "real|free|paused", "beside the computer's time, as fast as it can, or not at all"),
                                     number("factor", 0.001, 1000, "", "seconds of the rack for a second; mode real", false)};
constexpr std::array step_clock_fields = {number("seconds", 1e-10, 3600, "s", "of the rack's time")};
constexpr std::array wire_fields = {text("name", 80, "CARD.PIN, NAME.END or estop"),
                                    FieldRow{"value", FieldType::number, true, -100, 4294967295.0, "V on analog pins", {}, "0 or 1; null releases it", true}};
constexpr std::array fault_fields = {text("target", 32, "an axis, a stage, a belt, a table or a card"),
                                     text("fault", 80, "NAME or NAME=VALUE; NAME=0 mends it")};
constexpr std::array estop_fields = {flag("pressed", "the simulated emergency stop button")};
constexpr std::array write_fields = {card_name, integer("bits", 8, 32, "width of the access: 8, 16 or 32"), integer("address", 0, 4294967295.0, "on the host's bus"),
                                     integer("value", 0, 4294967295.0, "what is written")};
constexpr std::array read_fields = {card_name, integer("bits", 8, 32, "width of the access: 8, 16 or 32"), integer("address", 0, 4294967295.0, "on the host's bus")};
constexpr std::array invite_fields = {choice("role", "observe|operate|maintain", "what the code lets in to")};
constexpr std::array unpair_fields = {text("user", 64, "whose tokens are void from now on")};

constexpr std::array order_rows = {
    AskRow{"take_control", Role::operate, false, take_control_fields, "Takes the control lease, which ends 10 s after the last sign of its session.", "", false, false},
    AskRow{"release_control", Role::operate, false, {}, "Gives the control lease back.", "", false, false},
    AskRow{"keep_control", Role::operate, false, {}, "Renews the control lease.", "", false, true},
    AskRow{"stop", Role::nobody, false, {}, "Decelerates whatever moves, and forgets programs and lines. Never refused.", "", false, false},
    AskRow{"enable", Role::operate, true, enable_fields, "Enables or disables the machine.", "", false, false},
    AskRow{"home", Role::operate, true, home_fields, "Searches home.", "", false, false},
    AskRow{"jog", Role::operate, true, jog_fields, "Jogs for as long as it is asked again within 250 ms.", "", false, false},
    AskRow{"jog_by", Role::operate, true, jog_by_fields, "Jogs by a distance.", "", false, false},
    AskRow{"jog_stop", Role::operate, true, {}, "Ends all jogs; a program goes on.", "", false, false},
    AskRow{"declare_position", Role::operate, true, declare_fields, "Says where an axis stands; its position is trusted then.", "", false, false},
    AskRow{"set_work_zero", Role::operate, true, work_zero_fields, "Touches off: moves the zero of the active work coordinates.", "", false, false},
    AskRow{"begin", Role::operate, true, begin_fields, "Checks a program whole and begins it.", "", false, false},
    AskRow{"line", Role::operate, true, line_fields, "Drives one line of G-code, behind those that are there.", "", false, false},
    AskRow{"hold", Role::operate, false, {}, "Decelerates along the path; resume goes on.", "", false, false},
    AskRow{"resume", Role::operate, true, {}, "Goes on after a hold, M0 or a single step.", "", false, false},
    AskRow{"reset", Role::operate, true, {}, "Ends an error stop; programs and modes are forgotten, work zero and positions stay.", "", false, false},
    AskRow{"set_overrides", Role::operate, true, override_fields, "Changes the speed of programs, at once.", "feed, rapid", false, false},
    AskRow{"set_single_step", Role::operate, true, step_fields, "Pauses after each line, or no longer.", "", false, false},
    AskRow{"acknowledge", Role::operate, false, acknowledge_fields, "Says that an alarm was seen.", "", false, false},
    AskRow{"set_clock", Role::maintain, true, clock_fields, "Changes how fast the rack's time goes.", "", false, false},
    AskRow{"step_clock", Role::maintain, true, step_clock_fields, "Lets so much time go by while the clock is paused.", "", false, false},
    AskRow{"set_wire", Role::maintain, true, wire_fields, "Drives a wire by hand until it is released.", "", false, false},
    AskRow{"inject_fault", Role::maintain, true, fault_fields, "Breaks something on purpose, or mends it.", "", false, false},
    AskRow{"press_estop", Role::operate, false, estop_fields, "Presses or releases the simulated emergency stop.", "", false, false},
    AskRow{"write_register", Role::maintain, true, write_fields, "Writes to a card through its bus, while the machine stands.", "", false, false},
    AskRow{"read_register", Role::maintain, true, read_fields, "Reads from a card through its bus, with all effects that reading has, while the machine stands.", "value", false, false},
    AskRow{"invite", Role::maintain, false, invite_fields, "Makes a code with which somebody can be paired.", "code", true, false},
    AskRow{"unpair", Role::maintain, false, unpair_fields, "Ends a user's tokens.", "", true, false},
};

constexpr std::array query_rows = {
    AskRow{"status", Role::observe, false, {}, "The machine at this moment.", "status", false, false},
    AskRow{"channels", Role::observe, false, {}, "All channels that can be looked at.", "channels: name, unit, text", false, false},
    AskRow{"users", Role::maintain, false, {}, "Who is paired.", "users", true, false},
};

}  // namespace

std::span<const AskRow> orders() { return order_rows; }
std::span<const AskRow> queries() { return query_rows; }

const AskRow* find_row(std::string_view name) {
    for (const std::span<const AskRow> table : {orders(), queries()}) {
        const auto found = std::find_if(table.begin(), table.end(), [&](const AskRow& row) { return row.name == name; });
        if (found != table.end()) return &*found;
    }
    return nullptr;
}

}  // namespace motionrack::panel
