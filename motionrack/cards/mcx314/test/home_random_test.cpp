// Tests the source's four homing functions on random machines: with any start position, any switch position, any input
// as the origin, with and without an index. Each homing ends at home or with a message, and none passes a limit.
// MOTIONRACK_SEED=N selects the machines, MOTIONRACK_HOMINGS=N their number.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <motionrack/cards/mcx314/test/home_rig.hpp>
#include <random>
#include <tests/environment.hpp>

namespace motionrack::mcx314 {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Measures how far the rotor goes beyond a range, pulses.
class Beyond final : sim::PositionListener {
  public:
    Beyond(sim::PositionFunction& rotor, std::int64_t low, std::int64_t high)
        : rotor_(rotor), from_(low), to_(high), low_(low), high_(high), slot_(rotor.add_listener(*this)) {}
    void begin() { rotor_.watch(slot_, low_ - 1, high_ + 1); }
    std::int64_t pulses() const { return std::max(from_ - low_, high_ - to_); }

  private:
    void crossed(Instant now) override {
        const std::int64_t at = rotor_.count(now);
        low_ = std::min(low_, at), high_ = std::max(high_, at);
        begin();
    }
    void rate_changed(double, double, Instant) override {}

    sim::PositionFunction& rotor_;
    std::int64_t from_, to_, low_, high_;
    int slot_;
};

enum class Index { wired, never, always };

struct Homing {
    RigAxis axis;
    int type = 1, input = 0;
    bool high = false, brakes_at_limits = true;
    Index index = Index::wired;
    std::int64_t sv = 50, v = 1000, a = 100;

    /// Returns the number of the index's input IN0 .. IN3.
    int index_input() const { return input == 2 ? 3 : 2; }
    unsigned wr1() const {
        const unsigned origin = (high ? 3u : 2u) << 2 * input;
        return type >= 3 ? origin | 1u << 2 * index_input() : origin;
    }
    /// Returns the pulses of a deceleration from V to SV, plus 5 %; the multiple is 10.
    std::int64_t braking() const {
        const double fast = 10.0 * static_cast<double>(v), slow = 10.0 * static_cast<double>(sv);
        return static_cast<std::int64_t>((fast * fast - slow * slow) / (2 * 1'250.0 * static_cast<double>(a)) * 1.05);
    }
    std::int64_t pulses_to(double mm) const {
        return static_cast<std::int64_t>(std::floor((mm - axis.start_mm) * pulses_per_mm + 1e-6));
    }
    /// Returns true if the switch is so far from the limit that the longest distance beyond it (deceleration, then a
    /// revolution) fits. Type 2 ends at the switch itself.
    bool must_succeed() const {
        const std::int64_t room = pulses_to(axis.home_mm) - pulses_to(axis.limit_minus_mm);
        if (type == 2) return room >= 0;
        const bool sound_index = type < 3 || index == Index::wired;
        return sound_index && room > braking() + (type >= 3 ? 2 * pulses_per_turn : 200);
    }
    std::string text() const {
        return fmt::format(
            "HomeType{} WR1 {:02X}h SV {} V {} A {}, start {} home {} limit {} hysteresis {} bounce {} s, index {}{}",
            type, wr1(), sv, v, a, axis.start_mm, axis.home_mm, axis.limit_minus_mm, axis.hysteresis_mm,
            to_seconds(axis.bounce), static_cast<int>(index), brakes_at_limits ? ", brakes at limits" : "");
    }
};

Homing drawn(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto below = [&](std::uint64_t end) { return static_cast<int>(random() % end); };
    Homing out;
    out.type = 1 + below(4);
    out.input = below(4);
    out.high = below(2) != 0;
    out.brakes_at_limits = below(2) != 0;
    out.index = below(3) != 0 ? Index::wired : below(2) != 0 ? Index::never : Index::always;
    out.sv = 20 + below(200);
    out.v = out.sv + below(1'500);
    out.a = 50 + below(350);
    RigAxis& axis = out.axis;
    // The switch: in the middle of the travel, close to the limit, at it, and behind it.
    axis.home_mm = axis.limit_minus_mm + std::array{9 + 0.5 * below(8), 0.01 * below(200), 0.0, -0.3}[below(4) % 4];
    axis.limit_plus_mm = 60;
    // The start: beside the switch, on it, or at a limit.
    axis.start_mm = std::array{5.0 + below(40), axis.home_mm, axis.home_mm - 0.5 * below(3), axis.limit_minus_mm,
                               axis.limit_plus_mm}[static_cast<std::size_t>(below(5))];
    axis.hysteresis_mm = std::array{0.0, 0.05, 0.4}[static_cast<std::size_t>(below(3))];
    axis.bounce = std::array{Duration{0}, Duration{microseconds(300)}, Duration{milliseconds(2)}}[below(3) % 3];
    axis.wired_home = axis.wired_index = false;
    axis.home_level = out.high ? 1 : 0;
    axis.start_stop_hz = 1e6;
    return out;
}

void expect_an_end(const Homing& homing) {
    SCOPED_TRACE(homing.text());
    HomeRig rig({homing.axis});
    const std::string pin = "c.xin", index_pin = pin + std::to_string(homing.index_input());
    rig.join(rig.machines[0]->home_wire(), pin + std::to_string(homing.input));
    if (homing.type >= 3 && homing.index == Index::wired) rig.join(rig.machines[0]->index_wire(), index_pin);
    const auto limit = [&](double mm) { return homing.pulses_to(mm); };
    Beyond beyond(rig.machines[0]->rotor(), std::min<std::int64_t>(0, limit(homing.axis.limit_minus_mm)),
                  std::max<std::int64_t>(0, limit(homing.axis.limit_plus_mm)));
    rig.start();
    beyond.begin();
    rig.driver.WriteMode2(xyzu, homing.brakes_at_limits ? 0x0044 : 0x0040);
    if (homing.type >= 3 && homing.index != Index::wired) rig.hold_wire(index_pin, homing.index == Index::always);
    constexpr std::array functions = {&HomeType1, &HomeType2, &HomeType3, &HomeType4};
    const auto done = functions[static_cast<std::size_t>(homing.type - 1)](rig.driver, axis_x, homing.wr1(), homing.sv,
                                                                           homing.v, homing.a);
    EXPECT_FALSE(rig.driver.moving(xyzu));
    EXPECT_LT(rig.port.now(), whole_seconds(600));
    EXPECT_LE(beyond.pulses(), homing.brakes_at_limits ? homing.braking() + 2 : 2);
    EXPECT_EQ(rig.machines[0]->lost_steps(), 0);
    if (!done) {
        EXPECT_THAT(done.error().message, AllOf(HasSubstr("Axis X is not homed: "), HasSubstr("again.")));
        // Type 3 reports an index that is active where the axis stops; that position depends on the ramp.
        const bool at_index =
            homing.type == 3 && done.error().message.find("is active at the switch edge") != std::string::npos;
        EXPECT_FALSE(homing.must_succeed() && !at_index) << done.error().message;
        return;
    }
    EXPECT_TRUE(done->front().homed);
    EXPECT_EQ(rig.driver.ReadLPS(0), 0);
    EXPECT_EQ(rig.driver.ReadEPS(0), 0);
    const bool at_origin = homing.type == 2 || homing.type == 4;
    if (at_origin) {
        // If the switch is exactly at a whole pulse, rounding decides whether it acts at that pulse.
        EXPECT_NEAR(static_cast<double>(rig.rotor()), static_cast<double>(homing.pulses_to(homing.axis.home_mm)), 1);
    }
    if (homing.type == 3 && homing.index == Index::wired) {
        EXPECT_EQ(rig.rotor() % pulses_per_turn, 0);
    }
}

TEST(HomingBySource, EndsAtHomeOrReportsTheReasonOnAnyMachine) {
    const std::uint64_t first = seed_from_environment(), count = cases("MOTIONRACK_HOMINGS", 60);
    for (std::uint64_t i = 0; i < count && !HasFailure(); ++i) {
        SCOPED_TRACE(fmt::format("MOTIONRACK_SEED={}", first + i));
        expect_an_end(drawn(first + i));
    }
}

}  // namespace
}  // namespace motionrack::mcx314
