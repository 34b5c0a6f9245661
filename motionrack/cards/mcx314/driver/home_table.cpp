// The homing tables. A failure (see HomeFault) leads from every state to STOPPING_WAIT, and from there to FAILED.
#include <motionrack/cards/mcx314/driver/home_table.hpp>

namespace motionrack::mcx314 {

namespace {

using enum HomingTransition;
using Exits = std::array<HomeExit, 3>;

// ---- states that the types share

constexpr HomeState drive(std::string_view name, std::string_view meaning, std::string_view next,
                          SearchDirection search_direction, HomingSpeed pace, HomingStopInput until) {
    return {name, meaning, HomingAction::drive, {{{done, next}}}, search_direction, pace, until};
}
constexpr HomeState wait(std::string_view name, std::string_view meaning, const HomeState& of, Exits exits) {
    return {name, meaning, HomingAction::wait_end, exits, of.search_direction, of.pace, of.until};
}
constexpr HomeState wait_steady(std::string_view name, std::string_view meaning, Exits exits) {
    return {name, meaning, HomingAction::wait_steady, exits};
}

constexpr HomeState check_start = {"CHECK_START",
                                   "checks the inputs at the start position",
                                   HomingAction::poll,
                                   {{{off, "SEARCH_START"}, {on, "BACK_START"}, {limit, "RETURN_START"}}}};
constexpr HomeState search_start = drive("SEARCH_START", "towards the switch at V", "SEARCH_WAIT",
                                         SearchDirection::towards, HomingSpeed::fast, HomingStopInput::on);
constexpr HomeState search_wait(Exits exits) {
    return wait("SEARCH_WAIT", "the input slows the drive to SV and ends it", search_start, exits);
}
constexpr HomeState rest_start = {
    "REST_START", "stands, past the switch's edge or at a limit", HomingAction::settle, {{{done, "REST_WAIT"}}}};
constexpr HomeState rest_wait =
    wait_steady("REST_WAIT", "waits until contacts settle", {{{on, "BACK_START"}, {off, "RETURN_START"}}});
constexpr HomeState return_start =
    drive("RETURN_START", "away from the limit, or back over a short switch, to the switch", "RETURN_WAIT",
          SearchDirection::away, HomingSpeed::back, HomingStopInput::on);
constexpr HomeState return_wait =
    wait("RETURN_WAIT", "the input ends the drive", return_start, {{{done, "BACK_START"}}});
constexpr HomeState back_start = drive("BACK_START", "away, off the switch, at constant speed", "BACK_WAIT",
                                       SearchDirection::away, HomingSpeed::back, HomingStopInput::off);
constexpr HomeState back_wait =
    wait("BACK_WAIT", "the input's release ends the drive", back_start, {{{done, "CLEAR_START"}}});
constexpr HomeState clear_start = drive("CLEAR_START", "on, by the backoff, so that contacts stay open", "CLEAR_WAIT",
                                        SearchDirection::away, HomingSpeed::fast, HomingStopInput::distance);
constexpr HomeState clear_wait =
    wait("CLEAR_WAIT", "the pulses end the drive", clear_start, {{{done, "SETTLE_START"}, {limit, "SETTLE_START"}}});
constexpr HomeState settle_start = {
    "SETTLE_START", "stands, beside the switch", HomingAction::settle, {{{done, "SETTLE_WAIT"}}}};
constexpr HomeState settle_wait(std::string_view next) {
    return wait_steady("SETTLE_WAIT", "waits until contacts settle", {{{off, next}, {on, "BACK_START"}}});
}
/// If the search did not begin before the switch, it is repeated for the index behind the switch.
constexpr HomeState settle_wait_indexed =
    wait_steady("SETTLE_WAIT", "waits until contacts settle",
                {{{unseen, "SEARCH_START"}, {off, "SLOW_START"}, {on, "BACK_START"}}});
constexpr HomeState slow_start = drive("SLOW_START", "towards the switch, slowly", "SLOW_WAIT",
                                       SearchDirection::towards, HomingSpeed::slow, HomingStopInput::on);
constexpr HomeState slow_wait(std::string_view next) {
    return wait("SLOW_WAIT", "the input ends the drive at once", slow_start, {{{done, next}}});
}
constexpr HomeState index_start = drive("INDEX_START", "on towards the encoder's index, slowly", "INDEX_WAIT",
                                        SearchDirection::towards, HomingSpeed::slow, HomingStopInput::index);
constexpr HomeState index_wait(std::string_view next) {
    return wait("INDEX_WAIT", "the index ends the drive at once", index_start, {{{done, next}}});
}
constexpr HomeState zero_start = {
    "ZERO_START", "LP and EP are given the home position", HomingAction::zero, {{{done, "HOMED"}}}};
constexpr HomeState stopping_wait = {
    "STOPPING_WAIT", "decelerates after a failure or stop()", HomingAction::wait_stop, {{{done, "FAILED"}}}};
constexpr HomeState homed = {"HOMED", "stands at home, the position is valid", HomingAction::end};
constexpr HomeState failed = {"FAILED", "stands, the position is not valid", HomingAction::end};

// ---- the types

// clang-format off
constexpr std::array type1 = {
    check_start, search_start, search_wait({{{done, "ZERO_START"}, {early, "REST_START"}, {limit, "REST_START"}}}),
    rest_start, rest_wait, return_start, return_wait, back_start, back_wait, clear_start, clear_wait,
    settle_start, settle_wait("SEARCH_START"), zero_start, stopping_wait, homed, failed};
constexpr std::array type2 = {
    check_start, search_start, search_wait({{{done, "REST_START"}, {limit, "REST_START"}}}),
    rest_start, rest_wait, return_start, return_wait, back_start, back_wait, clear_start, clear_wait,
    settle_start, settle_wait("SLOW_START"), slow_start, slow_wait("ZERO_START"), zero_start, stopping_wait, homed,
    failed};
constexpr std::array type3 = {
    check_start, search_start, search_wait({{{done, "INDEX_START"}, {early, "REST_START"}, {limit, "REST_START"}}}),
    rest_start, rest_wait, return_start, return_wait, back_start, back_wait, clear_start, clear_wait,
    settle_start, settle_wait("SEARCH_START"), index_start, index_wait("ZERO_START"), zero_start, stopping_wait, homed,
    failed};
constexpr std::array type4 = {
    check_start, search_start, search_wait({{{done, "REST_START"}, {limit, "REST_START"}}}),
    rest_start, rest_wait, return_start, return_wait, back_start, back_wait, clear_start, clear_wait,
    settle_start, settle_wait("SLOW_START"), slow_start, slow_wait("INDEX_START"), index_start,
    index_wait("ZERO_START"), zero_start, stopping_wait, homed, failed};
constexpr std::array type5 = {
    check_start, search_start, search_wait({{{done, "INDEX_START"}, {limit, "REST_START"}}}), index_start,
    index_wait("REST_START"), rest_start, rest_wait, return_start, return_wait, back_start, back_wait, clear_start,
    clear_wait, settle_start, settle_wait_indexed, slow_start, slow_wait("ZERO_START"), zero_start, stopping_wait,
    homed, failed};
// clang-format on

// ---- the same as declared state machines

constexpr std::string_view when(const HomeState& state, HomingTransition cause) {
    switch (cause) {
        case done:
            break;
        case on:
            return "the home input is active";
        case off:
            return "the home input is not active";
        case limit:
            return "the limit switch in the way is active";
        case early:
            return "the switch came before V was reached (once)";
        case unseen:
            return "the home input is not active, the index not seen yet";
    }
    switch (state.does) {
        case HomingAction::wait_end:
            return state.until == HomingStopInput::distance ? "the pulses are out" : "the input ended the drive";
        case HomingAction::wait_stop:
            return "the axis stands";
        default:
            return "at once";
    }
}

template <const auto& table>
struct Declared {
    static constexpr std::size_t count = table.size();
    static constexpr std::size_t exits() {
        std::size_t n = 0;
        for (const HomeState& state : table) {
            for (const HomeExit& exit : state.exits) n += exit.to.empty() ? 0 : 1;
            if (state.does != HomingAction::end && state.does != HomingAction::wait_stop) ++n;
        }
        return n;
    }
    static constexpr auto states = [] {
        std::array<StateInfo, count> out{};
        for (std::size_t i = 0; i < count; ++i)
            out[i] = {table[i].name, table[i].meaning, table[i].does == HomingAction::end};
        return out;
    }();
    static constexpr auto transitions = [] {
        std::array<TransitionInfo, exits()> out{};
        std::size_t n = 0;
        for (const HomeState& state : table) {
            for (const HomeExit& exit : state.exits)
                if (!exit.to.empty()) out[n++] = {state.name, exit.to, when(state, exit.cause)};
            if (state.does != HomingAction::end && state.does != HomingAction::wait_stop)
                out[n++] = {state.name, "STOPPING_WAIT", "a failure, or stop()"};
        }
        return out;
    }();
};

constexpr std::array<HomeTable, 5> tables = {{
    {type1, {"HomeType1", "decelerating stop at the switch", Declared<type1>::states, Declared<type1>::transitions}},
    {type2,
     {"HomeType2", "stop, back at constant speed, slowly to the switch", Declared<type2>::states,
      Declared<type2>::transitions}},
    {type3,
     {"HomeType3", "slow to SV at the switch, stop at the index", Declared<type3>::states,
      Declared<type3>::transitions}},
    {type4,
     {"HomeToIndex", "HomeType2, then slowly to the index", Declared<type4>::states, Declared<type4>::transitions}},
    {type5,
     {"HomeType4", "stop, slowly to the index, back at constant speed, slowly to the switch", Declared<type5>::states,
      Declared<type5>::transitions}},
}};
static_assert(declared<machine_flaw(tables[0].machine)>());
static_assert(declared<machine_flaw(tables[1].machine)>());
static_assert(declared<machine_flaw(tables[2].machine)>());
static_assert(declared<machine_flaw(tables[3].machine)>());
static_assert(declared<machine_flaw(tables[4].machine)>());

}  // namespace

const HomeTable& home_table(int type) {
    return tables[static_cast<std::size_t>(type - 1)];
}

}  // namespace motionrack::mcx314
