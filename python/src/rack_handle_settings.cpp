// Settings of a rack before its start.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/rack/card_types.hpp>
#include <motionrack/rack/toml_reader.hpp>
#include <python/src/rack_handle.hpp>

namespace motionrack::python {

Result<void> RackHandle::plan_faults(const std::vector<std::string>& texts) {
    if (texts.empty()) return {};
    if (rack().started())
        return fail(ErrorKind::refused,
                    "Faults can only be planned before the rack's time begins; nothing was planned. Advance to the "
                    "instant and inject it then (Rack.fault, Rack.wires), or plan it for Rack.new_instance().");
    rack::Rack other(config_);
    MOTIONRACK_CHECK(rack::FaultSchedule::create(other, texts));
    fault_texts_.insert(fault_texts_.end(), texts.begin(), texts.end());
    return {};
}

Result<void> RackHandle::set_sample_period(Duration period) {
    if (period == sample_period_) return {};
    if (rack().started())
        return fail(ErrorKind::refused, fmt::format("The sampling period is {} s since the start of the rack; it "
                                                    "cannot be changed to {} s. Nothing was run.",
                                                    to_seconds(sample_period_), to_seconds(period)));
    if (period < microseconds(1) || period > whole_seconds(3600))
        return fail(ErrorKind::refused,
                    fmt::format("The sampling period is {} s; it must be 1e-6 to 3600 s. Nothing was run.",
                                to_seconds(period)));
    sample_period_ = period;
    return {};
}

Result<void> RackHandle::set_profile(const std::string& profile) {
    if (profile == config_.controller.profile) return {};
    if (profile != "trapezoid" && profile != "jerk_limited")
        return fail(ErrorKind::refused,
                    fmt::format("The profile is {}; it must be trapezoid or jerk_limited. Nothing was run.",
                                rack::in_quotes(profile)));
    if (rack().started())
        return fail(
            ErrorKind::refused,
            fmt::format("The profile is {} since the start of the rack; it cannot be changed to {}. Nothing was run.",
                        config_.controller.profile, profile));
    config_.controller.profile = profile;
    build();
    return {};
}

Result<void> RackHandle::set_card(const std::string& name, const std::string& key, double value) {
    if (rack().started())
        return fail(
            ErrorKind::refused,
            "The rack has started; its cards cannot be changed any more. Nothing was changed. Change the card of "
            "Rack.new_instance().");
    const auto card = std::find_if(config_.cards.begin(), config_.cards.end(),
                                   [&](const rack::RackCard& each) { return each.name == name; });
    if (card == config_.cards.end())
        return fail(ErrorKind::invalid_input,
                    fmt::format("The rack has no card {}. Nothing was changed.", rack::in_quotes(name)));
    const rack::CardType& type = *rack::find_card_type(card->type);
    rack::RackCard changed = *card;
    std::string known;
    for (const rack::Field& field : type.settings) {
        if (field.type != rack::FieldType::number) continue;
        known += (known.empty() ? "" : ", ") + std::string(field.key);
        if (field.key != key) continue;
        if (!(value >= field.min && value <= field.max))
            return fail(ErrorKind::refused,
                        fmt::format("{} of card {} cannot become {}; it must be {}. Nothing was changed.", key, name,
                                    value, rack::range_text(field, "")));
        field.set(type.settings_of(changed), rack::FieldValue(value), field);
        if (type.flaw != nullptr)
            if (const auto flaw = type.flaw(changed, {}))
                return fail(ErrorKind::refused, fmt::format("{} Nothing was changed.", flaw->text));
        *card = changed;
        build();
        return {};
    }
    return fail(ErrorKind::invalid_input, fmt::format("Card {} has no number {}; it has: {}. Nothing was changed.",
                                                      name, rack::in_quotes(key), known.empty() ? "none" : known));
}

}  // namespace motionrack::python
