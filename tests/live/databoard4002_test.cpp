// The DataBoard 4002's library on the live port of MOTIONRACK_LIVE_PORT, which live_server serves: its motor follows
// the card's pulses, one count a pulse.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <motionrack/cards/databoard4002/driver/driver.hpp>
#include <motionrack/live/byte_card_port.hpp>
#include <optional>
#include <tests/live/mapped_file.hpp>
#include <tests/live/served_clock.hpp>

namespace motionrack::databoard4002 {
namespace {

using namespace live_test;
using testing::HasSubstr;

constexpr std::size_t page = 4096;

std::string variable(const char* name) {
    const char* const value = std::getenv(name);
    return value ? value : "";
}

class LiveDataboard4002 : public testing::Test {
  protected:
    void SetUp() override {
        const std::string place = variable("MOTIONRACK_LIVE_PORT"), bell = variable("MOTIONRACK_LIVE_DOORBELL");
        if (place.empty()) GTEST_SKIP() << "MOTIONRACK_LIVE_PORT is not the address of a card.";
        if (!bell.empty()) bell_.emplace(bell, page, false);
        auto opened = live::ByteCardPort::open(*live::read_port_spec(place + ",gap_ns=1000"), card_map(),
                                               bell_ ? std::make_unique<ServedClock>(bell_->as<Doorbell>()) : nullptr);
        ASSERT_TRUE(opened) << opened.error().message;
        port = std::move(*opened);
        driver.emplace(*port, *port);
        const Result<int> version = driver->connect();
        ASSERT_TRUE(version) << version.error().message;
        ASSERT_TRUE(driver->set_rate(16'384 - 400));  // 1000 pulses/s
        ASSERT_TRUE(driver->athome());
    }
    void TearDown() override {
        if (port && !absent_) {
            EXPECT_TRUE(driver->quit());
            EXPECT_FALSE(port->trouble()) << port->trouble()->message;
        }
    }
    /// Takes the card out of its slot, or puts it back.
    void take_out(std::uint32_t absent) {
        const std::string place = variable("MOTIONRACK_LIVE_PORT");
        const std::size_t from = place.find(':') + 1;
        const std::string file = place.substr(from, place.find("/port,") - from) + "/absent";
        std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(&absent), sizeof absent);
        absent_ = absent != 0;
    }

    std::unique_ptr<live::ByteCardPort> port;
    std::optional<Driver> driver;

  private:
    std::optional<MappedFile> bell_;
    bool absent_ = false;
};

TEST_F(LiveDataboard4002, MovesExactlyToItsTargets) {
    for (const std::int64_t target : {1, 250, -40, 0}) {
        const Result<void> moved = driver->move_to(target, whole_seconds(5));
        ASSERT_TRUE(moved) << moved.error().message;
        EXPECT_EQ(*driver->position(), target);
        EXPECT_EQ(*driver->rate(), 0) << "it stands";
    }
}

TEST_F(LiveDataboard4002, WaitsForTheInterruptOfTheCard) {
    ASSERT_TRUE(port->has_interrupt());
    const Instant from = port->now();
    const Result<void> moved = driver->move_to(100, whole_seconds(5), Waiting::interrupt);
    ASSERT_TRUE(moved) << moved.error().message;
    EXPECT_EQ(*driver->position(), 100);
    EXPECT_LT(port->now() - from, whole_seconds(2)) << "100 pulses last a tenth of a second";
}

TEST_F(LiveDataboard4002, StopsOnRequest) {
    std::atomic<bool> stop{true};
    port->set_stop_flag(&stop);
    const Result<void> moved = driver->move_to(100'000, whole_seconds(5));
    ASSERT_FALSE(moved);
    EXPECT_EQ(moved.error().kind, ErrorKind::stopped);
    port->set_stop_flag(nullptr);
    const std::int64_t here = *driver->position();
    EXPECT_LT(here, 1000);
    port->pass(milliseconds(50));
    EXPECT_EQ(*driver->position(), here);
}

TEST_F(LiveDataboard4002, ReportsThatNoCardAnswers) {
    take_out(1);
    const Result<int> version = driver->connect();
    ASSERT_FALSE(version);
    EXPECT_THAT(version.error().message, HasSubstr("No card answers under the number 13 (STAT reads FFh)"));
    take_out(0);
}

}  // namespace
}  // namespace motionrack::databoard4002
