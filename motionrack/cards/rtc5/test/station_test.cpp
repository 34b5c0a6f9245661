// Tests of the card in a marking machine: deviation of the marks on the part.
#include <cmath>
#include <motionrack/cards/rtc5/test/rig.hpp>
#include <motionrack/sim/parts/marking_station.hpp>
#include <motionrack/sim/parts/serial_position_source.hpp>

namespace motionrack::rtc5 {
namespace {

constexpr double station_k = 8656;  // bits/mm

/// Connects a card to a marking machine.
class Machine final : public Sink, public Inputs {
  public:
    explicit Machine(const parts::StationSettings& settings) : station(*parts::MarkingStation::make(settings)) {
        card.set_inputs(this);
    }

    void samples(const Samples& b) override { station.block(b.first, b.x, b.y); }
    void laser(std::int64_t half_us, bool on) override { station.laser(half_us, on); }
    void counts(int, std::int64_t first, std::span<std::int32_t> out) override { station.track().counts(first, out); }
    bool words(std::int64_t first, std::span<std::uint32_t> out) override {
        if (sender) sender->words(first, out);
        return sender.has_value();
    }
    void put(Op op, std::initializer_list<double> p = {}) { ASSERT_TRUE(card.put(*list_command(op, p))); }
    /// Marks a 10 mm square at 500 mm/s after the commands `before`; returns its deviation.
    parts::Deviation square(std::initializer_list<Command> before) {
        for (const Command& c : before) EXPECT_TRUE(card.put(c));
        put(Op::set_mark_speed, {500 * station_k / 1000});
        put(Op::set_jump_speed, {3000 * station_k / 1000});
        put(Op::set_laser_delays, {laser_delay, laser_delay});
        put(Op::set_scanner_delays, {60, 60, 60});
        put(Op::jump_abs, {-5 * station_k, -5 * station_k});
        for (const auto& [x, y] : {std::pair{5, -5}, std::pair{5, 5}, std::pair{-5, 5}, std::pair{-5, -5}})
            put(Op::mark_abs, {x * station_k, y * station_k});
        put(Op::fly_return, {0, 0});
        put(Op::set_end_of_list);
        EXPECT_TRUE(card.execute_list(1));
        EXPECT_TRUE(card.run_to_rest(1'000'000, this));
        station.workpiece().finish();
        // The origin of the part is at the travel of tick 0, which zeroes the encoder and starts the correction.
        const std::vector<parts::DrawnSegment> drawing = {
            {{-5, -5}, {5, -5}}, {{5, -5}, {5, 5}}, {{5, 5}, {-5, 5}}, {{-5, 5}, {-5, -5}}};
        return station.workpiece().compare(drawing, 0.02, 0.03);
    }

    Engine card;
    parts::MarkingStation station;
    std::optional<parts::SerialPositionSource> sender;
    double laser_delay = 0;
};

parts::StationSettings belt(double mm_s) {
    parts::StationSettings out;
    out.track.profile = {{0, mm_s}};
    return out;
}

TEST(Rtc5Station, ASquareOnABeltIsDistortedWithoutCorrectionAndRightWithIt) {
    Machine without(belt(100)), with(belt(100));
    const auto off = without.square({}), on = with.square({*list_command(Op::set_fly_x, {station_k / 1000})});
    EXPECT_GT(off.max_mm, 5);
    // The tolerance is one count and the travel of one tick.
    EXPECT_LE(on.max_mm, 0.0021);
    EXPECT_EQ(on.missing_mm, 0);
    EXPECT_EQ(with.card.parts().flags.take_marking_info(), 0u);
}

TEST(Rtc5Station, TheBeltVelocityMayChangeWithAnEncoderButNotWithTheSimulatedOne) {
    auto settings = belt(100);
    settings.track.profile = {{0, 50}, {0.05, 150}, {0.1, 80}};
    Machine with(settings), simulated(settings);
    ASSERT_TRUE(simulated.card.parts().encoders.simulate(1));
    EXPECT_LE(with.square({*list_command(Op::set_fly_x, {station_k / 1000})}).max_mm, 0.003);
    EXPECT_GT(simulated.square({*list_command(Op::set_fly_x, {station_k * 100 / 1e6})}).max_mm, 0.5);
}

TEST(Rtc5Station, TheTrackingErrorCompensatesTheLagOfTheMirrors) {
    auto settings = belt(500);
    settings.galvo = {.ideal_mirrors = false,
                      .dead_time_us = 50,
                      .natural_frequency_hz = 3183.1,
                      .damping_ratio = 1,
                      .max_velocity_bits_ms = 1e7};
    settings.track.counts_per_unit = 20'000;
    const auto start = *list_command(Op::set_fly_x, {station_k / 20'000});
    Machine plain(settings), ahead(settings);
    EXPECT_NEAR(plain.station.galvo().lag_us(), 150, 0.1);
    ahead.card.parts().encoders.set_tracking_error(15, 0);
    for (Machine* m : {&plain, &ahead}) m->laser_delay = 300;  // units of 0.5 us: 150 us, as the mirrors
    const double late = plain.square({start}).max_mm, right = ahead.square({start}).max_mm;
    EXPECT_NEAR(late, 0.075, 0.012) << "150 us at 500 mm/s";
    EXPECT_LT(right, 0.02);
}

TEST(Rtc5Station, ATableMadeFromTheLensMakesTheFieldFlat) {
    auto settings = belt(0);
    settings.lens = sim::ScanLens{};
    Machine bent(settings), flat(settings);
    ASSERT_TRUE(flat.card.parts().heads.load_table(table_of(*correction_of(*settings.lens)), 1));
    ASSERT_TRUE(flat.card.parts().heads.select_tables(1, 0));
    EXPECT_GT(bent.square({}).max_mm, 0.2);
    EXPECT_LT(flat.square({}).max_mm, 0.001);
}

TEST(Rtc5Station, PositionWordsCorrectLikeAnEncoderAndTheirDelayShifts) {
    Machine prompt(belt(100)), late(belt(100));
    prompt.sender = *parts::SerialPositionSource::make(prompt.station.track(), {.bits_per_mm = 1000});
    late.sender = *parts::SerialPositionSource::make(late.station.track(), {.bits_per_mm = 1000, .delay_us = 2000});
    const Command start = *list_command(Op::set_fly_x_pos, {station_k / 1000});
    EXPECT_LE(prompt.square({start}).max_mm, 0.0021);
    EXPECT_NEAR(late.square({start}).max_mm, 0.2, 0.003) << "2 ms at 100 mm/s";
}

TEST(Rtc5Station, ARotaryTableIsFollowed) {
    parts::StationSettings settings;
    settings.track = {.rotary = true, .centre_mm = {-30, 0}, .profile = {{0, 60}}, .counts_per_unit = 10'000};
    Machine machine(settings);
    ASSERT_TRUE(machine.card.parts().fly.set_rot_center({-30 * station_k, 0}));
    EXPECT_LE(machine.square({*list_command(Op::set_fly_rot, {3'600'000})}).max_mm, 0.002);
}

TEST(Rtc5Station, EnergyPerMillimetreIsPowerOverSpeedOnThePart) {
    Machine machine(belt(0));
    machine.square({});
    double marked = 0, dwelt = 0;
    for (const parts::MarkedPoint& point : machine.station.workpiece().points()) {
        dwelt += point.dwell_j;
        if (point.first) continue;
        EXPECT_NEAR(point.j_per_mm, 20.0 / 500, 20.0 / 500 * 0.03);
        ++marked;
    }
    EXPECT_GE(marked, 4);
    EXPECT_LE(marked, 12) << "straight and even is one segment";
    EXPECT_NEAR(dwelt, 3 * 60e-5 * 20, 1e-9) << "the polygon delay at three corners";
    EXPECT_NEAR(machine.station.workpiece().length_mm(), 40, 1e-3);
}

}  // namespace
}  // namespace motionrack::rtc5
