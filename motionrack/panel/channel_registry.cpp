// Lists channels and reads the subscribed ones.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <motionrack/panel/channel_registry.hpp>
#include <motionrack/rack/quantities.hpp>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::panel {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Returns "mm" for "position_mm", "deg/s" for "speed_deg_s": the end of a quantity's name.
std::string_view unit_of(std::string_view name) {
    static constexpr std::pair<std::string_view, std::string_view> endings[] = {
        {"_mm_s", "mm/s"}, {"_deg_s", "deg/s"}, {"_mm", "mm"}, {"_deg", "deg"}, {"_nm", "nm"},
        {"_us", "us"},     {"_v", "V"},         {"_hz", "Hz"}, {"_j", "J"}};
    for (const auto& [ending, unit] : endings)
        if (name.size() > ending.size() && name.substr(name.size() - ending.size()) == ending) return unit;
    return "";
}

}  // namespace

std::string_view name_of(ChannelReader reader) {
    switch (reader) {
        case ChannelReader::edges:
            return "edges";
        case ChannelReader::anytime:
            return "anytime";
        case ChannelReader::slices:
            return "slices";
    }
    return "";
}

std::string_view card_part(std::string_view name) {
    return name.substr(0, name.find('.'));
}

std::vector<std::string> register_names(const rack::CardType& type, const RegisterInfo& reg) {
    if (!reg.per_axis) return {std::string(reg.name)};
    std::vector<std::string> out;
    for (int channel = 0; channel < type.channel_count(); ++channel)
        out.push_back(fmt::format("{}.{}", type.channel_name(channel), reg.name));
    return out;
}

ChannelRegistry::ChannelRegistry(operate::Machine& machine) : service_(machine.service()) {
    add_axes(machine);
    add_wires(machine);  // before the quantities: the wire wins if a switch has the same name
    add_quantities(machine.rack());
    add_cards(machine.rack());
}

void ChannelRegistry::add(std::string name, std::string_view unit, std::string_view text, ChannelReader reader,
                          std::function<double()> read) {
    if (service_.live_place(card_part(name)) != nullptr) return;
    std::string key = name;
    channels_.try_emplace(std::move(key),
                          LiveChannel{std::move(name), std::string(unit), std::string(text), reader, std::move(read)});
}

void ChannelRegistry::add_axes(operate::Machine& machine) {
    using operate::AxisStatus;
    struct Shown {
        std::string_view name, unit, text;
        double (*get)(const AxisStatus&);
    };
    static constexpr Shown shown[] = {
        {"commanded", "{u}", "position by the card's pulses", [](const AxisStatus& axis) { return axis.commanded; }},
        {"actual", "{u}", "position by the encoder; commanded without an encoder",
         [](const AxisStatus& axis) { return axis.actual; }},
        {"error", "{u}", "commanded - actual", [](const AxisStatus& axis) { return axis.commanded - axis.actual; }},
        {"velocity", "{u}/s", "of the rotor, signed", [](const AxisStatus& axis) { return axis.velocity; }},
    };
    const auto& axes = machine.rack().axes();
    for (std::size_t i = 0; i < axes.size(); ++i)
        for (const Shown& one : shown)
            add(fmt::format("{}.{}", axes[i].config.letter, one.name), rack::with_unit(one.unit, axes[i].config.unit()),
                one.text, ChannelReader::slices, [&machine, i, get = one.get] {
                    return i < machine.status().axes.size() ? get(machine.status().axes[i]) : unknown;
                });
}

void ChannelRegistry::add_quantities(rack::Rack& rack) {
    const sim::Kernel& kernel = rack.kernel();
    for (rack::QuantitiesOfPart& of : rack::quantities_of(rack))
        for (rack::Quantity& one : of.quantities)
            add(of.part + "." + one.name, unit_of(one.name), one.doc, ChannelReader::anytime,
                [&kernel, get = std::move(one.get)] { return get(kernel.now()); });
}

void ChannelRegistry::add_wires(operate::Machine& machine) {
    rack::WireAccess& wires = machine.wires();
    for (const rack::WireAccess::Named& wire : wires.names()) {
        const std::string name(wire.name);
        const ChannelReader reader = wire.volts || !wire.recorded ? ChannelReader::anytime : ChannelReader::edges;
        add(name, wire.volts ? "V" : "", wire.volts ? "voltage of a wire" : "level of a wire", reader,
            [&wires, name] { return wires.get(name).value_or(unknown); });
    }
}

void ChannelRegistry::add_cards(rack::Rack& rack) {
    for (const auto& card : rack.cards()) {
        const auto inspected = [&](const std::string& name, std::string_view text) {
            add(card->name() + "." + name, "", text, ChannelReader::slices, [&one = *card, name] {
                const Result<std::int64_t> value = one.inspect(name);
                return value ? static_cast<double>(*value) : unknown;
            });
        };
        for (const std::string_view name : card->quantity_names())
            add(fmt::format("{}.{}", card->name(), name), unit_of(name), "a numeric quantity of the card",
                ChannelReader::slices, [&one = *card, name] { return one.quantity(name).value_or(unknown); });
        for (const std::string& name : card->value_names()) inspected(name, "a register value of the card by its name");
        const rack::CardType& type = *rack::find_card_type(rack.config().card(card->name())->type);
        for (const RegisterInfo& reg : card->map().registers) {
            if (reg.access == Access::write) continue;
            for (const std::string& name : register_names(type, reg))
                if (card->inspect(name)) inspected(name, reg.meaning);
        }
    }
}

const LiveChannel* ChannelRegistry::find(std::string_view name) const {
    const auto found = channels_.find(name);
    return found == channels_.end() ? nullptr : &found->second;
}

Result<std::shared_ptr<ChannelSet>> ChannelRegistry::set_of(const std::vector<std::string>& names) {
    if (names.size() > Panel::max_channels)
        return fail(ErrorKind::invalid_input,
                    fmt::format("{} channels were requested; the limit is {}. Nothing was changed.", names.size(),
                                Panel::max_channels));
    ListedSet held;
    for (const std::string& name : names) {
        const LiveChannel* channel = find(name);
        if (channel == nullptr)
            return fail(ErrorKind::invalid_input,
                        fmt::format("Unknown channel {}; the query channels lists all channels. Nothing was changed.",
                                    rack::in_quotes(name)));
        held.channels.push_back(channel);
    }
    ListedSet& known = sets_[names];
    if (auto set = known.set.lock()) return set;
    auto set = std::make_shared<ChannelSet>(names);
    held.set = set;
    known = std::move(held);
    return set;
}

void ChannelRegistry::show(std::int64_t sequence, Instant at) {
    for (auto it = sets_.begin(); it != sets_.end();) {
        const auto set = it->second.set.lock();
        if (!set) {
            it = sets_.erase(it);
            continue;
        }
        auto values = std::make_shared<Values>();
        values->sequence = sequence;
        values->at = at;
        values->numbers.reserve(it->second.channels.size());
        for (const LiveChannel* channel : it->second.channels) values->numbers.push_back(channel->read());
        set->show(std::move(values));
        ++it;
    }
}

}  // namespace motionrack::panel
