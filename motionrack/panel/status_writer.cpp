// Writes the status that the page always shows.
#include <algorithm>
#include <cmath>
#include <motionrack/operate/clock_pacer.hpp>
#include <motionrack/panel/panel_context.hpp>
#include <motionrack/panel/status_writer.hpp>
#include <motionrack/rack/card_types.hpp>
#include <utility>

namespace motionrack::panel {

using nlohmann::json;

namespace {

/// Signals of an axis that the page shows as lamps; switches are low (0) while they act.
constexpr rack::Lamp axis_lamps[] = {{"hard_minus", "limit_minus", 0},
                                     {"hard_plus", "limit_plus", 0},
                                     {"home", "home", 0},
                                     {"cam", "cam", 0},
                                     {"index", "enc_z"}};

/// Data collected by the motion thread for one status.
struct Noted {
    std::vector<std::vector<std::pair<std::string_view, bool>>> leds;  // by axis
    bool estop_pressed = false;
    std::optional<auth::ControlLease::Holder> holder;
    std::optional<double> remaining_s;  // of the program, at its overrides
    json link, clock;
};

json clock_of(const operate::ClockPacer* pacer) {
    if (pacer == nullptr) return {{"mode", "unthrottled"}, {"factor", 1}, {"late_ms", 0}};
    return {{"mode", operate::name_of(pacer->mode())},
            {"factor", pacer->factor()},
            {"late_ms", to_seconds(pacer->lateness().within(0.99)) * 1e3},
            {"lost_s", to_seconds(pacer->lost())}};
}

json phases_of(const std::vector<control::AxisHomingState>& states) {
    json out = json::object();
    for (const control::AxisHomingState& one : states) out[std::string(1, one.letter)] = one.state;
    return out;
}

}  // namespace

namespace {

/// Returns the in-position window, mm or degrees: a servo's position window, but at least two pulses or counts, since
/// both are rounded.
double near_of(const rack::RackAxis& axis) {
    const double counts = axis.counts_per_unit();
    const double rounding = 2 * std::max(1 / axis.pulses_per_unit(), counts > 0 ? 1 / counts : 0);
    return std::max(rounding, axis.servo ? axis.servo->position_window.value_or(0) : 0);
}

}  // namespace

/// Data of the rack that is constant while it runs.
struct StatusWriter::Facts {
    struct Axis {
        std::string unit;
        bool can_home = false;
        double min = 0, max = 0, max_velocity = 0;
        double near = 0;  // in-position window around the commanded position
        struct Led {
            std::string_view name;
            std::string wire;
            int lit = 1;
        };
        std::vector<Led> leds;
    };
    std::vector<Axis> axes;
};

namespace {

json alarms_of(const operate::Status& status) {
    json out = json::array();
    for (const operate::Alarm& alarm : status.alarms)
        out.push_back({{"number", alarm.number},
                       {"at", to_seconds(alarm.at)},
                       {"text", alarm.text},
                       {"active", alarm.active},
                       {"acknowledged", alarm.acknowledged},
                       {"source", alarm.source}});
    return out;
}

}  // namespace

StatusWriter::StatusWriter(operate::Machine& machine) {
    auto facts = std::make_shared<Facts>();
    const rack::RackConfig& config = machine.rack().config();
    for (const rack::RackAxis& axis : config.axes) {
        Facts::Axis one{std::string(axis.unit()),
                        config.can_home(axis),
                        axis.min_limit,
                        axis.max_limit,
                        axis.max_velocity,
                        near_of(axis),
                        {}};
        const auto add = [&](const rack::Lamp& lamp, const std::string& before) {
            std::string wire = before + std::string(lamp.pin);
            if (machine.wires().knows(wire)) one.leds.push_back({lamp.name, std::move(wire), lamp.lit});
        };
        for (const rack::Lamp& lamp : axis_lamps) add(lamp, std::string(1, axis.letter) + ".");
        for (const rack::Lamp& lamp : rack::find_card_type(config.card(axis.card)->type)->lamps)
            add(lamp, axis.card + "." + axis.channel);
        facts->axes.push_back(std::move(one));
    }
    facts_ = std::move(facts);
}

std::function<std::string(const operate::Status&)> StatusWriter::writer(PanelContext& context) const {
    auto noted = std::make_shared<Noted>();
    for (const Facts::Axis& axis : facts_->axes) {
        auto& leds = noted->leds.emplace_back();
        for (const Facts::Axis::Led& led : axis.leds)
            leds.emplace_back(led.name, context.machine.wires().get(led.wire).value_or(1 - led.lit) == led.lit);
    }
    noted->estop_pressed = context.machine.wires().get("estop").value_or(1) == 0;
    noted->holder = context.lease.holder();
    if (context.settings.link) noted->link = context.settings.link();
    noted->clock = clock_of(context.settings.pacer);
    const operate::Status& now = context.machine.status();
    if (now.program_runs && context.plan)
        noted->remaining_s = context.plan->after(now.line) / std::max(0.01, now.feed_override);
    return [facts = facts_, noted](const operate::Status& status) {
        const bool is_stationary = operate::is_stationary(status.state);
        json axes = json::array();
        for (std::size_t i = 0; i < status.axes.size(); ++i) {
            const operate::AxisStatus& axis = status.axes[i];
            const Facts::Axis& fact = facts->axes[i];
            json leds = json::object();
            if (axis.position_valid) {
                leds["soft_minus"] = axis.commanded <= fact.min;
                leds["soft_plus"] = axis.commanded >= fact.max;
            }
            leds["in_position"] = is_stationary && std::fabs(axis.commanded - axis.actual) <= fact.near;
            for (const auto& [name, on] : noted->leds[i]) leds[std::string(name)] = on;
            axes.push_back({{"letter", std::string(1, axis.letter)},
                            {"unit", fact.unit},
                            {"position_valid", axis.position_valid},
                            {"enabled", axis.enabled},
                            {"can_home", fact.can_home},
                            {"commanded", axis.commanded},
                            {"actual", axis.actual},
                            {"error", axis.commanded - axis.actual},
                            {"velocity", axis.velocity},
                            {"pulses", axis.pulses},
                            {"counts", axis.counts},
                            {"min", fact.min},
                            {"max", fact.max},
                            {"max_velocity", fact.max_velocity},
                            {"leds", std::move(leds)}});
        }
        json out = {
            {"at", to_seconds(status.at)},
            {"sequence", status.sequence},
            {"state", operate::name_of(status.state)},
            {"reason", status.reason},
            {"service", status.service},
            {"simulation", !status.real},
            {"estop", {{"wired", true}, {"pressed", noted->estop_pressed}}},
            {"axes", std::move(axes)},
            {"program",
             {{"name", status.program},
              {"runs", status.program_runs},
              {"line", status.line},
              {"lines", status.lines},
              {"single_block", status.single_block},
              {"remaining_s", noted->remaining_s ? json(*noted->remaining_s) : json()}}},
            {"homing", {{"runs", status.state == operate::MachineState::homing}, {"phases", phases_of(status.homing)}}},
            {"overrides", {{"feed", status.feed_override}, {"rapid", status.rapid_override}}},
            {"alarms", alarms_of(status)},
            {"link", noted->link},
            {"clock", noted->clock}};
        json& control = out["control"] = {{"holder", nullptr}};
        if (noted->holder)
            control = {{"holder", noted->holder->user},
                       {"since", noted->holder->since},
                       {"holder_session", session_mark(noted->holder->session)}};
        return text_of(out);
    };
}

}  // namespace motionrack::panel
