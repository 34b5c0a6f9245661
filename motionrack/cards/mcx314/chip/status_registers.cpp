// The registers RR0 .. RR7 as the bus shows them.
#include <motionrack/cards/mcx314/chip/status_registers.hpp>
#include <motionrack/cards/mcx314/map.hpp>

namespace motionrack::mcx314 {

std::uint16_t StatusRegisters::value(std::uint32_t offset) const {
    switch (offset) {
        case reg::RR0:
            return main_status();
        case reg::RR1:
            return status1(state_.first_selected());
        case reg::RR2:
            return status2(state_.first_selected());
        case reg::RR3:
            return state_.axis[state_.first_selected()].flags;
        case reg::RR4:
            return static_cast<std::uint16_t>(inputs_.input_levels(0) | inputs_.input_levels(1) << 8);
        case reg::RR5:
            return static_cast<std::uint16_t>(inputs_.input_levels(2) | inputs_.input_levels(3) << 8);
        case reg::RR6:
            return state_.bus.rr6;
        case reg::RR7:
            return state_.bus.rr7;
        default:
            return 0;
    }
}

std::uint16_t StatusRegisters::main_status() const {
    unsigned busy_axes = 0, wrong_axes = 0;
    for (int a = 0; a < axes_of_chip; ++a) {
        if (state_.busy(a)) busy_axes |= 1u << a;
        if (rr2::errors.test(status2(a)) || rr1::errors.test(state_.axis[a].finished)) wrong_axes |= 1u << a;
    }
    unsigned v = rr0::ERR.set(rr0::DRV.set(0, busy_axes), wrong_axes);
    if (state_.chain != 0) {
        const rules::Arc& arc = state_.path.arc;
        v |= rr0::IDRV.mask;
        if (!state_.queued && !state_.path.command.pattern()) v |= rr0::CNEXT.mask;
        if (state_.path.command.arc())
            v = rr0::ZONE.set(v, static_cast<unsigned>(arc.clockwise ? 7 - arc.octant : arc.octant));
    }
    return rr0::BPSC.set(v, static_cast<unsigned>(state_.pattern.stacked));
}

std::uint16_t StatusRegisters::status1(int a) const {
    const Axis& axis = state_.axis[a];
    const Generator& gen = axis.gen;
    const std::int32_t counter = comparators_.compared_counter(a);
    unsigned v = axis.finished;
    if (counter >= axis.comp_plus) v |= rr1::CMPP.mask;
    if (counter < axis.comp_minus) v |= rr1::CMPM.mask;
    if (gen.drive != Drive::idle) {
        v |= gen.ramp > 0 ? rr1::ASND.mask : gen.ramp < 0 ? rr1::DSND.mask : rr1::CNST.mask;
        if (gen.s_curve && gen.ramp != 0) v |= unsigned{rr1::AASND.mask} << static_cast<int>(gen.phase);
    }
    return static_cast<std::uint16_t>(v);
}

std::uint16_t StatusRegisters::status2(int a) const {
    const Axis& axis = state_.axis[a];
    unsigned v = 0;
    if (comparators_.beyond_software_limit(a)) v |= axis.direction > 0 ? rr2::SLMTP.mask : rr2::SLMTM.mask;
    if (limit_active(axis, +1)) v |= rr2::HLMTP.mask;
    if (limit_active(axis, -1)) v |= rr2::HLMTM.mask;
    if (alarm_active(axis)) v |= rr2::ALARM.mask;
    if (!state_.emergency_high) v |= rr2::EMG.mask;
    const HomingSequence& home = state_.extension[a].home;
    if (home.error) v |= rr2::HOME.mask;
    return rr2::HMST.set(v, static_cast<unsigned>(home.hmst));
}

}  // namespace motionrack::mcx314
