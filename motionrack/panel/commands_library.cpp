// Manual calls of a card's function library: list of functions, the service for the calls, single calls.
#include <fmt/format.h>

#include <array>
#include <motionrack/operate/service.hpp>
#include <motionrack/panel/panel_context.hpp>

namespace motionrack::panel {

using nlohmann::json;

namespace {

// ---- the declaration

json argument_json(const ArgumentInfo& argument) {
    json values = json::array();
    for (const ValueInfo& one : argument.values) values.push_back({{"value", one.value}, {"meaning", one.meaning}});
    return {{"name", argument.name}, {"min", argument.min},        {"max", argument.max},
            {"unit", argument.unit}, {"start", argument.start},    {"values", std::move(values)},
            {"sum", argument.sum},   {"meaning", argument.meaning}};
}

json function_json(const FunctionInfo& function) {
    json arguments = json::array();
    for (const ArgumentInfo& one : function.arguments) arguments.push_back(argument_json(one));
    return {{"name", function.name},       {"group", function.group},
            {"meaning", function.meaning}, {"arguments", std::move(arguments)},
            {"returns", function.returns}, {"waits", function.waits},
            {"own", function.own}};
}

Result<json> library_of(PanelContext& context, const json& fields) {
    MOTIONRACK_TRY(const auto functions,
                   operate::library_of(context.machine.rack(), fields.at("name").get_ref<const std::string&>()));
    json out = json::array();
    for (const FunctionInfo& one : functions) out.push_back(function_json(one));
    return json{{"functions", std::move(out)}};
}

// ---- commands

operate::StopOrigin origin_of(const Caller& caller) {
    return {caller.user, caller.address, {}};
}

void service(PanelContext& context, const Caller& caller, const json& fields, const Ready& ready) {
    const auto& card = fields.at("card").get_ref<const std::string&>();
    const auto reported = [ready](const Result<std::string>& text) {
        ready(text ? Result<json>(json{{"text", *text}}) : tl::unexpected<Error>(text.error()));
    };
    operate::Service& service = context.machine.service();
    if (!fields.at("on").get<bool>() && service.on() && service.card() != card)
        return ready(fail(ErrorKind::refused,
                          fmt::format("The machine is in the service state for card {}, not for card {}. Nothing was "
                                      "changed.",
                                      service.card(), card)));
    const Result<void> taken = fields.at("on").get<bool>()
                                   ? service.begin(card, origin_of(caller), caller.session, reported)
                                   : service.end(reported);
    if (!taken) ready(tl::unexpected<Error>(taken.error()));
}

/// Records a call that was rejected or has ended, and the start of a call that waits. So the journal shows its motion
/// even if the program ends meanwhile.
void note_call(PanelContext& context, const Caller& caller, const std::string& function, const std::string& what) {
    const json data = {{"command", "call"}, {"user", caller.user}};
    const Event& event = context.book.add(
        {0, context.machine.now(), "command", fmt::format("{}: call {}: {}", caller.user, function, what), data});
    if (context.settings.journal != nullptr)
        context.settings.journal->write(event.at, event.kind, event.text, text_of(data));
}

void call(PanelContext& context, const Caller& caller, const json& fields, const Ready& ready) {
    operate::Service::FunctionCall call{
        fields.at("card").get<std::string>(), fields.at("function").get<std::string>(), {}};
    const json arguments = fields.value("arguments", json::object());
    for (const auto& [name, value] : arguments.items())
        call.arguments[name] = static_cast<std::int64_t>(value.get<double>());
    const auto answered = [&context, caller, function = call.function, ready](const Result<CallAnswer>& answer) {
        if (!answer) {
            note_call(context, caller, function, answer.error().text());
            return ready(tl::unexpected<Error>(answer.error()));
        }
        json out = {{"text", answer->text}};
        if (answer->value) out["value"] = *answer->value;
        ready(std::move(out));
    };
    const std::string card = call.card, function = call.function;
    const Result<void> taken =
        context.machine.service().call(std::move(call), origin_of(caller), caller.session, answered);
    if (!taken) return ready(tl::unexpected<Error>(taken.error()));
    const auto functions = operate::library_of(context.machine.rack(), card);
    for (const FunctionInfo& one : *functions)
        if (one.name == function && one.waits)
            note_call(context, caller, function, fmt::format("begun with {}", text_of(arguments)));
}

constexpr std::array library_rows = {
    OperationHandler{"service", nullptr,
                     [](PanelContext& context, const Caller& caller, const json& fields, Ready ready) {
                         service(context, caller, fields, ready);
                     }},
    OperationHandler{"call", nullptr,
                     [](PanelContext& context, const Caller& caller, const json& fields, Ready ready) {
                         call(context, caller, fields, ready);
                     }},
    OperationHandler{"library", [](PanelContext& context, const Caller&,
                                   const json& fields) { return library_of(context, fields); }},
};

}  // namespace

std::span<const OperationHandler> library_doers() {
    return library_rows;
}

}  // namespace motionrack::panel
