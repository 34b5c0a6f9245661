// Table of the values that can be inspected by name.
#include <motionrack/cards/mcx314/chip/chip_values.hpp>
#include <motionrack/cards/mcx314/map.hpp>

namespace motionrack::mcx314 {

namespace {

struct InspectedValue {
    using Get = std::int64_t (*)(const ChipValues& chip, const Axis& axis, int a);
    std::string_view name;
    bool per_axis;
    Get get;
};

constexpr bool in_each = true, in_one = false;

// The state may be older than the present instant: values that change between events are computed for that instant.
constexpr InspectedValue inspected_values[] = {
    {"WR1", in_each, [](const ChipValues&, const Axis& x, int) -> std::int64_t { return x.wr1; }},
    {"WR2", in_each, [](const ChipValues&, const Axis& x, int) -> std::int64_t { return x.wr2; }},
    {"WR3", in_each, [](const ChipValues&, const Axis& x, int) -> std::int64_t { return x.wr3; }},
    {"WR4", in_one, [](const ChipValues& c, const Axis&, int) -> std::int64_t { return c.state.bus.wr4; }},
    {"WR5", in_one, [](const ChipValues& c, const Axis&, int) -> std::int64_t { return c.state.bus.wr5; }},
    {"WR6", in_one, [](const ChipValues& c, const Axis&, int) -> std::int64_t { return c.state.bus.wr6; }},
    {"WR7", in_one, [](const ChipValues& c, const Axis&, int) -> std::int64_t { return c.state.bus.wr7; }},
    {"BP1P", in_one,
     [](const ChipValues& c, const Axis&, int) -> std::int64_t { return c.state.pattern.registers[0]; }},
    {"BP1M", in_one,
     [](const ChipValues& c, const Axis&, int) -> std::int64_t { return c.state.pattern.registers[1]; }},
    {"BP2P", in_one,
     [](const ChipValues& c, const Axis&, int) -> std::int64_t { return c.state.pattern.registers[2]; }},
    {"BP2M", in_one,
     [](const ChipValues& c, const Axis&, int) -> std::int64_t { return c.state.pattern.registers[3]; }},
    {"BP3P", in_one,
     [](const ChipValues& c, const Axis&, int) -> std::int64_t { return c.state.pattern.registers[4]; }},
    {"BP3M", in_one,
     [](const ChipValues& c, const Axis&, int) -> std::int64_t { return c.state.pattern.registers[5]; }},
    {"RR0", in_one, [](const ChipValues& c, const Axis&, int) -> std::int64_t { return c.status.main_status(); }},
    {"RR1", in_each, [](const ChipValues& c, const Axis&, int a) -> std::int64_t { return c.status.status1(a); }},
    {"RR2", in_each, [](const ChipValues& c, const Axis&, int a) -> std::int64_t { return c.status.status2(a); }},
    {"RR3", in_each, [](const ChipValues&, const Axis& x, int) -> std::int64_t { return x.flags; }},
    {"RR4", in_one, [](const ChipValues& c, const Axis&, int) -> std::int64_t { return c.status.value(reg::RR4); }},
    {"RR5", in_one, [](const ChipValues& c, const Axis&, int) -> std::int64_t { return c.status.value(reg::RR5); }},
    {"RR6", in_one, [](const ChipValues& c, const Axis&, int) -> std::int64_t { return c.state.bus.rr6; }},
    {"RR7", in_one, [](const ChipValues& c, const Axis&, int) -> std::int64_t { return c.state.bus.rr7; }},
    {"R", in_each, [](const ChipValues&, const Axis& x, int) -> std::int64_t { return x.range; }},
    {"K", in_each, [](const ChipValues&, const Axis& x, int) -> std::int64_t { return x.jerk; }},
    {"A", in_each, [](const ChipValues&, const Axis& x, int) -> std::int64_t { return x.accel; }},
    {"D", in_each, [](const ChipValues&, const Axis& x, int) -> std::int64_t { return x.decel; }},
    {"SV", in_each, [](const ChipValues&, const Axis& x, int) -> std::int64_t { return x.start_speed; }},
    {"V", in_each, [](const ChipValues& c, const Axis&, int a) -> std::int64_t { return c.state.extension[a].v; }},
    {"P", in_each, [](const ChipValues&, const Axis& x, int) -> std::int64_t { return x.pulses; }},
    {"DP", in_each, [](const ChipValues&, const Axis& x, int) -> std::int64_t { return x.decel_point; }},
    {"C", in_each,
     [](const ChipValues& c, const Axis& x, int) -> std::int64_t { return c.drives.coordinate(x.centre); }},
    {"LP", in_each, [](const ChipValues& c, const Axis&, int a) -> std::int64_t { return c.lp(a); }},
    {"EP", in_each, [](const ChipValues& c, const Axis&, int a) -> std::int64_t { return c.ep(a); }},
    {"COMP_PLUS", in_each, [](const ChipValues&, const Axis& x, int) -> std::int64_t { return x.comp_plus; }},
    {"COMP_MINUS", in_each, [](const ChipValues&, const Axis& x, int) -> std::int64_t { return x.comp_minus; }},
    {"AO", in_each, [](const ChipValues&, const Axis& x, int) -> std::int64_t { return x.offset; }},
    {"CV", in_each,
     [](const ChipValues&, const Axis& x,
        int) -> std::int64_t { return x.gen.drive == Drive::idle ? 0 : x.gen.speed; }},
    {"CA", in_each, [](const ChipValues&, const Axis& x, int) -> std::int64_t { return x.gen.rate; }},
    // MCX314As; 0 on an original, where L acts as K.
    {"L", in_each, [](const ChipValues&, const Axis& x, int) -> std::int64_t { return x.decel_jerk; }},
    {"EM6", in_each, [](const ChipValues& c, const Axis&, int a) -> std::int64_t { return c.state.extension[a].em6; }},
    {"EM7", in_each, [](const ChipValues& c, const Axis&, int a) -> std::int64_t { return c.state.extension[a].em7; }},
    {"SM6", in_each, [](const ChipValues& c, const Axis&, int a) -> std::int64_t { return c.state.extension[a].sm6; }},
    {"SM7", in_each, [](const ChipValues& c, const Axis&, int a) -> std::int64_t { return c.state.extension[a].sm7; }},
    {"HV", in_each, [](const ChipValues& c, const Axis&, int a) -> std::int64_t { return c.state.extension[a].hv; }},
    {"BR", in_each,
     [](const ChipValues& c, const Axis&, int a) -> std::int64_t { return c.state.extension[a].buffer; }},
    // Indices in the tables of map.hpp's state machines.
    {"DRIVE_STATE", in_each,
     [](const ChipValues& c, const Axis&, int a) -> std::int64_t { return c.machines.drive_state(a); }},
    {"EXPP_STATE", in_each,
     [](const ChipValues& c, const Axis&, int a) -> std::int64_t { return c.machines.wire_state(a, 0); }},
    {"EXPM_STATE", in_each,
     [](const ChipValues& c, const Axis&, int a) -> std::int64_t { return c.machines.wire_state(a, 1); }},
    {"QUEUE_STATE", in_one,
     [](const ChipValues& c, const Axis&, int) -> std::int64_t { return c.machines.queue_state(); }},
    {"PATTERN_STATE", in_one,
     [](const ChipValues& c, const Axis&, int) -> std::int64_t { return c.machines.pattern_state(); }},
    {"STACK_STATE", in_one,
     [](const ChipValues& c, const Axis&, int) -> std::int64_t { return c.machines.stack_state(); }},
    {"STEP_STATE", in_one,
     [](const ChipValues& c, const Axis&, int) -> std::int64_t { return c.machines.step_state(); }},
    {"HOME_STATE", in_each,
     [](const ChipValues& c, const Axis&, int a) -> std::int64_t { return c.machines.home_state(a); }},
    {"FILTER_STATE", in_each,
     [](const ChipValues& c, const Axis&, int a) -> std::int64_t { return c.machines.filter_state(a); }},
    {"CLEAR_STATE", in_each,
     [](const ChipValues& c, const Axis&, int a) -> std::int64_t { return c.machines.clear_state(a); }},
    {"ACTION_STATE", in_each,
     [](const ChipValues& c, const Axis&, int a) -> std::int64_t { return c.machines.action_state(a); }},
};

}  // namespace

std::optional<std::int64_t> ChipValues::inspect(std::string_view name, int a) const {
    for (const InspectedValue& row : inspected_values)
        if (row.name == name) return row.get(*this, state.axis[a], a);
    return std::nullopt;
}

std::vector<std::string_view> ChipValues::names(bool per_axis) {
    std::vector<std::string_view> out;
    for (const InspectedValue& row : inspected_values)
        if (row.per_axis == per_axis) out.push_back(row.name);
    return out;
}

std::int32_t ChipValues::lp(int a) const {
    // Between events the generators stay behind: pulses since then are counted but not yet executed.
    const Axis& own = state.axis[a];
    return stepped(own, own.lp, law.count_at(a, kernel.now()) - own.count);
}

std::int32_t ChipValues::ep(int a) const {
    return encoders.position(state.axis[a], a);
}

}  // namespace motionrack::mcx314
