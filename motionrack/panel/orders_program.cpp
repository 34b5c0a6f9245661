// Orders about programs, lines, their speed, and alarms.
#include <fmt/format.h>

#include <array>
#include <motionrack/panel/desk.hpp>

namespace motionrack::panel {

using nlohmann::json;

namespace {

Result<json> taken(const Result<void>& result) {
    if (!result) return tl::unexpected<Error>(result.error());
    return json::object();
}

constexpr std::array program = {
    Doer{"begin", [](Desk& desk, const Caller&, const json& fields) {
        return taken(desk.machine.begin_program(fields.at("text").get<std::string>(), fields.at("name").get<std::string>()));
    }},
    Doer{"line", [](Desk& desk, const Caller&, const json& fields) -> Result<json> {
        if (const auto read = desk.machine.line(fields.at("text").get_ref<const std::string&>(), 1); !read) return tl::unexpected<Error>(read.error());
        return json::object();
    }},
    Doer{"hold", [](Desk& desk, const Caller&, const json&) { return taken(desk.machine.hold()); }},
    Doer{"resume", [](Desk& desk, const Caller&, const json&) { return taken(desk.machine.resume()); }},
    Doer{"reset", [](Desk& desk, const Caller&, const json&) -> Result<json> {
        desk.machine.reset();
        return json::object();
    }},
    Doer{"set_overrides", [](Desk& desk, const Caller&, const json& fields) -> Result<json> {
        const operate::Status& status = desk.machine.status();
        desk.machine.set_overrides(fields.value("feed", status.feed_override), fields.value("rapid", status.rapid_override));
        return json::object();
    }},
    Doer{"set_single_step", [](Desk& desk, const Caller&, const json& fields) -> Result<json> {
        desk.machine.set_single_step(fields.at("on").get<bool>());
        return json::object();
    }},
    Doer{"acknowledge", [](Desk& desk, const Caller&, const json& fields) -> Result<json> {
        const auto number = fields.at("alarm").get<std::int64_t>();
        if (desk.machine.acknowledge(number)) return json::object();
        return fail(Trouble::bad_input, fmt::format("There is no alarm {} that is still there. Nothing was changed.", number));
    }},
};

}  // namespace

std::span<const Doer> program_doers() { return program; }

}  // namespace motionrack::panel
