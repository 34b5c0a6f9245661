// Accesses the registers of a card: one access per statement.
#include <fmt/format.h>

#include <motionrack/cards/grating_bus/driver/grating_card.hpp>

namespace motionrack::grating_bus {

namespace {

constexpr Field CLAIM = field("CONTROL", "CLAIM"), RELEASE = field("CONTROL", "RELEASE"),
                CLEAR_ERRORS = field("CONTROL", "CLEAR_ERRORS");
constexpr Field HOST = field("ROLE", "HOST"), CHECKS = field("ROLE", "CHECKS");
constexpr Field FRAME = field("STATUS", "FRAME"), STALE = field("STATUS", "STALE"),
                DIRECTION = field("STATUS", "DIRECTION");

}  // namespace

std::uint32_t GratingCard::read32(std::uint32_t at) {
    const std::uint32_t low = port_.read(at);
    const std::uint32_t high = port_.read(at + 2);
    return high << 16 | low;
}

Result<CardInfo> GratingCard::open() {
    const std::uint16_t answer = port_.read(offset("SIGNATURE"));
    if (answer != signature)
        return fail(ErrorKind::refused, fmt::format("The card at this address has the signature {:04X}h; a grating_bus "
                                                    "card has {:04X}h. Nothing was done. "
                                                    "Check the address.",
                                                    answer, signature));
    CardInfo info;
    const std::uint16_t role = port_.read(offset("ROLE"));
    info.host = HOST.test(role);
    info.checks = CHECKS.test(role);
    info.wrong_direction = DIRECTION.test(port_.read(offset("STATUS")));
    info.scales = port_.read(offset("SCALES"));
    if (info.scales < 1 || info.scales > max_scales)
        return fail(
            ErrorKind::refused,
            fmt::format("The card reports {} scales, but a frame has 1 to {}. Nothing was done. Check its address.",
                        info.scales, max_scales));
    info.first = port_.read(offset("FIRST"));
    info.timing.t1 = Duration{port_.read(offset("T1"))};
    info.timing.t2 = Duration{port_.read(offset("T2"))};
    info.timing.t3 = Duration{port_.read(offset("T3"))};
    info.timing.clock = Duration{port_.read(offset("CLOCK"))};
    info.period = Duration{read32(offset("PERIOD_L"))};
    for (std::size_t k = 0; k < static_cast<std::size_t>(info.scales); ++k)
        info.list[k] = static_cast<std::uint8_t>(port_.read(list_at + 2 * static_cast<std::uint32_t>(k)));
    return info;
}

Result<Reading> GratingCard::take() {
    Reading out;
    Frame& frame = out.frame;
    frame.words = port_.read(offset("WORDS"));
    if (frame.words == 0)
        return fail(
            ErrorKind::refused,
            "The card has no frame yet: no host has read one since the start. Check that the bus has a running host.");
    if (frame.words > max_scales)
        return fail(ErrorKind::refused,
                    fmt::format("The card reports a frame of {} scales, above the maximum of {}; it was not read.",
                                frame.words, max_scales));
    frame.sequence = read32(offset("SEQUENCE_L"));
    std::uint64_t time = 0;
    for (std::uint32_t i = 0; i < 4; ++i) {
        const std::uint64_t word = port_.read(offset("TIME_0") + 2 * i);
        time |= word << (16 * i);
    }
    frame.time = static_cast<std::int64_t>(time);
    frame.crc = read32(offset("CRC_L"));
    for (std::uint32_t k = 0; k < frame.words; ++k) {
        frame.counts[k] = read32(counts_at + 4 * k);
        frame.addresses[k] = static_cast<std::uint8_t>(port_.read(addresses_at + 2 * k));
    }
    if (!sound(frame))
        return fail(
            ErrorKind::refused,
            fmt::format("Frame {} has the CRC {:08X}h, but its content gives {:08X}h; its positions were not used.",
                        frame.sequence, frame.crc, crc_of(frame)));
    for (std::uint32_t k = 0; k < frame.words; ++k) {
        std::int64_t& before = before_[frame.addresses[k]];
        before = out.positions[k] = unwrapped(before, frame.counts[k]);
    }
    addresses_ = frame.addresses;
    words_ = frame.words;
    return out;
}

Result<Reading> GratingCard::read() {
    port_.write(offset("CONTROL"), CLAIM.mask);
    Result<Reading> out = take();
    port_.write(offset("CONTROL"), RELEASE.mask);
    if (out && stale())
        return fail(ErrorKind::refused, fmt::format("Frame {} of {:.7f} s is older than two periods: the positions are "
                                                    "stale and must not be used. Check the bus' host.",
                                                    out->frame.sequence, to_seconds(out->frame.instant())));
    return out;
}

Result<Reading> GratingCard::wait(Duration timeout) {
    const Instant end = later(interrupt_.now(), timeout);
    while (!FRAME.test(port_.read(offset("STATUS")))) {
        const Duration left = end - interrupt_.now();
        if (interrupt_.stop_requested())
            return fail(
                ErrorKind::stopped,
                "The wait for a frame was stopped by the user; no frame was read. The card keeps reading frames.");
        if (left <= Duration{0})
            return fail(ErrorKind::refused,
                        fmt::format("No frame came within {} us. Check that the bus has a host and that it runs.",
                                    to_seconds(timeout) * 1e6));
        interrupt_.wait(left);
    }
    return read();
}

bool GratingCard::stale() {
    return STALE.test(port_.read(offset("STATUS")));
}

CardErrors GratingCard::errors() {
    CardErrors out;
    out.broken = port_.read(offset("BROKEN"));
    out.missed_words = port_.read(offset("MISSED_WORDS"));
    out.alien = port_.read(offset("ALIEN"));
    out.lines = port_.read(offset("LINES"));
    out.missed_edges = port_.read(offset("MISSED_EDGES"));
    out.overrun = port_.read(offset("OVERRUN"));
    return out;
}

void GratingCard::clear_errors() {
    port_.write(offset("CONTROL"), CLEAR_ERRORS.mask);
}

}  // namespace motionrack::grating_bus
