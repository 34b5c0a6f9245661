// Commands and queries of the scope.
#include <array>
#include <motionrack/panel/panel_context.hpp>

namespace motionrack::panel {

using nlohmann::json;

namespace {

Result<json> arm(PanelContext& context, const json& fields) {
    ScopeSettings settings;
    settings.channels = fields.at("channels").get<std::vector<std::string>>();
    settings.trigger = fields.value("trigger", "");
    const std::string edge = fields.value("edge", "rise"), mode = fields.value("mode", "single");
    settings.edge = edge == "rise" ? TriggerEdge::rise : edge == "fall" ? TriggerEdge::fall : TriggerEdge::either;
    settings.level = number_of(fields, "level", settings.level);
    settings.period = from_seconds(number_of(fields, "period_us", 100) * 1e-6);
    settings.length = from_seconds(number_of(fields, "length", 0.1));
    settings.pre = from_seconds(number_of(fields, "pre", 0));
    settings.again = mode == "run";
    return accepted(context.scope.arm(settings));
}

/// Writes the data as JSON in the worker, in parallel with motion.
void read_capture(PanelContext& context, const json& fields, Ready ready) {
    const ScopeSettings& settings = context.scope.settings();
    json out = {{"state", name_of(context.scope.state())},
                {"channels", settings.channels},
                {"trigger", settings.trigger},
                {"mode", settings.again ? "run" : "single"}};
    const std::shared_ptr<const ScopeCapture> capture = context.scope.capture();
    if (!capture || capture->number <= static_cast<std::int64_t>(number_of(fields, "since", 0)))
        return ready(std::move(out));
    context.run_async(
        [out = std::move(out), capture]() mutable -> Result<json> {
            out["capture"] = to_json(*capture);
            return out;
        },
        std::move(ready));
}

constexpr std::array scope_rows = {
    OperationHandler{"scope_arm",
                     [](PanelContext& context, const Caller&, const json& fields) { return arm(context, fields); }},
    OperationHandler{"scope_stop",
                     [](PanelContext& context, const Caller&, const json&) -> Result<json> {
                         context.scope.stop();
                         return json::object();
                     }},
    OperationHandler{"scope", nullptr,
                     [](PanelContext& context, const Caller&, const json& fields, Ready ready) {
                         read_capture(context, fields, std::move(ready));
                     }},
};

}  // namespace

std::span<const OperationHandler> scope_doers() {
    return scope_rows;
}

}  // namespace motionrack::panel
