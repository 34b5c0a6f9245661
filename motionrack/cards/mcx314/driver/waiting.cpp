// Polling of the axes, and waits; every wait has a time-out.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/cards/mcx314/driver/checks.hpp>
#include <motionrack/cards/mcx314/driver/driver.hpp>

namespace motionrack::mcx314 {

namespace {

constexpr Duration default_poll_period = microseconds(100);

}  // namespace

MainStatus Driver::status() {
    return {port_.read(reg::RR0)};
}

DriveStatus Driver::axis_status(int axis) {
    MOTIONRACK_ASSERT(axis >= 0 && axis < 4);
    command(1u << axis, cmd::NOP);
    DriveStatus status;
    status.rr1 = port_.read(reg::RR1);
    status.rr2 = port_.read(reg::RR2);
    return status;
}

AxisReport Driver::report(int axis) {
    AxisReport report;
    report.axis = axis;
    report.driving = moving(1u << axis);
    report.lp = ReadLPS(axis);
    report.ep = ReadEPS(axis);
    report.cv = ReadCV(axis);
    report.status = axis_status(axis);
    return report;
}

std::string Driver::error_text(unsigned axes) {
    std::string out;
    for (const int i : channels_of(axes)) {
        if (axis_status(i).why_stopped().empty()) continue;
        if (!out.empty()) out += ' ';
        out += report(i).text();
    }
    return out;
}

// ---- waiting

/// Waits for the interrupt line, at most `slice`. Reads the interrupts of `axes` so that the line becomes inactive;
/// time also passes if the line is active for other axes.
void Driver::doze(unsigned axes, Duration slice) {
    const Instant before = interrupt_.now();
    const bool woken = interrupt_.wait(slice);
    bool ours = false;
    if (woken)
        for (const int i : channels_of(axes)) ours = fetch_interrupts(i) || ours;
    if (!ours && (woken || interrupt_.now() == before)) interrupt_.pass(slice);
}

Result<void> Driver::wait_until_stopped(unsigned axes, Duration timeout) {
    MOTIONRACK_CHECK(check_axes(axes, "wait_until_stopped"));
    const Instant end = later(interrupt_.now(), timeout);
    bool stopped = false;
    while (status().driving(axes)) {
        if (!stopped && interrupt_.stop_requested()) {
            SlowStop(axes);
            stopped = true;
        }
        if (interrupt_.now() >= end)
            return fail(
                ErrorKind::machine,
                fmt::format("{} still moves after {:.3f} s; {}. Wait longer, or stop the axes.", axes_text(axes),
                            to_seconds(timeout), stopped ? "a stop was commanded" : "nothing was stopped"));
        // The drive-end interrupt, if enabled, wakes at once; otherwise the status is polled.
        doze(axes, default_poll_period);
    }
    if (stopped) return fail(ErrorKind::stopped, fmt::format("Stopped on request; {} stands still.", axes_text(axes)));
    return {};
}

Result<void> Driver::wait_until_done(unsigned axes, Duration timeout) {
    MOTIONRACK_CHECK(wait_until_stopped(axes, timeout));
    const std::string why = error_text(axes);
    if (why.empty()) return {};
    return fail(ErrorKind::machine, why);
}

// ---- speeds

/// Share of the basic pulses that step each axis of a segment, signed, at the present position of the axes.
std::array<double, 4> Driver::shares(const Piece& piece) {
    std::array<double, 4> out = {};
    const ChannelList list = channels_of(piece.axes);
    if (!piece.arc) {
        const auto max_finish = static_cast<double>(std::max<std::int64_t>(1, basic_pulses(piece)));
        for (const int i : channels_of(piece.axes)) out[i] = static_cast<double>(piece.finish[i]) / max_finish;
        return out;
    }
    // On a circle the velocity of an axis is proportional to the other's distance from the centre; the axis nearer to
    // it steps every time.
    const auto h = static_cast<std::size_t>(list.channel[0]), v = static_cast<std::size_t>(list.channel[1]);
    auto from_centre = [&](std::size_t i) {
        const std::int64_t moved = pulse_delta(static_cast<std::int32_t>(piece.from[i]), ReadLPS(static_cast<int>(i)));
        return static_cast<double>(moved - piece.centre[i]);
    };
    const double x = from_centre(h), y = from_centre(v);
    const double max_offset = std::max({std::fabs(x), std::fabs(y), 1.0}), turn = piece.clockwise ? -1 : 1;
    out[h] = -turn * y / max_offset;
    out[v] = turn * x / max_offset;
    return out;
}

Result<std::array<double, 4>> Driver::axis_speeds() {
    const MainStatus main = status();
    std::array<double, 4> out = {};
    const unsigned path = main.interpolating() ? path_axes_ : 0;
    if (path != 0) {
        const Piece& piece = main.can_queue() ? pieces_[1] : pieces_[0];
        if (piece.axes == 0)
            return fail(ErrorKind::refused,
                        "axis_speeds: the shares of the axes are not known: a bit pattern runs, the interpolation was "
                        "started by "
                        "bare commands, or LPS moved a counter since. Nothing was read.");
        const int generator = chain_.running ? chain_.generator : channels_of(piece.axes).channel[0];
        const std::int64_t basic = ReadCV(generator);
        const std::array<double, 4> share = shares(piece);
        const double rate =
            static_cast<double>(basic) * static_cast<double>(rules::sclk_hz) / mean_range(piece, generator, share);
        for (std::size_t i = 0; i < 4; ++i) out[i] = share[i] * rate;
    }
    for (int i = 0; i < 4; ++i) {
        if ((path >> i & 1) || !main.driving(1u << i)) continue;
        out[static_cast<std::size_t>(i)] = ReadCV(i) * multiple(i) * (kept(i).negative ? -1 : 1);
    }
    return out;
}

/// Returns the mean R over many basic pulses: with constant vector speed it is longer for pulses that step more than
/// one axis.
double Driver::mean_range(const Piece& piece, int generator, const std::array<double, 4>& share) const {
    const ChannelList list = channels_of(piece.axes);
    const auto own = static_cast<double>(kept(generator).own_range);
    const int vector_axes = std::min(piece.vector_axes, list.count);
    if (vector_axes < 2) return own;
    std::array<double, 3> parts = {};
    for (int n = 0; n < list.count; ++n)
        parts[static_cast<std::size_t>(n)] =
            std::fabs(share[static_cast<std::size_t>(list.channel[static_cast<std::size_t>(n)])]);
    std::sort(parts.begin(), parts.end(), std::greater<>());
    const auto two = static_cast<double>(written(list.channel[1], cmd::R).value_or(0));
    const auto three = vector_axes == 3 ? static_cast<double>(written(list.channel[2], cmd::R).value_or(0)) : two;
    return own * (1 - parts[1]) + two * (parts[1] - parts[2]) + three * parts[2];
}

}  // namespace motionrack::mcx314
