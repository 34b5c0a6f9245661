// Everything that can be looked at by name, without disturbing the chip.
#include <algorithm>
#include <iterator>
#include <motionrack/cards/mcx314/chip/chip.hpp>
#include <motionrack/cards/mcx314/map.hpp>

namespace motionrack::mcx314 {

struct Chip::Inspected {
    using Get = std::int64_t (*)(const Chip& chip, const Axis& axis, int a);
    std::string_view name;
    bool per_axis;
    Get get;

    static std::span<const Inspected> table();
};

namespace {

constexpr bool each = true, once = false;

}  // namespace

// The generators may be behind: what changes between events is asked for as it is at present.
std::span<const Chip::Inspected> Chip::Inspected::table() {
    static constexpr Inspected rows[] = {
        {"WR1", each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.wr1; }},
        {"WR2", each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.wr2; }},
        {"WR3", each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.wr3; }},
        {"WR4", once, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.state_.wr4; }},
        {"WR5", once, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.state_.wr5; }},
        {"WR6", once, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.state_.wr6; }},
        {"WR7", once, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.state_.wr7; }},
        {"BP1P", once, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.state_.pattern.registers[0]; }},
        {"BP1M", once, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.state_.pattern.registers[1]; }},
        {"BP2P", once, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.state_.pattern.registers[2]; }},
        {"BP2M", once, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.state_.pattern.registers[3]; }},
        {"BP3P", once, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.state_.pattern.registers[4]; }},
        {"BP3M", once, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.state_.pattern.registers[5]; }},
        {"RR0", once, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.main_status(); }},
        {"RR1", each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.status1(a); }},
        {"RR2", each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.status2(a); }},
        {"RR3", each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.flags; }},
        {"RR4", once, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.peek(reg::RR4); }},
        {"RR5", once, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.peek(reg::RR5); }},
        {"RR6", once, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.state_.rr6; }},
        {"RR7", once, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.state_.rr7; }},
        {"R", each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.range; }},
        {"K", each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.jerk; }},
        {"A", each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.accel; }},
        {"D", each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.decel; }},
        {"SV", each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.start_speed; }},
        {"V", each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.state_.extension[a].v; }},
        {"P", each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.pulses; }},
        {"DP", each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.decel_point; }},
        {"C", each, [](const Chip& c, const Axis& x, int) -> std::int64_t { return c.coordinate(x.centre); }},
        {"LP", each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.lp(a); }},
        {"EP", each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.ep(a); }},
        {"COMP_PLUS", each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.comp_plus; }},
        {"COMP_MINUS", each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.comp_minus; }},
        {"AO", each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.offset; }},
        {"CV", each,
         [](const Chip&, const Axis& x, int) -> std::int64_t { return x.gen.drive == Drive::idle ? 0 : x.gen.speed; }},
        {"CA", each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.gen.rate; }},
        // Of the MCX314As; 0 in an original, L there as K.
        {"L", each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.decel_jerk; }},
        {"EM6", each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.state_.extension[a].em6; }},
        {"EM7", each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.state_.extension[a].em7; }},
        {"SM6", each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.state_.extension[a].sm6; }},
        {"SM7", each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.state_.extension[a].sm7; }},
        {"HV", each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.state_.extension[a].hv; }},
        {"BR", each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.state_.extension[a].buffer; }},
        // Places in the tables of map.hpp's state machines.
        {"DRIVE_STATE", each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.drive_state(a); }},
        {"EXPP_STATE", each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.wire_state(a, 0); }},
        {"EXPM_STATE", each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.wire_state(a, 1); }},
        {"QUEUE_STATE", once, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.queue_state(); }},
        {"PATTERN_STATE", once, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.pattern_state(); }},
        {"STACK_STATE", once, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.stack_state(); }},
        {"STEP_STATE", once, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.step_state(); }},
        {"HOME_STATE", each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.home_state(a); }},
        {"FILTER_STATE", each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.filter_state(a); }},
        {"CLEAR_STATE", each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.clear_state(a); }},
        {"ACTION_STATE", each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.action_state(a); }},
    };
    return rows;
}

std::optional<std::int64_t> Chip::inspect(std::string_view name, int a) const {
    for (const Inspected& row : Inspected::table())
        if (row.name == name) return row.get(*this, state_.axis[a], a);
    return std::nullopt;
}

std::vector<std::string_view> Chip::inspected_names(bool per_axis) {
    std::vector<std::string_view> out;
    for (const Inspected& row : Inspected::table())
        if (row.per_axis == per_axis) out.push_back(row.name);
    return out;
}

}  // namespace motionrack::mcx314
