// Commands for programs, lines, overrides and alarms.
#include <fmt/format.h>

#include <array>
#include <motionrack/panel/panel_context.hpp>

namespace motionrack::panel {

using nlohmann::json;

namespace {

/// Initial G-code settings and acceleration reserve of a program that starts now.
struct Reading {
    control::gcode::Settings settings;
    double accel_reserve = 0;
};
Reading reading_of(PanelContext& context) {
    return {context.machine.stream().fresh_settings(), rack::accel_reserve_of(context.machine.rack())};
}

/// Plans the started program in the worker; the plan is ready slightly after the start of motion.
void plan_aside(PanelContext& context, const Reading& reading, std::string text, std::string name) {
    context.plan.reset();
    context.worker.post(
        [&context, number = ++context.programs, reading, text = std::move(text), name = std::move(name)] {
            auto plan =
                std::make_shared<const ProgramPlan>(plan_program(text, name, reading.settings, reading.accel_reserve));
            context.machine.post([&context, number, plan] {
                if (number == context.programs) context.plan = plan;
            });
        });
}

Result<json> begin_program(PanelContext& context, const json& fields) {
    const auto &text = fields.at("text").get_ref<const std::string&>(),
               &name = fields.at("name").get_ref<const std::string&>();
    const Reading reading = reading_of(context);
    MOTIONRACK_CHECK(context.machine.begin_program(text, name));
    context.program = text;
    context.driven.clear();
    plan_aside(context, reading, text, name);
    return json::object();
}

void check(PanelContext& context, const json& fields, Ready ready) {
    context.run_async(
        [reading = reading_of(context), text = fields.at("text").get<std::string>(), name = fields.value("name", ""),
         letters = context.letters]() -> Result<json> {
            return to_json(plan_program(text, name, reading.settings, reading.accel_reserve), letters);
        },
        std::move(ready));
}

constexpr std::array program = {
    OperationHandler{"start_program", [](PanelContext& context, const Caller&,
                                         const json& fields) { return begin_program(context, fields); }},
    OperationHandler{"check", nullptr,
                     [](PanelContext& context, const Caller&, const json& fields, Ready ready) {
                         check(context, fields, std::move(ready));
                     }},
    OperationHandler{"mdi",
                     [](PanelContext& context, const Caller&, const json& fields) -> Result<json> {
                         if (const auto read = context.machine.line(fields.at("text").get_ref<const std::string&>(), 1);
                             !read)
                             return tl::unexpected<Error>(read.error());
                         return json::object();
                     }},
    OperationHandler{
        "hold", [](PanelContext& context, const Caller&, const json&) { return accepted(context.machine.hold()); }},
    OperationHandler{
        "resume", [](PanelContext& context, const Caller&, const json&) { return accepted(context.machine.resume()); }},
    OperationHandler{"reset",
                     [](PanelContext& context, const Caller& caller, const json&) -> Result<json> {
                         context.machine.reset({caller.user, caller.address, "Reset"});
                         return json::object();
                     }},
    OperationHandler{"set_overrides",
                     [](PanelContext& context, const Caller&, const json& fields) -> Result<json> {
                         const operate::Status& status = context.machine.status();
                         context.machine.programs().set_overrides(fields.value("feed", status.feed_override),
                                                                  fields.value("rapid", status.rapid_override));
                         return json::object();
                     }},
    OperationHandler{"set_single_block",
                     [](PanelContext& context, const Caller&, const json& fields) -> Result<json> {
                         context.machine.programs().set_single_block(fields.at("on").get<bool>());
                         return json::object();
                     }},
    OperationHandler{"acknowledge_alarm",
                     [](PanelContext& context, const Caller&, const json& fields) -> Result<json> {
                         const auto number = fields.at("alarm").get<std::int64_t>();
                         if (context.machine.acknowledge_alarm(number)) return json::object();
                         return fail(
                             ErrorKind::invalid_input,
                             fmt::format("The machine has no alarm {} that is active. Nothing was changed.", number));
                     }},
};

}  // namespace

std::span<const OperationHandler> program_doers() {
    return program;
}

}  // namespace motionrack::panel
