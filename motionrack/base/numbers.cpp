// Conversion of text to number, independent of the locale.
#include <charconv>
#include <limits>
#include <motionrack/base/numbers.hpp>

namespace motionrack {

double number_of(std::string_view text) {
    double value = 0;
    const auto [end, bad] = std::from_chars(text.data(), text.data() + text.size(), value);
    return bad == std::errc() && end == text.data() + text.size() ? value : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace motionrack
