// Reset, modes and travel.
#include <motionrack/cards/mcx314/axes/geometry.hpp>
#include <motionrack/cards/mcx314/axes/initialise.hpp>

namespace motionrack::mcx314 {

namespace {

constexpr std::uint16_t outputs_and_limits = field("WR2", "PLSMD").mask | field("WR2", "LMTMD").mask;

}  // namespace

Result<void> prepare_chip(Driver& driver) {
    driver.RESET();
    driver.WriteMode1(xyzu, 0);
    driver.WriteMode2(xyzu, outputs_and_limits);
    driver.WriteMode3(xyzu, 0);
    return driver.SetAO(xyzu, 0);
}

Result<void> write_travel(Driver& driver, int channel, const control::AxisLimits& limits) {
    const unsigned axis = 1u << channel;
    MOTIONRACK_CHECK(driver.SetCompP(axis, nearest_pulse(limits.max_position, limits.pulses_per_unit)));
    return driver.SetCompM(axis, nearest_pulse(limits.min_position, limits.pulses_per_unit));
}

}  // namespace motionrack::mcx314
