// Conversion of lines to blocks of ticks.
#include <algorithm>
#include <motionrack/sim/parts/scan_head.hpp>

namespace motionrack::parts {

namespace {

constexpr Duration tick_time = microseconds(10), half_us = nanoseconds(500);
/// Time after the last change of a line until the mirrors are stationary and no laser edge is pending: 0.3 s.
constexpr std::int64_t settled = 30'000;
enum Pin : int { x, y, laser };

}  // namespace

ScanHead::ScanHead(sim::Kernel& kernel, const std::string& name, const ScanHeadWires& wires, MarkingStation station)
    : kernel_(kernel), wires_(wires), station_(std::move(station)), id_(kernel.add(*this, sim::Phase::parts, name)) {
    const auto states = station_.states();
    for (std::size_t i = 0; i < held_.size(); ++i) {
        held_[i].bytes = states[i].bytes;
        kernel.add(held_[i], sim::Phase::parts, name + "." + states[i].name);
    }
    station_.workpiece().reserve();
    kernel.listen(wires.x, id_, x);
    kernel.listen(wires.y, id_, y);
    kernel.listen(wires.laser, id_, laser);
}

void ScanHead::begin() {
    for (const sim::WireId wire : {wires_.x, wires_.y}) kernel_.subscribe(wire, id_, true);
}

void ScanHead::on_wire(int pin, int level, Instant now) {
    work_off(now);
    state_.changed = now / tick_time;
    if (pin == laser) {
        state_.gate = level != 0;
        station_.laser(now / half_us, level != 0);
    } else {
        state_.bits[static_cast<std::size_t>(pin)] = level;
    }
}

/// Processes the elapsed ticks.
void ScanHead::work_off(Instant now) {
    State& s = state_;
    const std::int64_t end = now / tick_time;
    const std::int64_t rests = std::max(s.changed + settled, s.next);
    while (s.next < end) {
        if (s.next >= rests && station_.dark(end)) {
            s.next = end;
            return;
        }
        const std::int64_t stop = s.next < rests ? std::min(end, rests) : end;
        const auto n = static_cast<std::size_t>(std::min(stop - s.next, static_cast<std::int64_t>(x_.size())));
        std::fill_n(x_.begin(), n, static_cast<std::int32_t>(s.bits[0]));
        std::fill_n(y_.begin(), n, static_cast<std::int32_t>(s.bits[1]));
        station_.block(s.next, {x_.data(), n}, {y_.data(), n});
        s.next += static_cast<std::int64_t>(n);
    }
}

}  // namespace motionrack::parts
