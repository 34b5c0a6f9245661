// Ranges of the settings.
#include <fmt/format.h>

#include <motionrack/cards/databoard4002/model/settings.hpp>

namespace motionrack::databoard4002 {

Result<void> check(const Settings& s) {
    if (s.firmware_pass_ticks < 1 || s.firmware_pass_ticks > 4'000)
        return fail(
            ErrorKind::refused,
            fmt::format("A pass of the firmware is {} ticks of 2.5 us; it must be 1 to 4,000.", s.firmware_pass_ticks));
    if (s.byte_time < nanoseconds(2'500) || s.byte_time > milliseconds(100))
        return fail(ErrorKind::refused,
                    fmt::format("The firmware takes {} ns for a byte; it must be 2,500 to 100,000,000 ns.",
                                s.byte_time.count() / 10));
    const int max_pair = s.folding == sim::Edges::all ? 0 : s.folding == sim::Edges::both_of_a ? 1 : 3;
    if (s.first_pair < 0 || s.first_pair > max_pair)
        return fail(ErrorKind::refused, fmt::format("The first strap pair is {}; with folding {} it must be 0 to {}.",
                                                    s.first_pair, static_cast<int>(s.folding), max_pair));
    if (!sound(s.trim))
        return fail(ErrorKind::refused,
                    "The trim table must have 1 to 64 rows whose voltages (up to 10 V) and rates (up to 16,383) rise.");
    return {};
}

}  // namespace motionrack::databoard4002
