// Gets, sets and lists quantities by name.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/quantities.hpp>
#include <motionrack/rack/toml_reader.hpp>
#include <optional>
#include <utility>

namespace motionrack::rack {

namespace {

/// Parts of "X.position_mm".
struct Name {
    std::string_view part, quantity;
    bool whole;  ///< the name contains a dot
    explicit Name(std::string_view text)
        : part(text.substr(0, text.find('.'))),
          quantity(text.substr(std::min(part.size() + 1, text.size()))),
          whole(part.size() < text.size()) {}
};

/// Returns the part or card of that name; nullptr if the rack has none.
Part* find_part(Rack& rack, const Name& name) {
    if (!name.whole) return nullptr;
    for (const auto& part : rack.parts())
        if (part->name() == name.part) return part.get();
    return nullptr;
}

tl::unexpected<Error> no_such_part(Rack& rack, std::string_view name) {
    std::vector<std::string> known;
    for (const auto& part : rack.parts())
        if (!part->is_card()) known.push_back(part->name());
    return fail(ErrorKind::invalid_input,
                fmt::format("Unknown quantity {}: write PART.QUANTITY, such as X.position_mm; the parts of "
                            "this rack are: {}. Nothing was done.",
                            in_quotes(name), known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", "))));
}

QuantityRange range_of(Part& part, const Quantity& one, Instant now) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const bool positive = one.values == ValueKind::amount || one.values == ValueKind::yes_no;
    QuantityRange out{fmt::format("{}.{}", part.name(), one.name), one.doc, unit_of_quantity(one.name),
                      positive ? 0 : -infinity, one.values == ValueKind::yes_no ? 1 : infinity};
    if (const std::optional<QuantityLimits> limits = part.limits_to_set(one.name, now)) {
        out.can_set = true;
        out.min = limits->min;
        out.max = limits->max;
    }
    return out;
}

}  // namespace

std::vector<QuantitiesOfPart> quantities_of(Rack& rack) {
    std::vector<QuantitiesOfPart> out;
    for (const auto& part : rack.parts())
        if (!part->is_card()) out.push_back({part->name(), part->quantities()});
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
    const Instant now = rack.kernel().now();
    std::vector<QuantityRange> out;
    for (const bool of_cards : {false, true})
        for (const auto& part : rack.parts()) {
            if (part->is_card() != of_cards) continue;
            for (const Quantity& one : part->quantities()) out.push_back(range_of(*part, one, now));
        }
    return out;
}

std::vector<DeclaredQuantity> declared_quantities(std::string_view kind) {
    for (const PartKind* one : part_kinds())
        if (one->name == kind && one->quantities != nullptr) return one->quantities();
    return {};
}

Result<double> get_quantity(Rack& rack, std::string_view part_dot_quantity) {
    const Name name(part_dot_quantity);
    Part* part = find_part(rack, name);
    if (part == nullptr) return no_such_part(rack, part_dot_quantity);
    if (const std::optional<double> value = part->quantity(name.quantity, rack.kernel().now())) return *value;
    return part->no_such_quantity(name.quantity);
}

Result<void> set_quantity(Rack& rack, std::string_view part_dot_quantity, double value) {
    const Name name(part_dot_quantity);
    Part* part = find_part(rack, name);
    if (part == nullptr) return no_such_part(rack, part_dot_quantity);
    MOTIONRACK_TRY(const std::string fault, part->fault_to_set(name.quantity, value, rack.kernel().now()));
    if (fault.empty()) return {};
    return inject_fault(rack, fault, part->name());
}

}  // namespace motionrack::rack
