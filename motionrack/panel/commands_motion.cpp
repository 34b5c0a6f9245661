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
                     [](PanelContext& context, const Caller& caller, const json& fields) {
                         return accepted(context.lease.take(caller.user, caller.session, fields.value("force", false),
                                                            operate::is_stationary(context.machine.state())));
                     }},
    OperationHandler{"release_control", [](PanelContext& context, const Caller& caller,
                                           const json&) { return accepted(context.lease.release(caller.session)); }},
    OperationHandler{"renew_control", [](PanelContext& context, const Caller& caller,
                                         const json&) { return accepted(context.lease.keep(caller.session)); }},
    OperationHandler{"stop",
                     [](PanelContext& context, const Caller& caller, const json&) -> Result<json> {
                         context.machine.stop({caller.user, caller.address, "STOP"});
                         context.lease.revoke(caller.user, caller.session);
                         return json::object();
                     }},
};

constexpr std::array motion = {
    OperationHandler{"enable",
                     [](PanelContext& context, const Caller&, const json& fields) {
                         return accepted(context.machine.enable(fields.at("on").get<bool>(), fields.value("axes", "")));
                     }},
    OperationHandler{"home",
                     [](PanelContext& context, const Caller&, const json& fields) {
                         return accepted(context.machine.manual().home(fields.value("axes", "")));
                     }},
    OperationHandler{"jog",
                     [](PanelContext& context, const Caller& caller, const json& fields) -> Result<json> {
                         MOTIONRACK_TRY(const char letter, axis_of(context, fields));
                         const bool again = context.machine.state() == operate::MachineState::jogging;
                         MOTIONRACK_CHECK(context.machine.manual().jog(letter, fields.at("speed").get<double>(),
                                                                       origin_of(caller, fields)));
                         return json{{"again", again}};
                     }},
    OperationHandler{"jog_by",
                     [](PanelContext& context, const Caller&, const json& fields) -> Result<json> {
                         MOTIONRACK_TRY(const char letter, axis_of(context, fields));
                         return accepted(context.machine.manual().jog_by(letter, fields.at("distance").get<double>(),
                                                                         fields.at("speed").get<double>()));
                     }},
    OperationHandler{"jog_stop",
                     [](PanelContext& context, const Caller& caller, const json& fields) -> Result<json> {
                         static_cast<void>(context.machine.manual().jogs().see(
                             origin_of(caller, fields)));  // a stop is accepted at any age
                         if (context.machine.state() == operate::MachineState::jogging) context.machine.cancel();
                         return json::object();
                     }},
    OperationHandler{"touch_off",
                     [](PanelContext& context, const Caller&, const json& fields) -> Result<json> {
                         MOTIONRACK_TRY(const char letter, axis_of(context, fields));
                         return accepted(operate::touch_off(context.machine, letter, fields.at("value").get<double>()));
                     }},
    OperationHandler{"set_position",
                     [](PanelContext& context, const Caller&, const json& fields) -> Result<json> {
                         MOTIONRACK_TRY(const char letter, axis_of(context, fields));
                         return accepted(
                             context.machine.manual().set_position(letter, fields.at("position").get<double>()));
                     }},
};

}  // namespace

Result<char> axis_of(PanelContext& context, const json& fields) {
    const auto& text = fields.at("axis").get_ref<const std::string&>();
    std::string known;
    for (const rack::RackAxis& axis : context.machine.rack().config().axes) {
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
