#include "bench.hpp"

#include <fmt/format.h>

namespace howto {

namespace {

constexpr std::int64_t counts_per_turn = 4'000, fine = 4;  // the motors' own counts are four times finer
constexpr double volt = 1e5;                               // counts/s per volt

}  // namespace

Bench::Bench() : port_(kernel_, bus_, bus_.id(), bus_.interrupt_wire(), nanoseconds(250)), flex_(port_, port_) {
    bus_.plug(card_);
    const parts::DcMotorSettings motor{.gain = volt,
                                       .saturation_velocity = 1e6,
                                       .current_limit_accel = 1e7,
                                       .time_constant_s = 0.01,
                                       .coulomb_friction = 0,
                                       .dead_band_v = 0};
    for (int axis = 0; axis < axis_count; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        const std::string name = fmt::format("encoder{}", axis);
        motors_[i] = std::make_unique<parts::DcMotor>(kernel_, fmt::format("motor{}", axis), motor);
        encoders_[i] = std::make_unique<parts::LineEncoder>(
            kernel_, name, *motors_[i],
            parts::LineEncoderSettings{.counts_per_turn = counts_per_turn,
                                       .position_per_turn = fine * counts_per_turn});
        for (const char* line : {"a", "b", "z"})
            junctions_.join(kernel_.find_wire(fmt::format("{}.{}", name, line)),
                            kernel_.find_wire(fmt::format("p1.{}{}", line, axis)));
    }
    kernel_.start();
    flex_.Init(0x2300);
}

void Bench::turn(int axis, double counts_s) {
    const double microvolts = counts_s * fine / volt * 1e6;
    kernel_.force(motors_[static_cast<std::size_t>(axis)]->drive_wire(),
                  static_cast<int>(microvolts < 0 ? microvolts - 0.5 : microvolts + 0.5));
    kernel_.settle();
}

void Bench::cal(int axis, bool level) {
    kernel_.force(kernel_.find_wire(fmt::format("p1.cal{}", axis)), level);
    kernel_.settle();
    run(microseconds(1));
}

void Bench::fault(int axis, std::string_view name, double value) {
    encoders_[static_cast<std::size_t>(axis)]->fault(name, value, kernel_.now());
    kernel_.settle();
}

}  // namespace howto
