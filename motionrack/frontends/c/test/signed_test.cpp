// A negative position reads as the same number from the register, by name, at a wire, in a frame and in each recording.
#include <gmock/gmock.h>

#include <motionrack/frontends/c/test/world.hpp>
#include <set>
#include <string>
#include <utility>

namespace motionrack::c_test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Two stages at -1 and -32,943 counts of 1 um.
constexpr const char* below_zero =
    "[card.dec]\ntype = \"grating_decoder\"\nscales = 2\n[card.c1]\ntype = \"grating_bus\"\nscales = 2\n"
    "[stage.S0]\ncard = \"c1\"\ninput = 0\noutput = 0\nstart_mm = -0.0005\n"
    "scale = { pitch_um = 4, interpolation = 4 }\n"
    "[stage.S1]\ncard = \"c1\"\ninput = 1\noutput = 1\nstart_mm = -32.9425\n"
    "scale = { pitch_um = 4, interpolation = 4 }\n";

std::string ended_recording(mr_rack* rack, const std::string& path) {
    EXPECT_EQ(mr_trace_stop(rack), MR_OK) << mr_last_error();
    std::string text = text_of_file(path);
    std::filesystem::remove(path);
    return text;
}

std::int64_t peeked(mr_rack* rack, const char* card, const char* name) {
    std::uint64_t value = 0;
    EXPECT_EQ(mr_peek(rack, card, name, &value), MR_OK) << mr_last_error();
    return static_cast<std::int64_t>(value);
}

TEST(CSigned, ANegativeScaleIsOneNumberInEveryView) {
    // For each file ending: the texts of the two numbers at bus.data.
    const std::pair<std::string, std::pair<std::string, std::string>> recordings[] = {
        {".csv", {"bus.data,-1\r", "bus.data,-32943\r"}}, {".vcd", {"\nr-1 ", "\nr-32943 "}}};
    for (const auto& [ending, texts] : recordings) {
        SCOPED_TRACE(ending);
        World world(below_zero);
        const std::string path = temporary("below_zero" + ending);
        ASSERT_EQ(mr_trace_start(world, path.c_str(), "bus.data"), MR_OK) << mr_last_error();
        std::set<double> seen;
        while (mr_now_ns(world) < 2'000) {
            seen.insert(world.wire("bus.data"));
            world.pass(20);
        }
        EXPECT_EQ(seen.count(-32'943), 1u);
        EXPECT_EQ(seen.count(-1), 1u);
        EXPECT_LT(*seen.rbegin(), 2'147'483'648.0) << "no number without its sign";
        mr_frame frame{};
        ASSERT_EQ(mr_frame_wait(world, "c1", 1'000'000, &frame), MR_OK) << mr_last_error();
        EXPECT_EQ(frame.counts[0], -1);
        EXPECT_EQ(frame.counts[1], -32'943);
        for (const char* card : {"c1", "dec"}) {
            EXPECT_EQ(peeked(world, card, "0.COUNT"), -1) << card;
            EXPECT_EQ(peeked(world, card, "1.COUNT"), -32'943) << card;
        }
        const std::string text = ended_recording(world, path);
        EXPECT_THAT(text, HasSubstr(texts.first));
        EXPECT_THAT(text, HasSubstr(texts.second));
        EXPECT_THAT(text, Not(HasSubstr("4294934353"))) << "-32,943 without its sign";
    }
}

TEST(CSigned, ANegativeCounterOfTheMcx314IsOneNumberInEveryView) {
    const std::pair<std::string, std::string> recordings[] = {{".csv", "c1.xlp,-32943\r"}, {".vcd", "\nr-32943 "}};
    for (const auto& [ending, number] : recordings) {
        SCOPED_TRACE(ending);
        World world;
        world.set_up(1, 1000);
        world.command(1, 0x09, static_cast<std::uint32_t>(-32'940));  // LP
        const std::string path = temporary("lp" + ending);
        ASSERT_EQ(mr_trace_start(world, path.c_str(), "c1.xlp"), MR_OK) << mr_last_error();
        world.command(1, 0x06, 3);  // P
        world.command(1, 0x21);     // fixed drive in - direction
        world.pass(50'000'000);
        EXPECT_EQ(world.peek("x.LP"), -32'943);
        world.command(1, 0x10);  // LP to RR6 and RR7
        std::uint16_t low = 0, high = 0;
        EXPECT_EQ(mr_read16(world, "c1", 0x0C, &low), MR_OK);
        EXPECT_EQ(mr_read16(world, "c1", 0x0E, &high), MR_OK);
        EXPECT_EQ(static_cast<std::int32_t>(std::uint32_t{high} << 16 | low), -32'943);
        EXPECT_THAT(ended_recording(world, path), HasSubstr(number));
    }
}

}  // namespace
}  // namespace motionrack::c_test
