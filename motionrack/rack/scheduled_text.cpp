// Parses scheduled texts.
#include <limits>
#include <motionrack/base/numbers.hpp>
#include <motionrack/rack/scheduled_text.hpp>

namespace motionrack::rack {

namespace {

/// Converts "0.5s", "20ms", "1e3us" to seconds; NaN if invalid.
double seconds(std::string_view text) {
    struct Unit {
        std::string_view name;
        double size;
    };
    for (const Unit unit : {Unit{"ms", 1e-3}, Unit{"us", 1e-6}, Unit{"s", 1.0}})
        if (text.size() > unit.name.size() && text.substr(text.size() - unit.name.size()) == unit.name)
            return number_of(text.substr(0, text.size() - unit.name.size())) * unit.size;
    return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::optional<ScheduledText> read_timed_text(std::string_view text) {
    const std::size_t at = text.rfind('@');
    if (at == std::string_view::npos) return std::nullopt;
    const double time = seconds(text.substr(at + 1));
    if (!(time >= 0 && time <= max_planned_seconds)) return std::nullopt;
    return ScheduledText{from_seconds(time), std::string(text.substr(0, at)), std::string(text)};
}

}  // namespace motionrack::rack
