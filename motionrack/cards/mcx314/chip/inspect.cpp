// Inspection of all values by name, without side effects on the chip.
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

constexpr bool in_each = true, in_one = false;

}  // namespace

// The generators may be behind: values that change between events are computed for the present instant.
std::span<const Chip::Inspected> Chip::Inspected::table() {
    static constexpr Inspected rows[] = {
        {"WR1", in_each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.wr1; }},
        {"WR2", in_each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.wr2; }},
        {"WR3", in_each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.wr3; }},
        {"WR4", in_one, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.state_.wr4; }},
        {"WR5", in_one, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.state_.wr5; }},
        {"WR6", in_one, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.state_.wr6; }},
        {"WR7", in_one, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.state_.wr7; }},
        {"BP1P", in_one, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.state_.pattern.registers[0]; }},
        {"BP1M", in_one, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.state_.pattern.registers[1]; }},
        {"BP2P", in_one, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.state_.pattern.registers[2]; }},
        {"BP2M", in_one, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.state_.pattern.registers[3]; }},
        {"BP3P", in_one, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.state_.pattern.registers[4]; }},
        {"BP3M", in_one, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.state_.pattern.registers[5]; }},
        {"RR0", in_one, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.main_status(); }},
        {"RR1", in_each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.status1(a); }},
        {"RR2", in_each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.status2(a); }},
        {"RR3", in_each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.flags; }},
        {"RR4", in_one, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.peek(reg::RR4); }},
        {"RR5", in_one, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.peek(reg::RR5); }},
        {"RR6", in_one, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.state_.rr6; }},
        {"RR7", in_one, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.state_.rr7; }},
        {"R", in_each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.range; }},
        {"K", in_each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.jerk; }},
        {"A", in_each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.accel; }},
        {"D", in_each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.decel; }},
        {"SV", in_each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.start_speed; }},
        {"V", in_each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.state_.extension[a].v; }},
        {"P", in_each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.pulses; }},
        {"DP", in_each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.decel_point; }},
        {"C", in_each,
         [](const Chip& c, const Axis& x, int) -> std::int64_t { return c.drives_.coordinate(x.centre); }},
        {"LP", in_each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.lp(a); }},
        {"EP", in_each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.ep(a); }},
        {"COMP_PLUS", in_each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.comp_plus; }},
        {"COMP_MINUS", in_each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.comp_minus; }},
        {"AO", in_each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.offset; }},
        {"CV", in_each,
         [](const Chip&, const Axis& x, int) -> std::int64_t { return x.gen.drive == Drive::idle ? 0 : x.gen.speed; }},
        {"CA", in_each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.gen.rate; }},
        // MCX314As; 0 on an original, where L acts as K.
        {"L", in_each, [](const Chip&, const Axis& x, int) -> std::int64_t { return x.decel_jerk; }},
        {"EM6", in_each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.state_.extension[a].em6; }},
        {"EM7", in_each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.state_.extension[a].em7; }},
        {"SM6", in_each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.state_.extension[a].sm6; }},
        {"SM7", in_each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.state_.extension[a].sm7; }},
        {"HV", in_each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.state_.extension[a].hv; }},
        {"BR", in_each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.state_.extension[a].buffer; }},
        // Indices in the tables of map.hpp's state machines.
        {"DRIVE_STATE", in_each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.drive_state(a); }},
        {"EXPP_STATE", in_each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.wire_state(a, 0); }},
        {"EXPM_STATE", in_each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.wire_state(a, 1); }},
        {"QUEUE_STATE", in_one, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.queue_state(); }},
        {"PATTERN_STATE", in_one, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.pattern_state(); }},
        {"STACK_STATE", in_one, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.stack_state(); }},
        {"STEP_STATE", in_one, [](const Chip& c, const Axis&, int) -> std::int64_t { return c.step_state(); }},
        {"HOME_STATE", in_each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.home_state(a); }},
        {"FILTER_STATE", in_each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.filter_state(a); }},
        {"CLEAR_STATE", in_each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.clear_state(a); }},
        {"ACTION_STATE", in_each, [](const Chip& c, const Axis&, int a) -> std::int64_t { return c.action_state(a); }},
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
