// Default answers of parts without settable quantities or conditions.
#include <fmt/format.h>

#include <motionrack/rack/part.hpp>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::rack {

std::optional<QuantityLimits> Part::limits_to_set(std::string_view, Instant) {
    return std::nullopt;
}

Result<std::string> Part::fault_to_set(std::string_view quantity_name, double, Instant now) {
    if (!quantity(quantity_name, now)) return no_such_quantity(quantity_name);
    return fail(ErrorKind::refused, fmt::format("{} follows from the machine and cannot be set; of axes the position "
                                                "can, of belts and tables the velocity. Nothing was done.",
                                                full_name(quantity_name)));
}

std::optional<std::string> Part::describe(const sim::Condition&, const sim::Kernel&) const {
    return std::nullopt;
}

tl::unexpected<Error> Part::no_such_quantity(std::string_view quantity_name) {
    std::vector<std::string> known;
    for (Quantity& one : quantities()) known.push_back(std::move(one.name));
    return fail(ErrorKind::invalid_input,
                fmt::format("{} has no quantity {}{}. Nothing was done.", subject(), in_quotes(quantity_name),
                            known.empty() ? "" : fmt::format("; it has: {}", fmt::join(known, ", "))));
}

std::string Part::full_name(std::string_view quantity_name) const {
    return fmt::format("{}.{}", name(), quantity_name);
}

}  // namespace motionrack::rack
