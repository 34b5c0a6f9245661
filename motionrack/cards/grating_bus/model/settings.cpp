// Ranges of the settings, and what does not fit together.
#include <fmt/format.h>

#include <motionrack/cards/grating_bus/model/settings.hpp>

namespace motionrack::grating_bus {

namespace {

double ns(Duration d) {
    return static_cast<double>(d.count()) * 0.1;
}

Result<void> within(const char* name, Duration value, Duration least, Duration most) {
    if (value >= least && value <= most) return {};
    return fail(Trouble::refused,
                fmt::format("{} is {:.1f} ns, but it is {:.1f} to {:.1f} ns.", name, ns(value), ns(least), ns(most)));
}

Result<void> within(const char* name, int value, int least, int most) {
    if (value >= least && value <= most) return {};
    return fail(Trouble::refused, fmt::format("{} is {}, but it is {} to {}.", name, value, least, most));
}

constexpr Duration least_wait{1}, most_wait = microseconds(6);

}  // namespace

Result<void> check(const CardSettings& s) {
    MOTIONRACK_CHECK(within("The number of scales", s.scales, 1, most_scales));
    MOTIONRACK_CHECK(within("The address of the first scale", s.first, 0, most_scales - s.scales));
    MOTIONRACK_CHECK(within("T1", s.timing.t1, least_wait, most_wait));
    MOTIONRACK_CHECK(within("T2", s.timing.t2, least_wait, most_wait));
    MOTIONRACK_CHECK(within("T3", s.timing.t3, least_wait, most_wait));
    MOTIONRACK_CHECK(within("The logic's clock period", s.timing.clock, least_wait, most_wait));
    MOTIONRACK_CHECK(within("The period of the frames", s.period, microseconds(1), milliseconds(100)));
    MOTIONRACK_CHECK(within("The offset of the first pulse", s.offset, Duration{0}, s.period));
    const Duration frame = s.timing.frame_time(s.scales);
    if (frame < s.period) return {};
    return fail(Trouble::refused,
                fmt::format("A frame of {} scales takes {:.1f} ns ({} x (T1 {:.1f} + T2 {:.1f} + T3 {:.1f}) + {} x "
                            "{:.1f} ns), which does not fit "
                            "into its period of {:.1f} ns. Read fewer scales, wait less or take a longer period.",
                            s.scales, ns(frame), s.scales, ns(s.timing.t1), ns(s.timing.t2), ns(s.timing.t3),
                            3 * s.scales + 1, ns(s.timing.clock), ns(s.period)));
}

Result<void> check(const DecoderSettings& s) {
    MOTIONRACK_CHECK(within("The number of scales", s.scales, 1, most_scales));
    MOTIONRACK_CHECK(within("The time of the latch", s.latch, Duration{0}, most_wait));
    return within("The time to valid data", s.output, least_wait, most_wait);
}

Result<void> check(const CardSettings& card, const DecoderSettings& decoder) {
    if (card.first + card.scales > decoder.scales)
        return fail(Trouble::refused,
                    fmt::format("The card reads the scales {} to {}, but the decoder has {} (0 to {}).", card.first,
                                card.first + card.scales - 1, decoder.scales, decoder.scales - 1));
    if (decoder.latch > card.timing.t1)
        return fail(Trouble::refused,
                    fmt::format("The decoder needs {:.1f} ns to latch, but the card waits T1 = {:.1f} ns only.",
                                ns(decoder.latch), ns(card.timing.t1)));
    if (decoder.output >= card.timing.t2)
        return fail(
            Trouble::refused,
            fmt::format(
                "The decoder needs {:.1f} ns to put data out, but the card takes them after T2 = {:.1f} ns; T2 must "
                "be longer.",
                ns(decoder.output), ns(card.timing.t2)));
    return {};
}

}  // namespace motionrack::grating_bus
