// Tables of commands and queries.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <motionrack/panel/operation_specs.hpp>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::panel {

namespace {

using auth::Role;

constexpr double far = 1e6, max_text_bytes = 8 << 20;

constexpr FieldSpec number(std::string_view name, double min, double max, std::string_view unit, std::string_view text,
                           bool required = true) {
    return {name, ParameterType::number, required, min, max, unit, {}, text};
}
constexpr FieldSpec integer(std::string_view name, double min, double max, std::string_view text,
                            bool required = true) {
    return {name, ParameterType::integer, required, min, max, {}, {}, text};
}
constexpr FieldSpec text(std::string_view name, double max_bytes, std::string_view about, bool required = true) {
    return {name, ParameterType::text, required, 0, max_bytes, {}, {}, about};
}
constexpr FieldSpec choice(std::string_view name, std::string_view words, std::string_view about,
                           bool required = true) {
    return {name, ParameterType::choice, required, 0, 0, {}, words, about};
}
constexpr FieldSpec flag(std::string_view name, std::string_view about, bool required = true) {
    return {name, ParameterType::flag, required, 0, 0, {}, {}, about};
}
constexpr FieldSpec texts(std::string_view name, double max_count, std::string_view about, bool required = true) {
    return {name, ParameterType::texts, required, 0, max_count, {}, {}, about};
}

constexpr FieldSpec numbers(std::string_view name, double max_count, std::string_view about, bool required = true) {
    return {name, ParameterType::numbers, required, 0, max_count, {}, {}, about};
}

constexpr FieldSpec one_axis = text("axis", 1, "letter of an axis");
constexpr FieldSpec card_name = text("card", 32, "name of a card of the rack");
constexpr FieldSpec sequence = integer(
    "sequence", 1, 9e15, "rises with each jog and jog_stop of a connection or token; an older one is refused", false);
constexpr FieldSpec speed = number("speed", 0, far, "mm/s or degrees/s", "above 0, at most the axis' maximum");

constexpr std::array take_control_fields = {flag("force", "takes it from another holder; only at standstill", false)};
constexpr std::array enable_fields = {flag("on", "false: moving axes stop first"),
                                      text("axes", 6, "axis letters; default: all", false)};
constexpr std::array home_fields = {text("axes", 6, "axis letters; default: all with a home switch", false)};
constexpr std::array jog_fields = {
    one_axis, number("speed", -far, far, "mm/s or degrees/s", "the sign is the direction; 0 stops"), sequence,
    flag("renews", "only prolongs a jog; refused if that has ended", false)};
constexpr std::array jog_stop_fields = {sequence};
constexpr std::array jog_by_fields = {one_axis, number("distance", -far, far, "mm or degrees", "signed"), speed};
constexpr std::array set_position_fields = {
    one_axis, number("position", -far, far, "mm or degrees", "position of the axis, machine coordinates")};
constexpr std::array touch_off_fields = {
    one_axis, number("value", -far, far, "mm or degrees", "current position in work coordinates (G10 L20)")};
constexpr std::array start_program_fields = {text("name", 200, "name of the program, for display"),
                                             text("text", max_text_bytes, "the program, G-code")};
constexpr std::array mdi_fields = {text("text", 1024, "one line of G-code")};
constexpr std::array override_fields = {
    number("feed", 0, 2, "", "feed override; values below 0.01 act as 0.01", false),
    number("rapid", 0, 1, "", "rapid override; values below 0.01 act as 0.01", false)};
constexpr std::array single_block_fields = {flag("on", "pause after each line")};
constexpr std::array acknowledge_alarm_fields = {integer("alarm", 1, 9e15, "its number")};
constexpr std::array clock_fields = {
    choice("mode", "real|unthrottled|paused", "real time, without pacing, or paused"),
    number("factor", 0.001, 1000, "", "rack seconds per real second; mode real", false)};
constexpr std::array advance_clock_fields = {number("duration_s", 1e-10, 3600, "s", "of the rack's time")};
constexpr std::array wire_fields = {text("name", 80, "CARD.PIN, NAME.END or estop"),
                                    FieldSpec{"value",
                                              ParameterType::number,
                                              true,
                                              -100,
                                              4294967295.0,
                                              "V on analog pins",
                                              {},
                                              "0 or 1; null releases it",
                                              true}};
constexpr std::array fault_fields = {text("target", 32, "an axis, a stage, a belt, a table or a card"),
                                     text("fault", 80, "NAME or NAME=VALUE; NAME=0 repairs it")};
constexpr std::array estop_fields = {flag("pressed", "the simulated emergency stop button")};
constexpr std::array write_fields = {card_name, integer("bits", 8, 32, "width of the access: 8, 16 or 32"),
                                     integer("address", 0, 4294967295.0, "address on the host's bus"),
                                     integer("value", 0, 4294967295.0, "value to write")};
constexpr std::array read_fields = {card_name, integer("bits", 8, 32, "width of the access: 8, 16 or 32"),
                                    integer("address", 0, 4294967295.0, "address on the host's bus")};
constexpr std::array service_fields = {card_name, flag("on", "false: its axes stop, and the controller takes it back")};
constexpr std::array call_fields = {card_name, text("function", 40, "name of a function of its library"),
                                    numbers("arguments", 20, "as the query library declares them", false)};
constexpr std::array check_fields_ = {text("text", max_text_bytes, "the program, G-code"),
                                      text("name", 200, "for the answer", false)};
constexpr std::array arm_fields = {
    texts("channels", 16, "1 to 16 of the query channels"),
    text("trigger", 80, "one of the channels; without it the scope triggers at once", false),
    choice("edge", "rise|fall|either", "direction in which the trigger passes the level", false),
    number("level", -1e12, 1e12, "the channel's", "trigger level; default 0.5", false),
    number("period_us", 0.1, 1e6, "us", "sampling period of numeric channels (wires record every edge); default 100",
           false),
    number("length", 1e-6, 100, "s", "recorded time; default 0.1", false),
    number("pre", 0, 100, "s", "recorded time before the trigger; default 0", false),
    choice("mode", "single|run", "single: stops after a capture; run: is armed again", false)};
constexpr std::array mark_fields = {
    card_name, text("job", 1 << 20, "a marking job (TOML); optics and belt are the rack's"),
    text("drawing", max_text_bytes, "the text of the SVG or G-code file that the job names", false),
    choice("start", "now|parts", "at once, or at each part's edge at the card's start input", false)};
constexpr std::array mark_stop_fields = {card_name};
constexpr std::array start_part_fields = {text("part", 32, "a belt, a table or a stage of the rack")};
constexpr std::array name_fields = {text("name", 32, "name of a card of the rack")};
constexpr std::array workpiece_fields = {
    text("scanner", 32, "name of a scan head of the rack"),
    integer("points", 2, 100'000, "maximum number of points, approximate; 5000", false)};
constexpr std::array path_fields = {
    number("since", -1, 1e9, "s", "only motion after this instant", false),
    integer("have", 0, 9e15, "number of the plan that the client has; the answer omits this plan", false)};
constexpr std::array scope_fields = {
    integer("since", 0, 9e15, "number of a known capture: only a later one is sent", false)};
constexpr std::array event_fields = {integer("since", 0, 9e15, "number of the last known event", false),
                                     integer("limit", 1, 1000, "the newest ones; 200", false)};
constexpr std::array journal_fields = {integer("since", 0, 9e15, "number of the last known entry", false),
                                       text("kind", 32,
                                            "only these: run, job, command, stop, state, alarm, position, setting, "
                                            "audit; order: commands in older journals",
                                            false),
                                       integer("limit", 1, 10'000, "the newest ones; 100", false)};
constexpr std::array invite_fields = {choice("role", "observe|operate|maintain", "role of the code")};
constexpr std::array revoke_user_fields = {text("user", 64, "user whose tokens are revoked")};

constexpr std::array command_rows = {
    OperationSpec{"take_control", Role::operate, false, take_control_fields,
                  "Takes the control lease, which ends 10 s after the last message of its session."},
    OperationSpec{"release_control", Role::operate, false, {}, "Gives the control lease back."},
    OperationSpec{"renew_control", Role::operate, false, {}, "Renews the control lease.", "", false, true},
    OperationSpec{"stop",
                  Role::none,
                  false,
                  {},
                  "Stops all motion and lasers, and discards programs and lines; a reset ends it. It ends the control "
                  "of another user. Never refused."},
    OperationSpec{"enable", Role::operate, true, enable_fields, "Enables or disables axes."},
    OperationSpec{"home", Role::operate, true, home_fields, "Homes axes."},
    OperationSpec{"jog", Role::operate, true, jog_fields,
                  "Jogs while the request is repeated within 250 ms of real time, at most to the soft limit; ends "
                  "with its connection."},
    OperationSpec{"jog_by", Role::operate, true, jog_by_fields, "Jogs by a distance."},
    OperationSpec{"jog_stop", Role::operate, true, jog_stop_fields, "Ends all jogs; a program continues."},
    OperationSpec{"set_position", Role::operate, true, set_position_fields,
                  "Sets the position of an axis, which is valid then."},
    OperationSpec{"touch_off", Role::operate, true, touch_off_fields,
                  "Touches off: moves the zero of the active work coordinates."},
    OperationSpec{"start_program", Role::operate, true, start_program_fields,
                  "Checks the whole program and starts it."},
    OperationSpec{"mdi", Role::operate, true, mdi_fields, "Executes one line of G-code, after the queued lines."},
    OperationSpec{"hold", Role::operate, false, {}, "Feed hold: decelerates along the path until resume."},
    OperationSpec{"resume", Role::operate, true, {}, "Resumes after a feed hold, M0 or a single block."},
    OperationSpec{
        "reset",
        Role::operate,
        true,
        {},
        "Ends an error stop and moves nothing; programs and modes are discarded, work offsets and positions stay."},
    OperationSpec{"set_overrides", Role::operate, true, override_fields,
                  "Sets the feed and rapid overrides; effective at once, a higher rapid override from the next rapid "
                  "on.",
                  ""},
    OperationSpec{"set_single_block", Role::operate, true, single_block_fields,
                  "Turns the pause after each line on or off."},
    OperationSpec{"acknowledge_alarm", Role::operate, false, acknowledge_alarm_fields, "Acknowledges an alarm."},
    OperationSpec{"set_clock", Role::maintain, true, clock_fields, "Sets the rate of the rack's clock."},
    OperationSpec{"advance_clock", Role::maintain, true, advance_clock_fields,
                  "Advances the paused clock by this time."},
    OperationSpec{"set_wire", Role::maintain, true, wire_fields, "Forces a wire until it is released."},
    OperationSpec{"inject_fault", Role::maintain, true, fault_fields, "Injects a fault, or repairs it."},
    OperationSpec{"set_estop", Role::operate, false, estop_fields, "Presses or releases the simulated emergency stop."},
    OperationSpec{"write_register", Role::maintain, true, write_fields,
                  "Writes to a card through its bus, at standstill; to a card without axes at any time."},
    OperationSpec{"read_register", Role::maintain, true, read_fields,
                  "Reads from a card through its bus, with all side effects, at standstill; from a card without "
                  "axes at any time.",
                  "value"},
    OperationSpec{"service", Role::maintain, true, service_fields,
                  "Takes a card from the controller, so that its library's functions can be called, or gives it back; "
                  "its positions are not valid then. Begins at standstill; its session must keep control.",
                  "text"},
    OperationSpec{
        "call", Role::maintain, true, call_fields,
        "Calls a function of a card's library and waits until it has ended; a card of the controller must be in "
        "service.",
        "text, value (the returned number)"},
    OperationSpec{"check", Role::observe, false, check_fields_,
                  "Reads and plans a program from the current position; nothing moves.",
                  "ok, problems, lines, moves, duration_s, length_mm, min, max, axes, path"},
    OperationSpec{"scope_arm", Role::operate, false, arm_fields, "Arms the scope.", ""},
    OperationSpec{"scope_stop", Role::operate, false, {}, "Disarms the scope.", ""},
    OperationSpec{"mark", Role::operate, true, mark_fields, "Marks with a laser card of the rack while the rack runs.",
                  "commands, notes"},
    OperationSpec{"mark_stop", Role::operate, true, mark_stop_fields,
                  "Ends the marking of a laser card, and blocks further starts.", ""},
    OperationSpec{"start_part", Role::operate, true, start_part_fields,
                  "Restarts a belt, a table or a stage after a stop and its reset.", ""},
    OperationSpec{"invite", Role::maintain, false, invite_fields, "Creates a code that pairs a user.", "code", true},
    OperationSpec{"revoke_user", Role::maintain, false, revoke_user_fields, "Revokes a user's tokens.", "", true},
};

constexpr std::array query_rows = {
    OperationSpec{"status", Role::observe, false, {}, "The machine at this moment.", "status"},
    OperationSpec{"rack",
                  Role::observe,
                  false,
                  {},
                  "The parts of the rack; they do not change while it runs.",
                  "name, text, axes, cards, parts, stages, tracks, scanners, joined, wires, faults"},
    OperationSpec{"card", Role::observe, false, name_fields,
                  "Registers, fields, values and pins of a card at this moment, by peek, without side effects; of a "
                  "real card, as its service last read them.",
                  "registers, values, quantities, pins, reason (a real card shows none)"},
    OperationSpec{"slopes", Role::observe, false, name_fields,
                  "The slope table of a DataBoard 4002: speed over distance.",
                  "slopes: name, points (counts, Hz); position, rate, hz, moving"},
    OperationSpec{"library", Role::observe, false, name_fields,
                  "The functions of a card's library, with their arguments.",
                  "functions: name, group, meaning, arguments (name, min, max, unit, meaning, start, values, sum), "
                  "returns, waits, own"},
    OperationSpec{
        "frames",
        Role::observe,
        false,
        {},
        "The frames of the cards of the grating bus, and whether they agree.",
        "buses: cards with frame, age, skew, positions, agreement; stages: name, unit, position, velocity, stopped"},
    OperationSpec{"workpiece", Role::observe, false, workpiece_fields, "The marks of a scan head.",
                  "marks, field, beam, laser, marked_mm, energy_j, part"},
    OperationSpec{"channels", Role::observe, false, {}, "All channels.", "channels: name, unit, text, looks"},
    OperationSpec{"path", Role::observe, false, path_fields, "The planned path and the true path of the machine.",
                  "axes, number, planned, driven (time first), errors (commanded - actual at each)"},
    OperationSpec{"scope", Role::observe, false, scope_fields, "The scope, with its last capture.",
                  "state, channels, trigger, mode, capture"},
    OperationSpec{"events", Role::observe, false, event_fields, "Events since the start.", "events"},
    OperationSpec{"journal", Role::observe, false, journal_fields, "Events of all runs.", "journal"},
    OperationSpec{"journal_check",
                  Role::observe,
                  false,
                  {},
                  "Reads the whole journal and verifies all entries.",
                  "whole, entries, problem (the first entry that was changed or removed)"},
    OperationSpec{"program", Role::observe, false, {}, "The program that was started last.", "name, text"},
    OperationSpec{
        "homing", Role::observe, false, {}, "Report of the last homing.", "homing: the report of each axis, or null"},
    OperationSpec{"control", Role::observe, false, {}, "The holder of control.", "holder, since, holder_session"},
    OperationSpec{"users", Role::maintain, false, {}, "Lists the paired users.", "users", true},
};

}  // namespace

std::span<const OperationSpec> commands() {
    return command_rows;
}
std::span<const OperationSpec> queries() {
    return query_rows;
}

std::string unknown_operation(std::string_view kind, std::string_view name) {
    // Former names, with the present ones.
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 10> renamed = {
        {{"begin", "start_program"},
         {"line", "mdi"},
         {"declare_position", "set_position"},
         {"set_work_zero", "touch_off"},
         {"set_single_step", "set_single_block"},
         {"acknowledge", "acknowledge_alarm"},
         {"keep_control", "renew_control"},
         {"step_clock", "advance_clock"},
         {"press_estop", "set_estop"},
         {"unpair", "revoke_user"}}};
    const auto found = std::find_if(renamed.begin(), renamed.end(), [&](const auto& one) { return one.first == name; });
    if (found != renamed.end()) return fmt::format("'{}' is now '{}'. Nothing was done.", found->first, found->second);
    return fmt::format("Unknown {} {}. Nothing was done. See /api/openapi.json for the list.", kind,
                       rack::in_quotes(name));
}

const OperationSpec* find_row(std::string_view name) {
    for (const std::span<const OperationSpec> table : {commands(), queries()}) {
        const auto found =
            std::find_if(table.begin(), table.end(), [&](const OperationSpec& row) { return row.name == name; });
        if (found != table.end()) return &*found;
    }
    return nullptr;
}

}  // namespace motionrack::panel
