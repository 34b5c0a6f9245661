// Rare cases of a G-code number: blanks inside, more digits than a double holds, errors.
#include <fast_float/fast_float.h>

#include <cmath>
#include <motionrack/control/gcode/number.hpp>
#include <string>

namespace motionrack::control::gcode {

namespace {

const char* without_blanks(const char* p, const char* end) {
    while (p < end && is_blank(*p)) ++p;
    return p;
}

/// Returns the correctly rounded value of digits with at most one point.
double round_correctly(const std::string& digits) {
    double value = 0;
    fast_float::from_chars(digits.data(), digits.data() + digits.size(), value);
    return value;
}

}  // namespace

Number scan_number_slow(const char*& at, const char* end) {
    Number number;
    const char* p = without_blanks(at, end);
    const bool negative = p < end && *p == '-';
    if (p < end && (*p == '-' || *p == '+')) ++p;
    std::string digits;
    bool point = false;
    int count = 0;
    std::uint64_t mantissa = 0;
    for (p = without_blanks(p, end); p < end && (is_digit(*p) || *p == '.'); p = without_blanks(p + 1, end)) {
        if (*p == '.') {
            if (point) {
                number.fault = NumberFault::two_points;
                return number;
            }
            if (count == 0) digits += '0';
            point = true;
        } else {
            ++count;
            if (point) ++number.decimals;
            if (count <= 18) mantissa = mantissa * 10 + static_cast<unsigned>(*p - '0');
        }
        digits += *p;
    }
    if (count == 0) {
        number.fault = NumberFault::no_digits;
        return number;
    }
    if (digits.back() == '.') digits.pop_back();
    number.exact = count <= 18;
    if (number.exact) number.mantissa = static_cast<std::int64_t>(negative ? 0 - mantissa : mantissa);
    const double value = round_correctly(digits);
    if (!(value <= largest_number)) number.fault = NumberFault::too_large;
    number.value = negative ? -value : value;
    at = p;
    return number;
}

}  // namespace motionrack::control::gcode
