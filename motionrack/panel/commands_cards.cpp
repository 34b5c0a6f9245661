// Commands to cards, wires and the clock, for manual tests.
#include <fmt/format.h>

#include <array>
#include <limits>
#include <motionrack/panel/panel_context.hpp>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/stop_reactions.hpp>

namespace motionrack::panel {

using nlohmann::json;

namespace {

/// Refused for a card replaced by a real one, since effects on the virtual card would be mistaken for its own.
Result<void> check_virtual(PanelContext& context, std::string_view name, std::string_view what) {
    const operate::LivePlace* const live = context.machine.service().live_place(card_part(name));
    if (live == nullptr) return {};
    return fail(ErrorKind::refused,
                fmt::format("{}: card {} is a real one at {}. Nothing was done. Call the functions of its library.",
                            what, live->card, live->place));
}

Result<json> set_wire(PanelContext& context, const json& fields) {
    const auto& name = fields.at("name").get_ref<const std::string&>();
    const json& value = fields.at("value");
    MOTIONRACK_CHECK(check_virtual(context, name, "The wire was not driven"));
    return accepted(context.machine.wires().force(
        name, value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>()));
}

/// Presses or releases the page's emergency-stop button, which is in series with the machine's own contacts.
Result<json> set_estop(PanelContext& context, bool pressed) {
    rack::SafetyContacts& contacts = context.machine.rack().stop_latch().contacts();
    contacts.press(pressed);
    if (pressed || !contacts.is_pressed()) return json::object();
    return fail(ErrorKind::refused,
                "The emergency stop stays pressed: its wire is low, or one of its contacts is open. The button of this "
                "page was released; close the contact, or release the wire.");
}

Result<json> start_part(PanelContext& context, const std::string& part) {
    MOTIONRACK_CHECK(context.machine.conditions().may_begin("Nothing was started"));
    return accepted(rack::start_part(context.machine.rack(), part));
}

Result<json> inject_fault(PanelContext& context, const json& fields) {
    const auto& target = fields.at("target").get_ref<const std::string&>();
    MOTIONRACK_CHECK(check_virtual(context, target, "Nothing was broken"));
    return accepted(
        rack::inject_fault(context.machine.rack(), fields.at("fault").get_ref<const std::string&>(), target));
}

void access(PanelContext& context, const json& fields, Ready ready) {
    operate::ManualAccess::BusAccess access{fields.at("card").get<std::string>(),
                                            static_cast<int>(fields.at("bits").get<double>()),
                                            static_cast<std::uint32_t>(fields.at("address").get<double>()),
                                            {}};
    if (fields.contains("value")) access.value = static_cast<std::uint32_t>(fields.at("value").get<double>());
    if (const Result<void> is = check_virtual(context, access.card, "The card was not accessed"); !is)
        return ready(tl::unexpected<Error>(is.error()));
    const Result<void> taken = context.machine.manual_access().request(access, [ready](Result<std::uint32_t> value) {
        ready(value ? Result<json>(json{{"value", *value}}) : tl::unexpected<Error>(value.error()));
    });
    if (!taken) ready(tl::unexpected<Error>(taken.error()));
}

Result<operate::ClockPacer*> pacer_of(PanelContext& context) {
    if (context.settings.pacer != nullptr) return context.settings.pacer;
    return fail(ErrorKind::refused, "The clock of this machine cannot be changed.");
}

Result<json> set_clock(PanelContext& context, const json& fields) {
    MOTIONRACK_TRY(operate::ClockPacer * pacer, pacer_of(context));
    if (const auto live = context.machine.service().live_places(); !live.empty())
        return fail(ErrorKind::refused,
                    fmt::format("The clock was not changed: card {} is a real one, so the rack runs in real time with "
                                "factor 1. Serve it without --live to change the clock.",
                                live.front().card));
    const auto& name = fields.at("mode").get_ref<const std::string&>();
    for (const operate::ClockMode mode :
         {operate::ClockMode::real, operate::ClockMode::unthrottled, operate::ClockMode::paused})
        if (operate::name_of(mode) == name)
            return accepted(pacer->set(mode, number_of(fields, "factor", pacer->factor())));
    return fail(
        ErrorKind::invalid_input,
        fmt::format("Unknown clock mode '{}'; it must be real, unthrottled or paused. Nothing was changed.", name));
}

Result<json> advance_clock(PanelContext& context, const json& fields) {
    MOTIONRACK_TRY(operate::ClockPacer * pacer, pacer_of(context));
    return accepted(pacer->step(from_seconds(fields.at("duration_s").get<double>())));
}

constexpr std::array card_rows = {
    OperationHandler{
        "set_wire", [](PanelContext& context, const Caller&, const json& fields) { return set_wire(context, fields); }},
    OperationHandler{"set_estop",
                     [](PanelContext& context, const Caller&, const json& fields) {
                         return set_estop(context, fields.at("pressed").get<bool>());
                     }},
    OperationHandler{"inject_fault", [](PanelContext& context, const Caller&,
                                        const json& fields) { return inject_fault(context, fields); }},
    OperationHandler{"start_part",
                     [](PanelContext& context, const Caller&, const json& fields) {
                         return start_part(context, fields.at("part").get_ref<const std::string&>());
                     }},
    OperationHandler{"write_register", nullptr,
                     [](PanelContext& context, const Caller&, const json& fields, Ready ready) {
                         access(context, fields, std::move(ready));
                     }},
    OperationHandler{"read_register", nullptr,
                     [](PanelContext& context, const Caller&, const json& fields, Ready ready) {
                         access(context, fields, std::move(ready));
                     }},
    OperationHandler{"set_clock", [](PanelContext& context, const Caller&,
                                     const json& fields) { return set_clock(context, fields); }},
    OperationHandler{"advance_clock", [](PanelContext& context, const Caller&,
                                         const json& fields) { return advance_clock(context, fields); }},
};

}  // namespace

std::span<const OperationHandler> card_doers() {
    return card_rows;
}

}  // namespace motionrack::panel
