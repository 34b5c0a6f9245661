// Reads and writes the registers of the processor's interface.
#include <initializer_list>
#include <motionrack/cards/grating_bus/model/bus.hpp>
#include <motionrack/cards/grating_bus/model/card.hpp>
#include <utility>

namespace motionrack::grating_bus {

namespace {

constexpr Field CLAIM = field("CONTROL", "CLAIM"), RELEASE = field("CONTROL", "RELEASE"),
                CLEAR = field("CONTROL", "CLEAR_ERRORS"), RESET = field("CONTROL", "RESET");
constexpr Field HOST = field("ROLE", "HOST"), CLOCK_OUT = field("ROLE", "CLOCK_OUT"),
                ADDRESS_OUT = field("ROLE", "ADDRESS_OUT"), CHECKS = field("ROLE", "CHECKS");
constexpr Field FRAME = field("STATUS", "FRAME"), CLAIMED = field("STATUS", "CLAIMED"),
                STALE = field("STATUS", "STALE"), DIRECTION = field("STATUS", "DIRECTION"),
                BUSY = field("STATUS", "BUSY"), OFF = field("STATUS", "OFF");
constexpr Field STATE = field("STATE", "STATE"), WORD = field("STATE", "WORD");
static_assert((offset("OVERRUN") - offset("BROKEN")) / 2 + 1 == Card::counter_count,
              "ErrorCounter has the registers' order");

/// Returns a register word in which the given flags are set or clear.
std::uint16_t flags(std::initializer_list<std::pair<Field, bool>> all) {
    std::uint16_t out = 0;
    for (const auto& [flag, set] : all) out = flag.set(out, set ? 1 : 0);
    return out;
}

constexpr std::uint16_t low(std::uint64_t value, int word = 0) {
    return static_cast<std::uint16_t>(value >> (16 * word));
}

constexpr std::uint16_t ticks(Duration d) {
    return static_cast<std::uint16_t>(d.count());
}

constexpr bool is_count(std::uint32_t at) {
    return at >= counts_at && at < counts_at + 4 * max_scales && at % 2 == 0;
}

/// Returns true if the offset belongs to an address of the list that begins at the offset `begin`.
constexpr bool is_address(std::uint32_t at, std::uint32_t begin) {
    return at >= begin && at < begin + 2 * max_scales && at % 2 == 0;
}

std::uint16_t frame_word(const Frame& frame, std::uint32_t at) {
    if (is_count(at)) {
        const std::uint32_t k = (at - counts_at) / 4;
        return k < frame.words ? low(frame.counts[k], at % 4 / 2) : std::uint16_t{0};
    }
    if (is_address(at, addresses_at)) {
        const std::uint32_t k = (at - addresses_at) / 2;
        return k < frame.words ? frame.addresses[k] : std::uint16_t{0};
    }
    switch (at) {
        case offset("SEQUENCE_L"):
            return low(frame.sequence);
        case offset("SEQUENCE_H"):
            return low(frame.sequence, 1);
        case offset("TIME_0"):
            return low(static_cast<std::uint64_t>(frame.time));
        case offset("TIME_1"):
            return low(static_cast<std::uint64_t>(frame.time), 1);
        case offset("TIME_2"):
            return low(static_cast<std::uint64_t>(frame.time), 2);
        case offset("TIME_3"):
            return low(static_cast<std::uint64_t>(frame.time), 3);
        case offset("WORDS"):
            return low(frame.words);
        case offset("CRC_L"):
            return low(frame.crc);
        case offset("CRC_H"):
            return low(frame.crc, 1);
        default:
            return 0;
    }
}

}  // namespace

std::uint16_t Card::peek(std::uint32_t at) const {
    static constexpr Frame nothing{};
    if (is_count(at) || is_address(at, addresses_at) ||
        (at >= offset("SEQUENCE_L") && at <= offset("CRC_H") && at % 2 == 0)) {
        const Frame* held = frames_.held();
        return frame_word(held ? *held : nothing, at);
    }
    if (at >= offset("BROKEN") && at <= offset("OVERRUN") && at % 2 == 0) return errors_[(at - offset("BROKEN")) / 2];
    const CardSettings& s = settings_;
    if (is_address(at, list_at)) {
        const int k = static_cast<int>(at - list_at) / 2;
        return static_cast<std::uint16_t>(k < s.scales ? s.address(k) : 0);
    }
    const Moment m = moment();
    switch (at) {
        case offset("SIGNATURE"):
            return signature;
        case offset("ROLE"):
            return flags({{HOST, is_host()},
                          {CLOCK_OUT, s.clock_out()},
                          {ADDRESS_OUT, s.address_out()},
                          {CHECKS, s.verify_lines}});
        case offset("STATUS"):
            return flags({{FRAME, wires_.fresh()},
                          {CLAIMED, frames_.held() != nullptr},
                          {STALE, stale()},
                          {DIRECTION, s.wrong_direction()},
                          {BUSY, m.state != State::S0},
                          {OFF, off()}});
        case offset("STATE"):
            return WORD.set(STATE.set(0, static_cast<unsigned>(m.state)), static_cast<unsigned>(m.word));
        case offset("SCALES"):
            return static_cast<std::uint16_t>(s.scales);
        case offset("FIRST"):
            return static_cast<std::uint16_t>(s.address(0));
        case offset("T1"):
            return ticks(s.timing.t1);
        case offset("T2"):
            return ticks(s.timing.t2);
        case offset("T3"):
            return ticks(s.timing.t3);
        case offset("CLOCK"):
            return ticks(s.timing.clock);
        case offset("PERIOD_L"):
            return low(static_cast<std::uint64_t>(s.period.count()));
        case offset("PERIOD_H"):
            return low(static_cast<std::uint64_t>(s.period.count()), 1);
        case offset("FRAMES_L"):
            return low(frames());
        case offset("FRAMES_H"):
            return low(frames(), 1);
        default:
            return 0xFFFF;
    }
}

std::uint16_t Card::read(std::uint32_t at) {
    bool known = is_count(at) || is_address(at, addresses_at) || is_address(at, list_at);
    for (const RegisterInfo& reg : map::registers) known = known || (reg.access == Access::read && reg.offset == at);
    if (!known) errors_.report(BusCondition::no_register, at, -1);
    return peek(at);
}

void Card::write(std::uint32_t at, std::uint16_t value) {
    if (at != offset("CONTROL")) return errors_.report(BusCondition::no_register, at, value);
    if (CLAIM.test(value) || RELEASE.test(value)) bus_.leave_frame(kernel_.now());
    if (CLAIM.test(value)) {
        frames_.claim();
        wires_.set_fresh(false);
    }
    if (RELEASE.test(value)) frames_.release();
    if (CLEAR.test(value)) errors_.clear();
    if (!RESET.test(value) || off()) return;
    bus_.interrupt_span(kernel_.now());
    reset();
    bus_.look_again(kernel_.now());
}

}  // namespace motionrack::grating_bus
