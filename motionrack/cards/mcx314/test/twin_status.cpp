// The twin's register reads and its output pins.
#include <motionrack/cards/mcx314/test/twin.hpp>
#include <utility>

namespace motionrack::mcx314::twin {

int Twin::selected() const {
    int a = 0;
    while (a < axis_count - 1 && !(selected_ >> a & 1)) ++a;
    return a;
}

std::uint16_t Twin::read(std::uint32_t offset) {
    const std::uint16_t value = peek(offset);
    if (offset == 6) axes_[selected()].flags = 0;
    return value;
}

std::uint8_t Twin::read_byte(std::uint32_t port) {
    const std::uint16_t value = peek(port & ~1u);
    if (port == 6) axes_[selected()].flags &= 0xFF00;
    if (port == 7) axes_[selected()].flags &= 0x00FF;
    return static_cast<std::uint8_t>(port & 1 ? value >> 8 : value);
}

std::uint16_t Twin::peek(std::uint32_t offset) const {
    switch (offset) {
        case 0:
            return main_status();
        case 2:
            return status1(selected());
        case 4:
            return status2(selected());
        case 6:
            return axes_[selected()].flags;
        case 8:
            return static_cast<std::uint16_t>(levels(0) | levels(1) << 8);
        case 10:
            return static_cast<std::uint16_t>(levels(2) | levels(3) << 8);
        case 12:
            return rr6_;
        case 14:
            return rr7_;
        default:
            return 0;
    }
}

bool Twin::busy(int a) const {
    const Axis& axis = axes_[a];
    const bool out_of_position = bit(axis.wr2, 15) && axis.level(Pin::in_position) != bit(axis.wr2, 14);
    return driving(a) || (axis.waits_position && out_of_position);
}

std::uint16_t Twin::main_status() const {
    unsigned v = 0;
    for (int a = 0; a < axis_count; ++a) {
        if (busy(a)) v |= 1u << a;
        if ((status2(a) & 0xBF) != 0 || (axes_[a].finished & 0xF000) != 0) v |= 1u << (4 + a);
    }
    if (chain_ != 0) {
        v |= 1u << 8;
        if (!queued_ && !path_.is_pattern()) v |= 1u << 9;
        v |= static_cast<unsigned>(path_.zone()) << 10;
    }
    v |= static_cast<unsigned>(pattern_.counter()) << 13;
    return static_cast<std::uint16_t>(v);
}

std::uint16_t Twin::status1(int a) const {
    const Axis& axis = axes_[a];
    const Generator& gen = axis.gen;
    const std::int32_t counter = bit(axis.wr2, 5) ? axis.ep : axis.lp;
    unsigned v = axis.finished;
    if (counter >= axis.comp_plus) v |= 1u << 0;
    if (counter < axis.comp_minus) v |= 1u << 1;
    if (gen.kind != Generator::Kind::idle) {
        v |= gen.ramp > 0 ? 1u << 2 : gen.ramp < 0 ? 1u << 4 : 1u << 3;
        if (gen.s_curve && gen.ramp != 0) v |= 1u << (5 + static_cast<int>(gen.phase));
    }
    return static_cast<std::uint16_t>(v);
}

std::uint16_t Twin::status2(int a) const {
    const Axis& axis = axes_[a];
    unsigned v = 0;
    if (beyond_software_limit(axis)) v |= axis.direction > 0 ? 1u << 0 : 1u << 1;
    if (axis.level(Pin::limit_plus) == bit(axis.wr2, 3)) v |= 1u << 2;
    if (axis.level(Pin::limit_minus) == bit(axis.wr2, 4)) v |= 1u << 3;
    if (bit(axis.wr2, 13) && axis.level(Pin::alarm) == bit(axis.wr2, 12)) v |= 1u << 4;
    if (!emergency_level()) v |= 1u << 5;
    if (axis.as.error) v |= 1u << 7;
    v |= static_cast<unsigned>(axis.as.hmst) << 8;
    return static_cast<std::uint16_t>(v);
}

// Returns the eight input levels of one axis, as in RR4 and RR5.
std::uint16_t Twin::levels(int a) const {
    unsigned v = 0;
    for (int i = 0; i < 8; ++i) v |= static_cast<unsigned>(axes_[a].level(static_cast<Pin>(i))) << i;
    return static_cast<std::uint16_t>(v);
}

// ---- output pins

// Returns the levels of nPP, nPM, nOUT4..7, nOUT0..3 and nDRIVE of an axis.
unsigned Twin::outputs(int a, bool pulse) const {
    const Axis& axis = axes_[a];
    const bool negative = bit(axis.wr2, 7);
    bool pp = pulse && axis.pulse_direction > 0, pm = pulse && axis.pulse_direction < 0;
    if (bit(axis.wr2, 6)) {
        pp = pulse != negative;
        pm = (axis.direction > 0) == bit(axis.wr2, 8);
    } else {
        pp = pp != negative;
        pm = pm != negative;
    }
    if (axis.as.em6 & 0x04) std::swap(pp, pm);
    unsigned v = (pp ? 1u : 0u) | (pm ? 2u : 0u) | (drive_output(a) ? 0x400u : 0u);
    const unsigned status = status1(a);
    const unsigned shown = bit(axis.wr3, 7) ? (status & 7u) | (status >> 1 & 8u) : axis.wr3 >> 8 & 15u;
    v |= shown << 2;
    v |= (wr4_ >> (4 * a) & 15u) << 6;
    return v;
}

}  // namespace motionrack::mcx314::twin
