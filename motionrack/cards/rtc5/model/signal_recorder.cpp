// Computes the values of signals, records and sends them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <motionrack/cards/rtc5/model/signal_recorder.hpp>

namespace motionrack::rtc5 {

namespace {

std::int32_t whole(double v) {
    return static_cast<std::int32_t>(std::nearbyint(std::clamp(v, -2147483648.0, 2147483647.0)));
}

}  // namespace

void SignalRecorder::begin(const Command& c, std::int64_t tick) {
    Recording& r = recording_;
    r.period = static_cast<std::int64_t>(c.p[0]);
    if (r.period == 0) return;
    r.channels = c.op == Op::set_trigger ? 2 : record_channels;
    r.first = tick;
    r.count = 0;
    r.signals = {static_cast<std::int64_t>(c.p[1]), static_cast<std::int64_t>(c.p[2])};
    if (c.op == Op::set_trigger4) r.signals[2] = static_cast<std::int64_t>(c.p[3]), r.signals[3] = c.head;
}

std::int64_t SignalRecorder::ticks_to_sample() const {
    const Recording& r = recording_;
    if (r.period == 0 || !card_.lists.running || card_.lists.paused) return std::numeric_limits<std::int64_t>::max();
    const std::int64_t over = (card_.tick - r.first) % r.period;
    return over == 0 ? 0 : r.period - over;
}

void SignalRecorder::record() {
    Recording& r = recording_;
    std::int32_t* const to = &samples_[static_cast<std::size_t>(r.count * r.channels)];
    for (std::size_t i = 0; i < static_cast<std::size_t>(r.channels); ++i) to[i] = value_of(*signal_info(r.signals[i]));
    if (++r.count == record_values / r.channels) r.period = 0;
}

std::int32_t SignalRecorder::value_of(const SignalInfo& s) const {
    if (s.laser_only && !card_.laser.on) return whole(min_field);
    const Head& head = heads_.head(s.head);
    const bool no_head = s.head == 1 && head.table == 0;
    Point p = card_.output.corrected;
    switch (s.source) {
        case SignalSource::laser:
            return card_.laser.on != 0;
        case SignalSource::corrected:
            return whole(s.axis == 0 ? p.x : p.y);
        case SignalSource::z:
            return whole(card_.output.z);
        case SignalSource::transformed:
        case SignalSource::table: {
            if (no_head) return 0;
            if (!head.transform.neutral) kernels::transform(&p.x, &p.y, 1, head.transform);
            if (s.source == SignalSource::transformed) return whole(s.axis == 0 ? p.x : p.y);
            std::array<std::int32_t, 2> out{};
            kernels::head(&p.x, &p.y, &out[0], &out[1], 1, heads_.table(head.table), {1, 1}, {0, 0});
            return out[s.axis];
        }
        case SignalSource::output:
            return (s.head == 0 ? card_.output.a : card_.output.b)[s.axis];
        case SignalSource::io:
            return static_cast<std::int32_t>(card_.io);
        case SignalSource::count:
            return card_.encoders.counters[s.head].count();
        case SignalSource::mark_speed:
            return whole(card_.path.mark_speed);
    }
    return 0;
}

Result<std::int32_t> SignalRecorder::value(std::uint32_t signal) const {
    if (const SignalInfo* const info = signal_info(signal)) return value_of(*info);
    return fail(ErrorKind::refused,
                fmt::format("get_value: the card has no signal of the number {}; nothing was read", signal));
}

Result<void> SignalRecorder::send(std::span<const std::uint32_t> signals) {
    Sender sender{static_cast<std::int64_t>(signals.size()), card_.tick};
    if (signals.size() > sender.signals.size())
        return fail(ErrorKind::refused,
                    fmt::format("set_mcbsp_out: {} signals were given; the limit is {}; nothing was changed",
                                signals.size(), sender.signals.size()));
    for (std::size_t i = 0; i < signals.size(); ++i) {
        if (signal_info(signals[i]) == nullptr)
            return fail(
                ErrorKind::refused,
                fmt::format("set_mcbsp_out: the card has no signal of the number {}; nothing was changed", signals[i]));
        sender.signals[i] = signals[i];
    }
    sender_ = sender;
    return {};
}

std::int32_t SignalRecorder::sent() const {
    const Sender& s = sender_;
    const std::int64_t ticks = card_.tick - s.first;
    if (s.count == 0 || ticks == 0) return 0;
    return value_of(*signal_info(s.signals[static_cast<std::size_t>((ticks - 1) % s.count)]));
}

void SignalRecorder::copy_samples(const SignalRecorder& other) {
    const auto count = static_cast<std::size_t>(recording_.count * recording_.channels);
    std::ranges::copy(other.samples_.span().first(count), samples_.span().begin());
}

}  // namespace motionrack::rtc5
