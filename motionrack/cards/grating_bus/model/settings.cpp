// Checks the ranges and the consistency of settings.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <motionrack/cards/grating_bus/model/settings.hpp>

namespace motionrack::grating_bus {

namespace {

double ns(Duration d) {
    return static_cast<double>(d.count()) * 0.1;
}

Result<void> within(const char* name, Duration value, Duration min, Duration max) {
    if (value >= min && value <= max) return {};
    return fail(ErrorKind::refused,
                fmt::format("{} is {:.1f} ns; it must be {:.1f} to {:.1f} ns.", name, ns(value), ns(min), ns(max)));
}

Result<void> within(const char* name, int value, int min, int max) {
    if (value >= min && value <= max) return {};
    return fail(ErrorKind::refused, fmt::format("{} is {}; it must be {} to {}.", name, value, min, max));
}

constexpr Duration min_wait{1}, max_wait = microseconds(6);

/// Checks that each address is in range and unique.
Result<void> check_list(const std::vector<int>& addresses) {
    if (addresses.size() > max_scales)
        return fail(ErrorKind::invalid_input, fmt::format("The list has {} addresses, more than the {} of a frame.",
                                                          addresses.size(), max_scales));
    for (auto at = addresses.begin(); at != addresses.end(); ++at) {
        if (*at < 0 || *at >= max_scales)
            return fail(
                ErrorKind::invalid_input,
                fmt::format("Address {} of the list is out of range; it must be 0 to {}.", *at, max_scales - 1));
        if (std::find(addresses.begin(), at, *at) != at)
            return fail(ErrorKind::invalid_input,
                        fmt::format("The list has the address {} twice; a frame reads each scale once.", *at));
    }
    return {};
}

/// Returns the scales of a card as a phrase: "the scales 0 to 3".
std::string scales_text(const CardSettings& card) {
    if (!card.addresses.empty()) return fmt::format("the scales {}", fmt::join(card.addresses, ", "));
    return fmt::format("the scales {} to {}", card.first, card.first + card.scales - 1);
}

}  // namespace

bool CardSettings::same_list(const CardSettings& other) const {
    if (scales != other.scales) return false;
    for (int k = 0; k < scales; ++k)
        if (address(k) != other.address(k)) return false;
    return true;
}

int CardSettings::last_address() const {
    return addresses.empty() ? first + scales - 1 : *std::max_element(addresses.begin(), addresses.end());
}

Result<std::vector<int>> addresses_from_text(std::string_view text) {
    std::vector<int> out;
    const char *at = text.data(), *const end = at + text.size();
    const auto skip_blanks = [&] {
        while (at != end && *at == ' ') ++at;
    };
    for (;;) {
        skip_blanks();
        int address = -1;
        const auto [behind, bad] = std::from_chars(at, end, address);
        if (bad != std::errc())
            return fail(ErrorKind::invalid_input,
                        fmt::format("Character {} of the list begins no whole number; a list is like "
                                    "\"5, 2, 9\".",
                                    at - text.data() + 1));
        out.push_back(address);
        at = behind;
        skip_blanks();
        if (at == end) break;
        if (*at != ',')
            return fail(
                ErrorKind::invalid_input,
                fmt::format("Character {} of the list must be a comma, as in \"5, 2, 9\".", at - text.data() + 1));
        ++at;
    }
    MOTIONRACK_CHECK(check_list(out));
    return out;
}

Result<void> check(const CardSettings& s) {
    MOTIONRACK_CHECK(within("The number of scales", s.scales, 1, max_scales));
    if (s.addresses.empty()) {
        MOTIONRACK_CHECK(within("The address of the first scale", s.first, 0, max_scales - s.scales));
    } else if (s.addresses.size() != static_cast<std::size_t>(s.scales)) {
        return fail(ErrorKind::refused,
                    fmt::format("The list has {} addresses, but a frame has {} scales.", s.addresses.size(), s.scales));
    }
    MOTIONRACK_CHECK(check_list(s.addresses));
    MOTIONRACK_CHECK(within("T1", s.timing.t1, min_wait, max_wait));
    MOTIONRACK_CHECK(within("T2", s.timing.t2, min_wait, max_wait));
    MOTIONRACK_CHECK(within("T3", s.timing.t3, min_wait, max_wait));
    MOTIONRACK_CHECK(within("The logic's clock period", s.timing.clock, min_wait, max_wait));
    MOTIONRACK_CHECK(within("The period of the frames", s.period, microseconds(1), milliseconds(100)));
    MOTIONRACK_CHECK(within("The offset of the first pulse", s.offset, Duration{0}, s.period));
    const Duration frame = s.timing.frame_time(s.scales);
    if (frame < s.period) return {};
    return fail(ErrorKind::refused,
                fmt::format("A frame of {} scales takes {:.1f} ns ({} x (T1 {:.1f} + T2 {:.1f} + T3 {:.1f}) + {} x "
                            "{:.1f} ns), which does not fit "
                            "into its period of {:.1f} ns. Read fewer scales, wait less or take a longer period.",
                            s.scales, ns(frame), s.scales, ns(s.timing.t1), ns(s.timing.t2), ns(s.timing.t3),
                            3 * s.scales + 1, ns(s.timing.clock), ns(s.period)));
}

Result<void> check(const DecoderSettings& s) {
    MOTIONRACK_CHECK(within("The number of scales", s.scales, 1, max_scales));
    MOTIONRACK_CHECK(within("The time of the latch", s.latch, Duration{0}, max_wait));
    return within("The time to valid data", s.output, min_wait, max_wait);
}

Result<void> check(const CardSettings& card, const DecoderSettings& decoder) {
    if (card.last_address() >= decoder.scales)
        return fail(ErrorKind::refused, fmt::format("The card reads {}, but the decoder has {} (0 to {}).",
                                                    scales_text(card), decoder.scales, decoder.scales - 1));
    if (decoder.latch > card.timing.t1)
        return fail(ErrorKind::refused,
                    fmt::format("The decoder needs {:.1f} ns to latch, but the card waits T1 = {:.1f} ns only.",
                                ns(decoder.latch), ns(card.timing.t1)));
    if (decoder.output >= card.timing.t2)
        return fail(
            ErrorKind::refused,
            fmt::format(
                "The decoder needs {:.1f} ns to output data, but the card latches them after T2 = {:.1f} ns; T2 must "
                "be longer.",
                ns(decoder.output), ns(card.timing.t2)));
    return {};
}

}  // namespace motionrack::grating_bus
