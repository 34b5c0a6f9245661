// Queries about the machine as a whole.
#include <array>
#include <motionrack/panel/desk.hpp>
#include <motionrack/panel/status_text.hpp>

namespace motionrack::panel {

using nlohmann::json;

namespace {

constexpr std::array looking = {
    Doer{"status", [](Desk& desk, const Caller&, const json&) -> Result<json> {
        const StatusWriter writer(desk.machine);
        return json{{"status", json::parse(writer.writer(desk)(desk.machine.status()))}};
    }},
    Doer{"channels", [](Desk& desk, const Caller&, const json&) -> Result<json> {
        json list = json::array();
        for (const auto& [name, channel] : desk.channels.all()) list.push_back({{"name", name}, {"unit", channel.unit}, {"text", channel.text}});
        return json{{"channels", std::move(list)}};
    }},
};

}  // namespace

std::span<const Doer> looking_doers() { return looking; }

}  // namespace motionrack::panel
