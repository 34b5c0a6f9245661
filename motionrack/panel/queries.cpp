// Queries about the machine, its rack and its events.
#include <algorithm>
#include <array>
#include <motionrack/panel/card_view.hpp>
#include <motionrack/panel/panel_context.hpp>
#include <motionrack/panel/status_writer.hpp>
#include <motionrack/rack/bus_access.hpp>
#include <motionrack/rack/homing_report.hpp>

namespace motionrack::panel {

using nlohmann::json;

namespace {

Result<json> channels_of(PanelContext& context) {
    json list = json::array();
    for (const auto& [name, channel] : context.channels.all())
        list.push_back(
            {{"name", name}, {"unit", channel.unit}, {"text", channel.text}, {"looks", name_of(channel.reader)}});
    return json{{"channels", std::move(list)}};
}

Result<json> rack_of(PanelContext& context) {
    json out = context.facts;
    out["text"] = context.settings.rack_text;
    return out;
}

Result<json> card_of(PanelContext& context, const json& fields) {
    MOTIONRACK_TRY(rack::Card * card,
                   rack::card_named(context.machine.rack(), fields.at("name").get_ref<const std::string&>()));
    return card_now(context.machine, *card);
}

/// Returns the planned and the actual path as JSON.
json path_json(const ProgramPlan* plan, const std::vector<ActualPath::ActualPoint>& driven, const std::string& letters,
               std::int64_t number) {
    json out = plan != nullptr ? to_json(*plan, letters) : json::object();
    out["number"] = number;
    out["axes"] = letters;
    if (plan != nullptr) out["planned"] = std::move(out["path"]);
    out.erase("path");
    json positions = json::array(), errors = json::array();
    for (const ActualPath::ActualPoint& point : driven) {
        json position = position_json(point.position, letters);
        position.insert(position.begin(), to_seconds(point.at));
        positions.push_back(std::move(position));
        errors.push_back(point.error);
    }
    out["driven"] = std::move(positions);
    out["errors"] = std::move(errors);
    return out;
}

/// Answers the query for the path; the worker writes the JSON. Fields: `have`, the number of the client's plan, which
/// is not sent again; `since`, s: only later points of the actual path.
void write_path(PanelContext& context, const json& fields, Ready ready) {
    const Instant since = from_seconds(number_of(fields, "since", -1));
    std::vector<ActualPath::ActualPoint> driven;
    for (const ActualPath::ActualPoint& point : context.driven.points())
        if (point.at > since) driven.push_back(point);
    const auto plan =
        context.programs == static_cast<std::int64_t>(number_of(fields, "have", 0)) ? nullptr : context.plan;
    context.run_async(
        [plan, driven = std::move(driven), letters = context.letters, number = context.plan ? context.programs : 0]()
            -> Result<json> { return path_json(plan.get(), driven, letters, number); },
        std::move(ready));
}

/// Answers the query for the path after the worker's earlier work, such as the plan of a program that has just started.
void path_of(PanelContext& context, const json& fields, Ready ready) {
    context.run_async([]() -> Result<json> { return json(); },
                      [&context, fields, ready = std::move(ready)](Result<json> through) {
                          if (!through) return ready(std::move(through));
                          write_path(context, fields, ready);
                      });
}

Result<json> events_of(PanelContext& context, const json& fields) {
    const auto since = static_cast<std::int64_t>(number_of(fields, "since", 0));
    const auto limit = static_cast<std::size_t>(number_of(fields, "limit", 200));
    json list = json::array();
    std::vector<const Event*> found;
    for (const Event& event : context.book.events())
        if (event.number > since) found.push_back(&event);
    for (std::size_t i = found.size() - std::min(found.size(), limit); i < found.size(); ++i)
        list.push_back(to_json(*found[i]));
    return json{{"events", std::move(list)}};
}

void journal_of(PanelContext& context, const json& fields, Ready ready) {
    if (context.settings.journal == nullptr) return ready(fail(ErrorKind::refused, "The machine has no journal."));
    journal::JournalQuery question{static_cast<std::int64_t>(number_of(fields, "since", 0)), fields.value("kind", ""),
                                   static_cast<int>(number_of(fields, "limit", 100))};
    context.run_async(
        [book = context.settings.journal, question]() -> Result<json> {
            MOTIONRACK_TRY(const std::vector<journal::Entry> entries, book->read(question));
            json list = json::array();
            for (const journal::Entry& entry : entries)
                list.push_back({{"number", entry.number},
                                {"run", entry.run},
                                {"utc_ms", entry.utc_ms},
                                {"at", to_seconds(entry.at)},
                                {"kind", entry.kind},
                                {"text", entry.text},
                                {"data", json::parse(entry.data.empty() ? "null" : entry.data, nullptr, false)}});
            return json{{"journal", std::move(list)}};
        },
        std::move(ready));
}

void journal_check(PanelContext& context, const Ready& ready) {
    if (context.settings.journal == nullptr) return ready(fail(ErrorKind::refused, "The machine has no journal."));
    context.run_async(
        [book = context.settings.journal]() -> Result<json> {
            MOTIONRACK_TRY(const journal::ChainCheck check, book->check());
            return json{{"whole", check.problem.empty()}, {"entries", check.entries}, {"problem", check.problem}};
        },
        ready);
}

Result<json> control_of(PanelContext& context) {
    const auto holder = context.lease.holder();
    if (!holder) return json{{"holder", nullptr}};
    return json{{"holder", holder->user}, {"since", holder->since}, {"holder_session", session_mark(holder->session)}};
}

Result<json> homing_of(PanelContext& context) {
    const auto& homed = context.machine.manual().last_homing();
    return json{{"homing", homed ? json(rack::homing_report(*homed)) : json()}};
}

constexpr std::array looking = {
    OperationHandler{"status",
                     [](PanelContext& context, const Caller&, const json&) -> Result<json> {
                         const StatusWriter writer(context.machine);
                         return json{{"status", json::parse(writer.writer(context)(context.machine.status()))}};
                     }},
    OperationHandler{"channels",
                     [](PanelContext& context, const Caller&, const json&) { return channels_of(context); }},
    OperationHandler{"rack", [](PanelContext& context, const Caller&, const json&) { return rack_of(context); }},
    OperationHandler{"card",
                     [](PanelContext& context, const Caller&, const json& fields) { return card_of(context, fields); }},
    OperationHandler{"slopes",
                     [](PanelContext& context, const Caller&, const json& fields) {
                         return slopes_now(context.machine.rack(), fields.at("name").get<std::string>());
                     }},
    OperationHandler{"frames",
                     [](PanelContext& context, const Caller&, const json&) { return frames_now(context.machine); }},
    OperationHandler{"workpiece",
                     [](PanelContext& context, const Caller&, const json& fields) {
                         return workpiece_now(context.machine, fields.at("scanner").get<std::string>(),
                                              static_cast<std::size_t>(number_of(fields, "points", 5000)));
                     }},
    OperationHandler{"path", nullptr,
                     [](PanelContext& context, const Caller&, const json& fields, Ready ready) {
                         path_of(context, fields, std::move(ready));
                     }},
    OperationHandler{
        "events", [](PanelContext& context, const Caller&, const json& fields) { return events_of(context, fields); }},
    OperationHandler{"journal", nullptr,
                     [](PanelContext& context, const Caller&, const json& fields, Ready ready) {
                         journal_of(context, fields, std::move(ready));
                     }},
    OperationHandler{
        "journal_check", nullptr,
        [](PanelContext& context, const Caller&, const json&, Ready ready) { journal_check(context, ready); }},
    OperationHandler{"program",
                     [](PanelContext& context, const Caller&, const json&) -> Result<json> {
                         return json{{"name", context.machine.status().program}, {"text", context.program}};
                     }},
    OperationHandler{"homing", [](PanelContext& context, const Caller&, const json&) { return homing_of(context); }},
    OperationHandler{"control", [](PanelContext& context, const Caller&, const json&) { return control_of(context); }},
};

}  // namespace

std::span<const OperationHandler> looking_doers() {
    return looking;
}

}  // namespace motionrack::panel
