// Gets, sets and lists quantities by name.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/quantities.hpp>
#include <motionrack/rack/quantity_tables.hpp>
#include <motionrack/rack/toml_reader.hpp>
#include <optional>
#include <span>
#include <utility>

namespace motionrack::rack {

namespace {

using namespace quantity_tables;

// ---- differences between the kinds of part

std::span<const QuantityRow<RunningAxis>> rows_of(const RunningAxis&) {
    return axis_quantities;
}
std::span<const QuantityRow<RunningStage>> rows_of(const RunningStage&) {
    return stage_quantities;
}
std::span<const QuantityRow<RunningConveyor>> rows_of(const RunningConveyor&) {
    return track_quantities;
}
std::span<const QuantityRow<RunningScanner>> rows_of(const RunningScanner&) {
    return scanner_quantities;
}

std::string name_of(const RunningAxis& axis) {
    return std::string(1, axis.config.letter);
}
template <class Part>
std::string name_of(const Part& part) {
    return part.config.name;
}

std::string_view unit_of(const RunningAxis& axis) {
    return axis.config.unit();
}
std::string_view unit_of(const RunningConveyor& track) {
    return track.config.unit();
}
template <class Part>
std::string_view unit_of(const Part&) {
    return {};
}

std::string said_of(const RunningAxis& axis) {
    return "Axis " + name_of(axis);
}
std::string said_of(const RunningStage& stage) {
    return "Stage " + name_of(stage);
}
template <class Part>
std::string said_of(const Part& part) {
    return name_of(part);
}

// ---- iteration over parts

template <class Visitor>
void each_part(Rack& rack, const Visitor& reported) {
    for (RunningAxis& axis : rack.axes()) reported(axis);
    for (RunningStage& stage : rack.stages()) reported(stage);
    for (RunningConveyor& track : rack.tracks()) reported(track);
    for (RunningScanner& scanner : rack.scanners()) reported(scanner);
}

/// Lists the quantities of this part, with names in its own unit.
template <class Part, class Visitor>
void each_quantity(const Part& part, const Visitor& reported) {
    for (const QuantityRow<Part>& row : rows_of(part))
        if (row.present == nullptr || row.present(part)) reported(with_unit(row.name, unit_of(part)), row);
}

template <class Part>
Result<const QuantityRow<Part>*> find_row(const Part& part, std::string_view name) {
    const QuantityRow<Part>* found = nullptr;
    std::vector<std::string> known;
    each_quantity(part, [&](std::string its_name, const QuantityRow<Part>& row) {
        if (its_name == name) found = &row;
        known.push_back(std::move(its_name));
    });
    if (found != nullptr) return found;
    return fail(ErrorKind::invalid_input, fmt::format("{} has no quantity {}; it has: {}. Nothing was done.",
                                                      said_of(part), in_quotes(name), fmt::join(known, ", ")));
}

template <class Part>
Result<double> value_of(Part& part, std::string_view name, Instant now) {
    MOTIONRACK_TRY(const QuantityRow<Part>* row, find_row(part, name));
    return row->get(part, now);
}

/// Parts of "X.position_mm".
struct Name {
    std::string_view part, quantity;
    bool whole;  ///< the name contains a dot
    explicit Name(std::string_view text)
        : part(text.substr(0, text.find('.'))),
          quantity(text.substr(std::min(part.size() + 1, text.size()))),
          whole(part.size() < text.size()) {}
};

tl::unexpected<Error> no_such_part(Rack& rack, std::string_view name) {
    std::vector<std::string> parts;
    each_part(rack, [&](const auto& part) { parts.push_back(name_of(part)); });
    return fail(ErrorKind::invalid_input,
                fmt::format("Unknown quantity {}: write PART.QUANTITY, such as X.position_mm; the parts of "
                            "this rack are: {}. Nothing was done.",
                            in_quotes(name), parts.empty() ? "none" : fmt::format("{}", fmt::join(parts, ", "))));
}

Result<double> quantity_of_card(const Card& card, std::string_view name) {
    if (const std::optional<double> value = card.quantity(name)) return *value;
    const auto known = card.quantity_names();
    return fail(ErrorKind::invalid_input,
                fmt::format("Card {} has no quantity {}{}. Nothing was done.", card.name(), in_quotes(name),
                            known.empty() ? "" : fmt::format("; it has: {}", fmt::join(known, ", "))));
}

// ---- setting

Result<void> set_track_quantity(Rack& rack, const RunningConveyor& track, std::string_view name, double value) {
    const std::string velocity = with_unit(track_velocity, track.config.unit());
    if (name != velocity)
        return fail(ErrorKind::refused, fmt::format("Of {} only {} can be set, not {}. Nothing was done.",
                                                    track.config.name, velocity, in_quotes(name)));
    const double max_velocity = track.config.max_velocity();
    if (!(std::fabs(value) <= max_velocity))
        return fail(ErrorKind::refused,
                    fmt::format("{}.{} cannot become {}: {:.6g} to {:.6g} are possible. Nothing was done.",
                                track.config.name, velocity, value, -max_velocity, max_velocity));
    return inject_fault(rack, fmt::format("drive.speed={:.17g}", value), track.config.name);
}

/// `name`: the complete name.
Result<void> push_axis(Rack& rack, RunningAxis& axis, std::string_view name, double value) {
    MOTIONRACK_TRY(const QuantityRow<RunningAxis>* row, find_row(axis, Name(name).quantity));
    if (row->push == nullptr)
        return fail(
            ErrorKind::refused,
            fmt::format("{} follows from the machine and cannot be set; set the position. Nothing was done.", name));
    if (!std::isfinite(value))
        return fail(ErrorKind::refused,
                    fmt::format("{} cannot become {}: that is not a number. Nothing was done.", name, value));
    parts::AxisMechanics& machine = *axis.machine;
    const double push = row->push(axis, value, rack.kernel().now());
    if (!(std::fabs(push) <= max_push))
        return fail(ErrorKind::refused,
                    fmt::format("To bring {} to {} the motor must be pushed by {:.0f} microsteps; the limit is {:.0f}. "
                                "Nothing was done.",
                                name, value, push, max_push));
    // A rotor in step springs back unless it is pushed past the middle of an electrical cycle.
    const double min_push =
        machine.in_step() && !axis.servo ? 2.0 * static_cast<double>(machine.settings().motor.microsteps) : 0.5;
    if (std::fabs(push) < min_push) return {};
    return inject_fault(rack, fmt::format("motor.push={:.0f}", push), name_of(axis));
}

/// Returns the range that a push can reach, symmetrical to both sides.
template <class Part>
void bound_by_push(QuantityRange& out, const QuantityRow<Part>& row, Part& part, Instant now) {
    const double here = row.get(part, now), microsteps = row.push(part, here + 1, now);
    const double farthest = std::fabs(max_push / microsteps);
    out.can_set = true;
    out.min = here - farthest;
    out.max = here + farthest;
}

}  // namespace

std::vector<QuantitiesOfPart> quantities_of(Rack& rack) {
    std::vector<QuantitiesOfPart> out;
    each_part(rack, [&](auto& part) {
        QuantitiesOfPart& of = out.emplace_back();
        of.part = name_of(part);
        each_quantity(part, [&](std::string name, const auto& row) {
            of.quantities.push_back({std::move(name), row.doc, row.values != measures,
                                     [&part, get = row.get](Instant now) { return get(part, now); }});
        });
    });
    return out;
}

std::string_view unit_of_quantity(std::string_view name) {
    constexpr std::pair<std::string_view, std::string_view> endings[] = {
        {"_mm_s", "mm/s"},     {"_deg_s", "deg/s"}, {"_bits_ms", "bits/ms"}, {"_counts_ms", "counts/ms"},
        {"_mm", "mm"},         {"_deg", "deg"},     {"_nm", "nm"},           {"_us", "us"},
        {"_v", "V"},           {"_j", "J"},         {"_hz", "Hz"},           {"_bits", "bits"},
        {"_counts", "counts"}, {"pulses", "pulses"}};
    for (const auto& [ending, unit] : endings)
        if (name.ends_with(ending)) return unit;
    return {};
}

std::vector<QuantityRange> quantity_ranges(Rack& rack) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Instant now = rack.kernel().now();
    std::vector<QuantityRange> out;
    const auto add = [&](const std::string& part, std::string_view name, std::string_view doc, ValueKind values) {
        const double min = values == amount || values == yes_no ? 0 : -infinity;
        out.push_back(
            {fmt::format("{}.{}", part, name), doc, unit_of_quantity(name), min, values == yes_no ? 1 : infinity});
    };
    each_part(rack, [&](auto& part) {
        each_quantity(part, [&](const std::string& name, const auto& row) {
            add(name_of(part), name, row.doc, row.values);
            if (row.push != nullptr) bound_by_push(out.back(), row, part, now);
        });
    });
    for (const RunningConveyor& track : rack.tracks())
        for (QuantityRange& one : out)
            if (one.name == fmt::format("{}.{}", track.config.name, with_unit(track_velocity, track.config.unit()))) {
                one.can_set = true;
                one.max = track.config.max_velocity();
                one.min = -one.max;
            }
    for (const auto& card : rack.cards())
        for (const std::string_view name : card->quantity_names())
            add(card->name(), name, card->quantity_doc(name), measures);
    return out;
}

std::vector<std::pair<std::string_view, std::string_view>> declared_quantities(PartKind kind) {
    std::vector<std::pair<std::string_view, std::string_view>> out;
    const auto add = [&out](const auto& table) {
        for (const auto& row : table) out.emplace_back(row.name, row.doc);
    };
    switch (kind) {
        case PartKind::axis:
            add(axis_quantities);
            break;
        case PartKind::stage:
            add(stage_quantities);
            break;
        case PartKind::track:
            add(track_quantities);
            break;
        case PartKind::scanner:
            add(scanner_quantities);
            break;
    }
    return out;
}

Result<double> get_quantity(Rack& rack, std::string_view part_dot_quantity) {
    const Name name(part_dot_quantity);
    std::optional<Result<double>> out;
    if (const Card* card = rack.card(name.part); card != nullptr && name.whole)
        return quantity_of_card(*card, name.quantity);
    each_part(rack, [&](auto& part) {
        if (!out && name.whole && name_of(part) == name.part) out = value_of(part, name.quantity, rack.kernel().now());
    });
    if (!out) return no_such_part(rack, part_dot_quantity);
    return *std::move(out);
}

Result<void> set_quantity(Rack& rack, std::string_view part_dot_quantity, double value) {
    const Name name(part_dot_quantity);
    if (const RunningConveyor* track = rack.track(name.part); track != nullptr && name.whole)
        return set_track_quantity(rack, *track, name.quantity, value);
    for (RunningAxis& axis : rack.axes())
        if (name.whole && name_of(axis) == name.part) return push_axis(rack, axis, part_dot_quantity, value);
    MOTIONRACK_CHECK(get_quantity(rack, part_dot_quantity));  // no other quantity can be set
    return fail(ErrorKind::refused, fmt::format("{} follows from the machine and cannot be set; of axes the position "
                                                "can, of belts and tables the velocity. Nothing was done.",
                                                part_dot_quantity));
}

}  // namespace motionrack::rack
