// Commands that move the machine manually, stop it, and take control of it.
#include <fmt/format.h>

#include <array>
#include <motionrack/panel/panel_context.hpp>

namespace motionrack::panel {

using nlohmann::json;

namespace {

operate::JogOrigin origin_of(const Caller& caller, const json& fields) {
    return {caller.session, fields.value("sequence", std::int64_t{0}), fields.value("renews", false)};
}

constexpr std::array control = {
    OperationHandler{"take_control",
                     [](PanelContext& desk, const Caller& caller, const json& fields) {
                         return accepted(desk.lease.take(caller.user, caller.session, fields.value("force", false),
                                                         operate::is_stationary(desk.machine.state())));
                     }},
    OperationHandler{"release_control", [](PanelContext& desk, const Caller& caller,
                                           const json&) { return accepted(desk.lease.release(caller.session)); }},
    OperationHandler{"renew_control", [](PanelContext& desk, const Caller& caller,
                                         const json&) { return accepted(desk.lease.keep(caller.session)); }},
    OperationHandler{"stop",
                     [](PanelContext& desk, const Caller& caller, const json&) -> Result<json> {
                         desk.machine.stop({caller.user, caller.address, "STOP"});
                         desk.lease.revoke(caller.user, caller.session);
                         return json::object();
                     }},
};

constexpr std::array motion = {
    OperationHandler{"enable",
                     [](PanelContext& desk, const Caller&, const json& fields) {
                         return accepted(desk.machine.enable(fields.at("on").get<bool>(), fields.value("axes", "")));
                     }},
    OperationHandler{"home", [](PanelContext& desk, const Caller&,
                                const json& fields) { return accepted(desk.machine.home(fields.value("axes", ""))); }},
    OperationHandler{"jog",
                     [](PanelContext& desk, const Caller& caller, const json& fields) -> Result<json> {
                         MOTIONRACK_TRY(const char letter, axis_of(desk, fields));
                         const bool again = desk.machine.state() == operate::MachineState::jogging;
                         MOTIONRACK_CHECK(
                             desk.machine.jog(letter, fields.at("speed").get<double>(), origin_of(caller, fields)));
                         return json{{"again", again}};
                     }},
    OperationHandler{"jog_by",
                     [](PanelContext& desk, const Caller&, const json& fields) -> Result<json> {
                         MOTIONRACK_TRY(const char letter, axis_of(desk, fields));
                         return accepted(desk.machine.jog_by(letter, fields.at("distance").get<double>(),
                                                             fields.at("speed").get<double>()));
                     }},
    OperationHandler{"jog_stop",
                     [](PanelContext& desk, const Caller& caller, const json& fields) -> Result<json> {
                         static_cast<void>(
                             desk.machine.jogs().see(origin_of(caller, fields)));  // a stop is accepted at any age
                         if (desk.machine.state() == operate::MachineState::jogging) desk.machine.cancel();
                         return json::object();
                     }},
    OperationHandler{"touch_off",
                     [](PanelContext& desk, const Caller&, const json& fields) -> Result<json> {
                         MOTIONRACK_TRY(const char letter, axis_of(desk, fields));
                         return accepted(desk.machine.touch_off(letter, fields.at("value").get<double>()));
                     }},
    OperationHandler{"set_position",
                     [](PanelContext& desk, const Caller&, const json& fields) -> Result<json> {
                         MOTIONRACK_TRY(const char letter, axis_of(desk, fields));
                         return accepted(desk.machine.set_position(letter, fields.at("position").get<double>()));
                     }},
};

}  // namespace

Result<char> axis_of(PanelContext& desk, const json& fields) {
    const auto& text = fields.at("axis").get_ref<const std::string&>();
    std::string known;
    for (const rack::RackAxis& axis : desk.machine.rack().config().axes) {
        if (text.size() == 1 && text[0] == axis.letter) return axis.letter;
        known += axis.letter;
    }
    return fail(ErrorKind::invalid_input, fmt::format("Unknown axis {}; the machine has: {}. Nothing was moved.",
                                                      text_of(fields.at("axis")), known));
}

std::span<const OperationHandler> control_doers() {
    return control;
}
std::span<const OperationHandler> motion_doers() {
    return motion;
}

}  // namespace motionrack::panel
