// Tests of the function library on virtual cards.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <motionrack/cards/grating_bus/driver/grating_card.hpp>
#include <motionrack/sim/virtual_port.hpp>

#include "rig.hpp"

namespace motionrack::grating_bus {
namespace {

using testing::HasSubstr;

constexpr Duration driver_period = microseconds(200);

/// A crate with a processor's library at each card.
struct Bench : Crate {
    explicit Bench(const std::vector<CardSettings>& settings, int scales = 4, Duration access = nanoseconds(40))
        : Crate(settings, scales, {}, false) {
        for (auto& card : cards) {
            ports.push_back(
                std::make_unique<sim::VirtualPort>(kernel, *card, card->id(), card->interrupt_wire(), access));
            libraries.push_back(std::make_unique<GratingCard>(*ports.back(), *ports.back()));
        }
    }
    std::vector<std::unique_ptr<sim::VirtualPort>> ports;
    std::vector<std::unique_ptr<GratingCard>> libraries;
};

TEST(GratingCardLibrary, ReadsTheSettingsOfTheCard) {
    std::vector<CardSettings> settings = crew(1, 6);
    settings[1].clock_shifter = Shifter::out;
    Bench bench(settings, 6);
    const auto host = bench.libraries[0]->open(), slave = bench.libraries[1]->open();
    ASSERT_TRUE(host && slave);
    EXPECT_TRUE(host->host);
    EXPECT_FALSE(slave->host);
    EXPECT_FALSE(host->wrong_direction);
    EXPECT_TRUE(slave->wrong_direction);
    EXPECT_EQ(host->scales, 6);
    EXPECT_EQ(host->addresses().size(), 6u);
    EXPECT_EQ(host->addresses()[5], 5);
    EXPECT_EQ(host->timing, BusTiming{});
    EXPECT_EQ(host->period, driver_period);
}

TEST(GratingCardLibrary, ReadsTheAddressListOfTheCard) {
    std::vector<CardSettings> settings = crew(1, 3);
    for (CardSettings& s : settings) s.addresses = {5, 2, 9};
    Bench bench(settings, 10);
    const auto slave = bench.libraries[1]->open();
    ASSERT_TRUE(slave);
    EXPECT_EQ(slave->first, 5);
    EXPECT_EQ(std::vector<int>(slave->addresses().begin(), slave->addresses().end()), (std::vector<int>{5, 2, 9}));
}

TEST(GratingCardLibrary, ReportsTheScalesOfAFrameAndFollowsEachByItsAddress) {
    std::vector<CardSettings> settings = crew(1, 3);
    settings[0].addresses = {5, 2, 9};
    Bench bench(settings, 10);
    bench.libraries[1]->set_position(9, std::int64_t{3} << 32);
    const auto reading = bench.libraries[1]->wait(2 * driver_period);
    ASSERT_TRUE(reading) << reading.error().message;
    EXPECT_EQ(std::vector<int>(reading->addresses().begin(), reading->addresses().end()), (std::vector<int>{5, 2, 9}));
    EXPECT_EQ(reading->counts()[0], bench.truth(5, reading->frame.instant()));
    EXPECT_EQ(reading->counts()[2], (std::int64_t{3} << 32) + bench.truth(9, reading->frame.instant()));
    EXPECT_EQ(bench.libraries[1]->errors().alien, 3) << "its own list is 0, 1, 2";
}

TEST(GratingCardLibrary, ReadsTheSamePositionsFromEveryCard) {
    Bench bench(crew(3));
    bench.run(7 * driver_period + microseconds(30));
    const auto host = bench.libraries[0]->read();
    ASSERT_TRUE(host) << host.error().message;
    for (std::size_t i = 1; i < 4; ++i) {
        const auto slave = bench.libraries[i]->read();
        ASSERT_TRUE(slave);
        EXPECT_TRUE(same(slave->frame, host->frame));
    }
    for (int k = 0; k < 4; ++k)
        EXPECT_EQ(host->counts()[static_cast<std::size_t>(k)], bench.truth(k, host->frame.instant()));
}

TEST(GratingCardLibrary, ReadsCompleteFramesOnlyHoweverSlowlyItReads) {
    Bench bench(crew(0, 8), 8, microseconds(37));  // reading a frame takes about 5 periods
    bench.run(driver_period);
    std::uint32_t last = 0;
    for (int i = 0; i < 50; ++i) {
        const auto reading = bench.libraries[0]->read();
        if (!reading) {
            EXPECT_THAT(reading.error().message, HasSubstr("older than two periods"));
            continue;
        }
        for (int k = 0; k < 8; ++k)
            ASSERT_EQ(reading->frame.counts[static_cast<std::size_t>(k)],
                      static_cast<std::uint32_t>(bench.truth(k, reading->frame.instant())));
        EXPECT_GE(reading->frame.sequence, last);
        last = reading->frame.sequence;
    }
    EXPECT_GT(last, 150u);
}

TEST(GratingCardLibrary, WaitsForTheNextFrameByItsInterrupt) {
    Bench bench(crew(1));
    for (std::uint32_t i = 0; i < 20; ++i) {
        const auto reading = bench.libraries[1]->wait(2 * driver_period);
        ASSERT_TRUE(reading) << reading.error().message;
        EXPECT_EQ(reading->frame.sequence, i);
        EXPECT_LT(bench.kernel.now() - reading->frame.instant(), microseconds(3));
    }
}

TEST(GratingCardLibrary, ReportsAMissingFrameAndALostHost) {
    Bench bench(crew(1));
    ASSERT_TRUE(bench.cards[0]->fault("off", 1, bench.kernel.now()));
    EXPECT_THAT(bench.libraries[1]->read().error().message, HasSubstr("no frame yet"));
    EXPECT_THAT(bench.libraries[1]->wait(driver_period).error().message, HasSubstr("within 200 us"));
    ASSERT_TRUE(bench.cards[0]->fault("off", 0, bench.kernel.now()));
    ASSERT_TRUE(bench.libraries[1]->wait(2 * driver_period));
    ASSERT_TRUE(bench.cards[0]->fault("off", 1, bench.kernel.now()));
    bench.run(3 * driver_period);
    EXPECT_TRUE(bench.libraries[1]->stale());
    EXPECT_THAT(bench.libraries[1]->read().error().message, HasSubstr("stale"));
}

TEST(GratingCardLibrary, AStoppedWaitIsNotReportedAsATimeout) {
    Bench bench(crew(1));
    ASSERT_TRUE(bench.cards[0]->fault("off", 1, bench.kernel.now()));
    const std::atomic<bool> stop{true};
    bench.ports[1]->set_stop_flag(&stop);
    const auto reading = bench.libraries[1]->wait(driver_period);
    ASSERT_FALSE(reading);
    EXPECT_EQ(reading.error().kind, ErrorKind::stopped);
    EXPECT_THAT(reading.error().message, HasSubstr("stopped by the user"));
}

TEST(GratingCardLibrary, FollowsAScaleBeyond32Bits) {
    Bench bench(crew(0));
    bench.run(driver_period);
    bench.libraries[0]->set_position(0, std::int64_t{1} << 40);
    const auto first = bench.libraries[0]->wait(2 * driver_period);
    ASSERT_TRUE(first);
    EXPECT_EQ(first->positions[0], (std::int64_t{1} << 40) + bench.truth(0, first->frame.instant()));
    bench.run(whole_seconds(60));
    (void)bench.libraries[0]->wait(2 * driver_period);  // 60 s at 20 MHz are 1.2e9 counts
    bench.run(whole_seconds(60));
    const auto last = bench.libraries[0]->wait(2 * driver_period);
    ASSERT_TRUE(last);
    EXPECT_EQ(last->positions[0] - first->positions[0],
              bench.truth(0, last->frame.instant()) - bench.truth(0, first->frame.instant()));
    EXPECT_GT(bench.truth(0, last->frame.instant()), std::int64_t{1} << 31);
}

TEST(GratingCardLibrary, ReportsAndClearsConditions) {
    Bench bench(crew(1));
    bench.run(2 * driver_period + microseconds(10));
    ASSERT_TRUE(bench.cards[1]->fault("late", 50, bench.kernel.now()));
    bench.run(3 * driver_period);
    const CardErrors errors = bench.libraries[1]->errors();
    EXPECT_EQ(errors.broken, 3);
    EXPECT_EQ(errors.missed_words, 12);
    bench.libraries[1]->clear_errors();
    EXPECT_EQ(bench.libraries[1]->errors().broken, 0);
}

/// A device that is not a card of a grating bus.
struct Stranger : RegisterPort, Interrupt {
    void write(std::uint32_t, std::uint16_t) override {}
    std::uint16_t read(std::uint32_t) override { return 0xFFFF; }
    bool wait(Duration) override { return false; }
    void pass(Duration) override {}
    Instant now() const override { return {}; }
};

TEST(GratingCardLibrary, RejectsDevicesThatAreNotAGratingCard) {
    Stranger stranger;
    GratingCard library(stranger, stranger);
    EXPECT_THAT(library.open().error().message, HasSubstr("FFFFh"));
    EXPECT_THAT(library.read().error().message, HasSubstr("65535 scales"));
}

}  // namespace
}  // namespace motionrack::grating_bus
