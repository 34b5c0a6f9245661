// Timing of the breaks.
#include <python/src/run_breaker.hpp>
#include <utility>

namespace motionrack::python {

RunBreaker::RunBreaker(sim::Kernel& kernel) : kernel_(kernel) {
    id_ = kernel_.add(*this, sim::Phase::observers, "bell");
    for (std::size_t i = 0; i < kernel_.wire_count(); ++i)
        kernel_.listen(static_cast<sim::WireId>(i), id_, static_cast<int>(i));
}

void RunBreaker::begin() {
    for (std::size_t i = 0; i < kernel_.wire_count(); ++i) kernel_.subscribe(static_cast<sim::WireId>(i), id_, false);
}

void RunBreaker::break_every(Duration period) {
    period_ = period;
    rung_ = kernel_.now();
    kernel_.schedule(id_, later(kernel_.now(), period_));
}

void RunBreaker::ring_no_more() {
    period_ = Duration{};
    rung_ = never;
    kernel_.schedule(id_, never);
}

Instant RunBreaker::take_break() {
    return std::exchange(rung_, never);
}

void RunBreaker::break_on_wire(sim::WireId wire, int level) {
    wire_ = wire;
    level_ = level;
    heard_ = kernel_.level(wire) == level;
    kernel_.subscribe(wire, id_, true);
}

void RunBreaker::listen_no_more() {
    if (wire_ != sim::WireId::none) kernel_.subscribe(wire_, id_, false);
    wire_ = sim::WireId::none;
}

void RunBreaker::on_scheduled(Instant now) {
    if (period_ == Duration{}) return;  // in a copy of a rack with periodic breaks
    rung_ = now;
    kernel_.schedule(id_, later(now, period_));
    kernel_.break_run();
}

void RunBreaker::on_wire(int pin, int level, Instant) {
    if (static_cast<sim::WireId>(pin) != wire_ || level != level_) return;
    heard_ = true;
    kernel_.break_run();
}

}  // namespace motionrack::python
