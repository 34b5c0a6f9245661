// Fields as Markdown rows.
#include <fmt/format.h>

#include <motionrack/rack/fields_table.hpp>

namespace motionrack::rack {
namespace {

/// Returns "lead_mm", or "max_velocity_mm_s / max_velocity_deg_s" for a key of both kinds of axis.
std::string both_units(std::string_view text, std::string_view only, std::string_view quote) {
    const auto one = [&](std::string_view unit) { return fmt::format("{}{}{}", quote, with_unit(text, unit), quote); };
    if (text.find("{u}") == std::string_view::npos || !only.empty()) return one(only);
    return one("mm") + " / " + one("deg");
}

std::string defaults_text(const Field& field, const void* linear, const void* rotary) {
    const std::string first = default_text(field, field.only == "deg" ? rotary : linear);
    const std::string second = default_text(field, field.only == "mm" ? linear : rotary);
    return first == second ? first : first + " / " + second;
}

}  // namespace

std::string fields_table(std::span<const Field> fields, const void* linear, const void* rotary) {
    std::string out = "| key | unit | range | default | meaning |\n|---|---|---|---|---|\n";
    for (const Field& field : fields) {
        Field without_unit = field;
        without_unit.unit = {};
        out += fmt::format("| {} | {} | {} | {} | {} |\n", both_units(field.key, field.only, "`"),
                           field.unit.empty() ? "-" : both_units(field.unit, field.only, ""),
                           range_text(without_unit, ""), defaults_text(field, linear, rotary), field.doc);
    }
    return out + '\n';
}

}  // namespace motionrack::rack
