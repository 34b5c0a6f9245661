// Commands for programs, lines, overrides and alarms.
#include <fmt/format.h>

#include <array>
#include <motionrack/panel/panel_context.hpp>

namespace motionrack::panel {

using nlohmann::json;

namespace {

/// Reader state of a program that starts now.
struct Reading {
    control::gcode::Settings settings;
    double accel_reserve = 0;
};
Reading reading_of(PanelContext& desk) {
    return {desk.machine.stream().fresh_settings(), rack::accel_reserve_of(desk.machine.rack())};
}

/// The plan is ready slightly after the start of motion.
void plan_aside(PanelContext& desk, const Reading& reading, std::string text, std::string name) {
    desk.plan.reset();
    desk.worker.post([&desk, number = ++desk.programs, reading, text = std::move(text), name = std::move(name)] {
        auto plan =
            std::make_shared<const ProgramPlan>(plan_program(text, name, reading.settings, reading.accel_reserve));
        desk.machine.post([&desk, number, plan] {
            if (number == desk.programs) desk.plan = plan;
        });
    });
}

Result<json> begin_program(PanelContext& desk, const json& fields) {
    const auto &text = fields.at("text").get_ref<const std::string&>(),
               &name = fields.at("name").get_ref<const std::string&>();
    const Reading reading = reading_of(desk);
    MOTIONRACK_CHECK(desk.machine.begin_program(text, name));
    desk.program = text;
    desk.driven.clear();
    plan_aside(desk, reading, text, name);
    return json::object();
}

void check(PanelContext& desk, const json& fields, Ready ready) {
    desk.run_async(
        [reading = reading_of(desk), text = fields.at("text").get<std::string>(), name = fields.value("name", ""),
         letters = desk.letters]() -> Result<json> {
            return to_json(plan_program(text, name, reading.settings, reading.accel_reserve), letters);
        },
        std::move(ready));
}

constexpr std::array program = {
    OperationHandler{"start_program",
                     [](PanelContext& desk, const Caller&, const json& fields) { return begin_program(desk, fields); }},
    OperationHandler{"check", nullptr,
                     [](PanelContext& desk, const Caller&, const json& fields, Ready ready) {
                         check(desk, fields, std::move(ready));
                     }},
    OperationHandler{"mdi",
                     [](PanelContext& desk, const Caller&, const json& fields) -> Result<json> {
                         if (const auto read = desk.machine.line(fields.at("text").get_ref<const std::string&>(), 1);
                             !read)
                             return tl::unexpected<Error>(read.error());
                         return json::object();
                     }},
    OperationHandler{"hold",
                     [](PanelContext& desk, const Caller&, const json&) { return accepted(desk.machine.hold()); }},
    OperationHandler{"resume",
                     [](PanelContext& desk, const Caller&, const json&) { return accepted(desk.machine.resume()); }},
    OperationHandler{"reset",
                     [](PanelContext& desk, const Caller& caller, const json&) -> Result<json> {
                         desk.machine.reset({caller.user, caller.address, "Reset"});
                         return json::object();
                     }},
    OperationHandler{"set_overrides",
                     [](PanelContext& desk, const Caller&, const json& fields) -> Result<json> {
                         const operate::Status& status = desk.machine.status();
                         desk.machine.set_overrides(fields.value("feed", status.feed_override),
                                                    fields.value("rapid", status.rapid_override));
                         return json::object();
                     }},
    OperationHandler{"set_single_block",
                     [](PanelContext& desk, const Caller&, const json& fields) -> Result<json> {
                         desk.machine.set_single_block(fields.at("on").get<bool>());
                         return json::object();
                     }},
    OperationHandler{"acknowledge_alarm",
                     [](PanelContext& desk, const Caller&, const json& fields) -> Result<json> {
                         const auto number = fields.at("alarm").get<std::int64_t>();
                         if (desk.machine.acknowledge_alarm(number)) return json::object();
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
