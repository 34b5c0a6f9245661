// The RTC5 in a rack: its lines by their names, counting, starts, values by name, copies, recordings.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <motionrack/rack/rtc5_card.hpp>
#include <motionrack/rack/session.hpp>
#include <motionrack/rack/test/config_helpers.hpp>
#include <sstream>

namespace motionrack::rack {
namespace {

using rtc5::Op;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* small = "[card.c1]\ntype = \"rtc5\"\nlist_memory = 64\n";

struct Rtc5Bench {
    explicit Rtc5Bench(const std::string& text = small) : session(std::move(*Session::open(text))) {}

    rtc5::Engine& engine() { return rtc5_card_of(session->rack(), "c1")->engine(); }
    void put(Op op, std::initializer_list<double> parameters = {}) {
        ASSERT_TRUE(engine().put(*rtc5::list_command(op, parameters)));
    }
    void begin() { ASSERT_TRUE(engine().set_start_list(1)); }
    void go() {
        put(Op::set_end_of_list);
        ASSERT_TRUE(engine().execute_list(1));
    }
    void advance_us(int us) { ASSERT_TRUE(session->advance(static_cast<std::uint64_t>(us) * 1'000)); }
    void set(const std::string& pin, double value) {
        const auto done = session->set_wire("c1." + pin, value);
        ASSERT_TRUE(done) << done.error().message;
        advance_us(20);
    }
    std::int64_t peek(const char* name) { return *session->peek("c1", name); }

    std::unique_ptr<Session> session;
};

TEST(Rtc5InARack, ACardAloneOpensAndItsOutputsReadAsBits) {
    Rtc5Bench bench("card.c1 = \"rtc5\"");
    bench.begin();
    bench.put(Op::set_mark_speed, {1000});
    bench.put(Op::mark_abs, {-300, 70});
    bench.go();
    bench.advance_us(200);
    EXPECT_EQ(*bench.session->wire("c1.laser_on"), 1);
    bench.advance_us(2'000);
    EXPECT_EQ(*bench.session->wire("c1.xout"), -300);
    EXPECT_EQ(*bench.session->wire("c1.yout"), 70);
    EXPECT_EQ(*bench.session->wire("c1.laser_on"), 0);
    EXPECT_EQ(bench.peek("XOUT"), -300);
    EXPECT_EQ(*bench.session->part("c1.mark_speed_bits_ms"), 1000);
    EXPECT_THAT(bench.session->set_wire("c1.xout", 1).error().message, HasSubstr("output"));
}

TEST(Rtc5InARack, ItsEncoderLinesCountFourfold) {
    Rtc5Bench bench;
    for (int i = 0; i < 10; ++i) bench.set(i % 2 ? "enc0_b" : "enc0_a", i / 2 % 2 == 0);
    EXPECT_EQ(bench.peek("ENCODER0"), 10);
    EXPECT_EQ(bench.peek("ENCODER1"), 0);
    EXPECT_EQ(bench.peek("MARKING_INFO"), 0);
}

TEST(Rtc5InARack, StartAndStopAreActiveLow) {
    Rtc5Bench bench;
    EXPECT_EQ(*bench.session->wire("c1.start_n"), 1) << "an open line is high";
    bench.begin();
    bench.put(Op::long_delay, {1000});
    bench.put(Op::set_end_of_list);
    bench.engine().set_control_mode(rtc5::control_ext_start);
    bench.set("start_n", 0);
    EXPECT_EQ(bench.peek("STATUS"), rtc5::status_bit("BUSY"));
    EXPECT_EQ(*bench.session->wire("c1.busy"), 1);
    bench.set("start_n", 1);
    bench.set("stop_n", 0);
    EXPECT_EQ(bench.peek("STATUS"), 0);
}

TEST(Rtc5InARack, AWordOnItsMcbspIsANumberOf32Bits) {
    Rtc5Bench bench;
    ASSERT_TRUE(bench.engine().parts().fly.set_mcbsp_in(1, 1));
    bench.set("mcbsp", -2'147'483'648.0);
    EXPECT_EQ(bench.peek("MCBSP1"), -2'147'483'648);
    bench.set("mcbsp", 70);
    EXPECT_EQ(*bench.session->wire("c1.mcbsp"), 70);
    EXPECT_EQ(bench.peek("MCBSP1"), 70);
    EXPECT_THAT(bench.session->set_wire("c1.mcbsp", 2'147'483'648.0).error().message,
                HasSubstr("-2147483648 to 2147483647"));
    EXPECT_THAT(bench.session->set_wire("c1.mcbsp", 0.5).error().message, HasSubstr("must be whole"));
    EXPECT_THAT(bench.session->set_wire("c1.start_n", 70).error().message, HasSubstr("digital"));
}

TEST(Rtc5InARack, HasNoBusAndReportsItsInterfaces) {
    Rtc5Bench bench;
    EXPECT_THAT(bench.session->read("c1", 16, 0).error().message, HasSubstr("no registers on a bus"));
    EXPECT_THAT(bench.session->write("c1", 16, 0, 0).error().message, HasSubstr("no registers on a bus"));
    const std::string known = bench.session->peek("c1", "HEIGHT").error().message;
    for (const char* name : {"STATUS", "MARKING_INFO", "XOUT", "LIST_POSITION", "TICK"})
        EXPECT_THAT(known, HasSubstr(name));
    EXPECT_THAT(bench.session->part("c1.height").error().message, HasSubstr("mark_speed_bits_ms"));
}

TEST(Rtc5InARack, ACopyContinuesIdenticallyWithItsTablesAndRecordings) {
    Rtc5Bench bench;
    bench.begin();
    bench.put(Op::set_trigger, {1, 7, 8});
    bench.put(Op::set_fly_x, {2});
    bench.put(Op::mark_abs, {4000, 500});
    bench.put(Op::fly_return, {0, 0});
    bench.go();
    ASSERT_TRUE(bench.engine().parts().encoders.simulate(1));
    const auto file = rtc5::correction_of(sim::ScanLens{});
    ASSERT_TRUE(file) << file.error().message;
    ASSERT_TRUE(bench.engine().parts().heads.load_table(rtc5::table_of(*file), 1));
    ASSERT_TRUE(bench.engine().parts().heads.select_tables(1, 0));
    bench.advance_us(333);
    const std::unique_ptr<Session> copy = *bench.session->copy();
    EXPECT_EQ(copy->state_hash(), bench.session->state_hash());
    bench.advance_us(3'000);
    ASSERT_TRUE(copy->advance(3'000'000));
    EXPECT_EQ(*copy->wire("c1.xout"), *bench.session->wire("c1.xout"));
    EXPECT_EQ(copy->state_hash(), bench.session->state_hash());
    EXPECT_NE(*copy->wire("c1.xout"), 0);
    const rtc5::Engine& ended = rtc5_card_of(copy->rack(), "c1")->engine();
    ASSERT_GT(ended.parts().recorder.recording().count, 40);
    for (std::int64_t i = 0; i < ended.parts().recorder.recording().count; ++i)
        EXPECT_EQ(ended.parts().recorder.recorded(0, i), bench.engine().parts().recorder.recorded(0, i)) << i;
}

TEST(Rtc5InARack, ItsOutputsAreRecordedTickByTick) {
    Rtc5Bench bench;
    const std::string path = (std::filesystem::temp_directory_path() / "motionrack_rtc5_test.csv").string();
    bench.begin();
    bench.put(Op::set_mark_speed, {1000});
    bench.put(Op::mark_abs, {40, -40});
    bench.go();
    ASSERT_TRUE(bench.session->start_trace(path, "c1.xout c1.yout c1.laser_on"));
    bench.advance_us(500);
    ASSERT_TRUE(bench.session->stop_trace());
    std::ifstream file(path);
    std::stringstream text;
    text << file.rdbuf();
    for (const char* part : {"c1.xout", "c1.yout", "c1.laser_on", "c1.xout,40\r", "c1.yout,-40\r"})
        EXPECT_THAT(text.str(), HasSubstr(part));
    std::filesystem::remove(path);
}

TEST(Rtc5InARack, ReportsInvalidSettingsWithTheirPosition) {
    const auto refused = [](const std::string& line) {
        const RackReading reading = read_rack_text("[card.c1]\ntype = \"rtc5\"\n" + line);
        EXPECT_FALSE(reading.config) << line;
        return reading.errors.empty() ? std::string() : reading.errors.front().text();
    };
    EXPECT_THAT(refused("list_memory = 8\n"), AllOf(HasSubstr("16 .. 1048576"), HasSubstr("3:")));
    EXPECT_THAT(refused("lens = 1\n"), HasSubstr("'lens'"));
    EXPECT_THAT(refused("[wires]\n\"c1.mcbsp\" = \"c1.laser_on\"\n"), HasSubstr("a number"));
}

}  // namespace
}  // namespace motionrack::rack
