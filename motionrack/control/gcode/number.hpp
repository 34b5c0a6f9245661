// Decimal numbers of G-code words: [+-]digits[.digits], blanks allowed between any two characters, no exponent.
#pragma once

#include <array>
#include <cstdint>

namespace motionrack::control::gcode {

/// Maximum of a number in a program: sums of a few numbers are then exact enough and never overflow.
inline constexpr double largest_number = 1e9;

enum class NumberFault : std::uint8_t { none, no_digits, two_points, too_large };

struct Number {
    double value = 0;           ///< the correctly rounded double
    std::int64_t mantissa = 0;  ///< value = mantissa / 10^decimals where `exact`
    std::int32_t decimals = 0;
    bool exact = true;  ///< false: more than 18 digits, which mantissa cannot hold
    NumberFault fault = NumberFault::none;
};

inline constexpr std::array<double, 19> powers_of_ten = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8, 1e9,
                                                         1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18};

inline bool is_digit(char c) {
    return static_cast<unsigned char>(c - '0') < 10;
}
inline bool is_blank(char c) {
    return c == ' ' || c == '\t';
}
inline char to_lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c | 0x20) : c;
}

/// Reads a number as scan_number(), but also the rare ones: blanks inside, many digits, errors.
Number scan_number_slow(const char*& at, const char* end);

/// Reads the number at `at` and moves `at` behind it and the following blanks. Up to about 15 digits need one division,
/// which rounds correctly because both operands are exact.
inline Number scan_number(const char*& at, const char* end) {
    const char* p = at;
    Number number;
    const bool negative = p < end && *p == '-';
    if (p < end && (*p == '-' || *p == '+')) ++p;
    std::uint64_t mantissa = 0;
    const char* first = p;
    while (p < end && is_digit(*p)) mantissa = mantissa * 10 + static_cast<unsigned>(*p++ - '0');
    std::ptrdiff_t count = p - first;
    if (p < end && *p == '.') {
        first = ++p;
        while (p < end && is_digit(*p)) mantissa = mantissa * 10 + static_cast<unsigned>(*p++ - '0');
        number.decimals = static_cast<std::int32_t>(p - first);
        count += number.decimals;
    }
    while (p < end && is_blank(*p)) ++p;
    const bool goes_on = p < end && (is_digit(*p) || *p == '.');
    if (count == 0 || count > 18 || goes_on || mantissa >= (std::uint64_t{1} << 53)) return scan_number_slow(at, end);
    double value = static_cast<double>(mantissa);
    if (number.decimals > 0) value /= powers_of_ten[number.decimals];
    if (value > largest_number) return scan_number_slow(at, end);
    number.value = negative ? -value : value;
    number.mantissa = negative ? -static_cast<std::int64_t>(mantissa) : static_cast<std::int64_t>(mantissa);
    at = p;
    return number;
}

}  // namespace motionrack::control::gcode
