// Changes to driving axes, and stops.
#include <fmt/format.h>

#include <motionrack/cards/mcx314/driver/checks.hpp>
#include <motionrack/cards/mcx314/driver/curves.hpp>
#include <motionrack/cards/mcx314/driver/driver.hpp>

namespace motionrack::mcx314 {

Result<void> Driver::stop(unsigned axes, StopKind kind) {
    MOTIONRACK_CHECK(check_axes(axes, "stop"));
    command(axes, kind == StopKind::slow ? cmd::SLOW_STOP : cmd::QUICK_STOP);
    return {};
}

void Driver::stop_all(StopKind kind) {
    command(xyzu, kind == StopKind::slow ? cmd::SLOW_STOP : cmd::QUICK_STOP);
}

/// Reason why a change of a driving axis would have no effect; "" if it has one.
std::string Driver::not_changeable(int axis, MainStatus main) {
    const std::string name = axes_text(1u << axis);
    if (!main.driving(1u << axis)) return name + " stands";
    const int generator = static_cast<int>(field("WR5", "AX1").get(path_mode_));
    if (main.interpolating() && (path_axes_ >> axis & 1) && axis != (chain_.running ? chain_.generator : generator))
        return fmt::format("{} is interpolated with main axis {}", name,
                           axes_text(1u << (chain_.running ? chain_.generator : generator)));
    const DriveStatus state = axis_status(axis);
    if (state.in_s_ramp()) return name + " is in a ramp of an S-curve, and the chip takes changes only after it";
    const std::int64_t speed = ReadCV(axis), wanted = written(axis, cmd::V).value_or(0),
                       low = written(axis, cmd::SV).value_or(0);
    const bool creeps = state.constant() && speed <= low && speed < wanted;
    if ((state.decelerating() && speed <= wanted) || creeps) return name + " decelerates to its end already";
    return {};
}

Result<void> Driver::change_speed(unsigned axes, std::int64_t v) {
    MOTIONRACK_CHECK(check(axes, param::V, v));
    const MainStatus main = status();
    for (const int i : channels_of(axes)) {
        const std::string why = not_changeable(i, main);
        if (!why.empty())
            return fail(ErrorKind::refused,
                        fmt::format("change_speed: {}. The speed was not changed; SetV gives the speed of the next "
                                    "drive.",
                                    why));
    }
    put(axes, param::V, v);
    return {};
}

Result<void> Driver::change_pulses(int axis, std::int64_t pulses, Duration margin) {
    MOTIONRACK_CHECK(check_channel(axis, "change_pulses"));
    const unsigned mask = 1u << axis;
    Kept& own = kept(axis);
    MOTIONRACK_CHECK(check(mask, param::pulses, pulses));
    auto refused = [&](const std::string& why) {
        return fail(ErrorKind::refused, fmt::format("change_pulses: {}. The target was not changed.", why));
    };
    const MainStatus main = status();
    const std::string why = not_changeable(axis, main);
    if (!why.empty()) return refused(why);
    const std::string name = axes_text(mask);
    if ((main.interpolating() && (path_axes_ & mask)) || !own.from_known)
        return refused(name + " is not in a fixed drive that this library started");
    if ((pulses < 0) != own.negative)
        return refused(fmt::format(
            "{} drives in {} direction, and the chip cannot reverse; stop it and start in the other direction", name,
            own.negative ? "-" : "+"));
    const std::int64_t v = ReadCV(axis);
    const std::int64_t made = rules::magnitude(pulse_delta(own.from, ReadLPS(axis))), wanted = rules::magnitude(pulses);
    const bool manual = field("WR3", "MANLD").test(own.mode[2]);
    const std::int64_t before = written(axis, cmd::P).value_or(0), point = written(axis, cmd::DP).value_or(0);
    const std::int64_t fall =
        manual ? std::max<std::int64_t>(0, before - point)
               : fall_pulses(curve_of(axis, written_speeds(axis), 0), v) + written(axis, cmd::AO).value_or(0);
    const auto rest = static_cast<std::int64_t>(static_cast<double>(v) * multiple(axis) * to_seconds(margin)) + 1;
    if (wanted < made + fall + rest)
        return refused(
            fmt::format("{} has made {} pulses and needs {} more to decelerate, so {} is too near; the minimum is {}",
                        name, made, fall, wanted, made + fall + rest));
    if (manual) put(mask, param::DP, wanted - fall);
    put(mask, param::pulses, wanted);
    return {};
}

}  // namespace motionrack::mcx314
