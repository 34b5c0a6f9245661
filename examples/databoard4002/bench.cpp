#include "bench.hpp"

namespace howto {

namespace {

parts::DcMotorSettings motor_with(double load) {
    parts::DcMotorSettings settings;
    settings.load_inertia_ratio = load;
    return settings;
}

}  // namespace

Bench::Bench(double load, Duration pass)
    : motor_(kernel_, "motor", motor_with(load)),
      card_(kernel_, "c", {.firmware_pass_ticks = static_cast<std::int32_t>(pass / nanoseconds(2'500))}),
      port_(kernel_, bus_, bus_.id(), bus_.interrupt_wire(), nanoseconds(250)),
      driver_(port_, port_, {.select = 13, .counts_per_mm = counts_per_mm}) {
    card_.connect_encoder(motor_);
    bus_.plug(card_, 13);
    junctions_.join(kernel_.find_wire("c.vout"), motor_.drive_wire());
    kernel_.start();
}

void Bench::record() {
    from_ = kernel_.now();
    record_ = {};
    write_down();
    port_.on_slice(milliseconds(1), [this] { write_down(); });
}

void Bench::write_down() {
    const Instant now = kernel_.now();
    record_.seconds.push_back(to_seconds(now - from_));
    record_.mm.push_back(static_cast<float>(motor_.position(now) / counts_per_mm));
    record_.mm_s.push_back(static_cast<float>(motor_.rate(now) / counts_per_mm));
}

}  // namespace howto
