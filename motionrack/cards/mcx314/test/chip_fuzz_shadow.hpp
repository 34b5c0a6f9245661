// Knowledge of a host about the chip from its own writes alone, and the possible effects of each write.
#pragma once

#include <array>
#include <cstdint>

namespace motionrack::mcx314::fuzz {

/// Possible effects of one write; masks of axes unless stated otherwise.
struct Effect {
    unsigned axes = 0;        ///< axes selected by the command
    unsigned stops = 0;       ///< the command is 26h or 27h, or RESET
    unsigned writes_p = 0;    ///< the command is 06h, or RESET
    unsigned writes_lp = 0;   ///< the command is 09h, RESET, or one after which LP may change without pulses
    int fixed_direction = 0;  ///< +1 for 20h, -1 for 21h
    bool begins = false;      ///< a command that may begin a drive
};

class Shadow {
  public:
    explicit Shadow(bool extended = false) : extended_(extended) {}

    std::array<std::int64_t, 4> pulses{};                         ///< P as written
    unsigned software_limits = 0, in_position = 0, external = 0;  ///< axes with these enabled at present
    unsigned acts = 0;                                            ///< axes with synchronous actions
    unsigned recounted = 0;  ///< axes whose LP may change without pulses, because of rings or PCLR
    unsigned unknown = 0;    ///< axes whose P synchronous actions may have written

    Effect write(std::uint32_t offset, std::uint16_t value, std::uint16_t mask) {
        auto put = [&](std::uint16_t& word) { word = static_cast<std::uint16_t>((word & ~mask) | (value & mask)); };
        if (offset == 0) return command(value);
        if (patterns_ && offset >= 4) return {};
        if (offset == 12) put(wr6_);
        if (offset == 14) put(wr7_);
        for (unsigned a = 0; a < 4; ++a) {
            if (!(selected_ >> a & 1u)) continue;
            if (offset == 4) put(wr2_[a]);
            if (offset == 6) put(wr3_[a]);
            software_limits = with(software_limits, a, (wr2_[a] & 3u) != 0);
            in_position = with(in_position, a, (wr2_[a] & 0x8000u) != 0);
            external = with(external, a, (wr3_[a] & 0x0018u) != 0);
        }
        return {};
    }
    Effect write_byte(std::uint32_t port, std::uint8_t value) {
        if (port == 1) return wr0_high_ = value, Effect{};
        if (port == 0) return command(static_cast<std::uint16_t>(wr0_high_ << 8 | value));
        const bool high = (port & 1u) != 0;
        return write(port & ~1u, static_cast<std::uint16_t>(high ? value << 8 : value), high ? 0xFF00 : 0x00FF);
    }

  private:
    static unsigned with(unsigned mask, unsigned a, bool set) { return (mask & ~(1u << a)) | (set ? 1u << a : 0u); }

    Effect command(std::uint16_t value) {
        Effect effect;
        if ((value & 0x8000u) != 0) {
            *this = Shadow{extended_};
            effect.stops = effect.writes_lp = effect.writes_p = 15;
            return effect;
        }
        const unsigned code = value & 0xFFu;
        effect.axes = value >> 8 & 15u;
        if (effect.axes != 0) selected_ = effect.axes;
        if (code == 0x36 || code == 0x37) patterns_ = code == 0x36;
        if (code == 0x06) effect.writes_p = effect.axes;
        if (code == 0x09) effect.writes_lp = effect.axes;
        if (code == 0x26 || code == 0x27) effect.stops = effect.axes;
        if (code == 0x20 || code == 0x21) effect.fixed_direction = code == 0x20 ? 1 : -1;
        effect.begins = (code >= 0x20 && code <= 0x25) || (code >= 0x30 && code <= 0x35);
        if (extended_) extended_command(code, effect);
        const std::int64_t written = std::int64_t{wr7_} << 16 | wr6_;
        for (unsigned a = 0; a < 4; ++a)
            if (effect.writes_p >> a & 1u) pulses[a] = extended_ ? written : written & 0x0FFF'FFFF;
        return effect;
    }
    void extended_command(unsigned code, Effect& effect) {
        if (code == 0x62) effect.begins = true;
        if (code == 0x60 || code == 0x64 || code == 0x0B) effect.writes_lp = 15;  // rings, actions of this instant
        for (unsigned a = 0; a < 4; ++a) {
            if (!(effect.axes >> a & 1u)) continue;
            if (code == 0x60) recounted = with(recounted, a, (wr6_ & 0x0010u) != 0 || (wr7_ & 0x0100u) != 0);
            if (code == 0x64) acts = with(acts, a, (wr6_ | wr7_) != 0);
        }
        unknown = acts != 0 ? 15u : unknown & ~effect.writes_p;
    }

    bool extended_ = false;
    unsigned selected_ = 1;
    bool patterns_ = false;
    std::uint8_t wr0_high_ = 0;
    std::uint16_t wr6_ = 0, wr7_ = 0;
    std::array<std::uint16_t, 4> wr2_{}, wr3_{};
};

}  // namespace motionrack::mcx314::fuzz
