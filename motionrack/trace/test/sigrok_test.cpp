// Independent check of the VCD output: sigrok-cli counts the steps and quadrature counts of a generated file.
//
//     sigrok-cli -I vcd -i run.vcd -P counter:data=x_step:data_edge=rising -A counter=edge_count
//     sigrok-cli -I vcd -i run.vcd -P stepper_motor:step=x_step:dir=x_dir -A stepper_motor=position
//     sigrok-cli -I vcd -i run.vcd -P graycode:d0=x_b:d1=x_a -A graycode=count
//     sigrok-cli -I vcd:downsample=1000 ...   samples at a thousandth of the timescale: 100 ns of a file of 100 ps
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <motionrack/trace/vcd_writer.hpp>
#include <vector>

#include "scratch.hpp"

namespace motionrack::trace {
namespace {

constexpr int forward = 700;
constexpr int backward = 300;

/// Writes the step, direction, A and B wires of an axis that moves `forward` steps and `backward` steps back, 10 us
/// each.
void write_moves(const std::string& path, Duration timescale) {
    VcdSettings settings;
    settings.timescale = timescale;
    settings.full_names = true;
    auto vcd = VcdWriter::create(path, settings);
    ASSERT_TRUE(vcd);
    vcd->push_scope("x");
    const auto step = vcd->add_wire("step");
    const auto dir = vcd->add_wire("dir");
    const auto a = vcd->add_wire("a");
    const auto b = vcd->add_wire("b");
    vcd->pop_scope();
    Instant now = microseconds(20);
    unsigned count = 0;
    for (int i = 0; i < forward + backward; ++i) {
        vcd->change(dir, i < forward ? 1 : 0, now);
        now += microseconds(4);
        vcd->change(step, 1, now);
        count += i < forward ? 1U : ~0U;
        vcd->change(a, (count >> 1 ^ count) & 1U, now);
        vcd->change(b, count >> 1 & 1U, now);
        vcd->change(step, 0, now + microseconds(2));
        now += microseconds(6);
    }
    ASSERT_TRUE(vcd->close(now));
}

/// Returns the numbers that sigrok-cli prints after "decoder-1: ".
std::vector<int> ask(const std::string& path, const std::string& input, const std::string& decoder,
                     const std::string& row) {
    const std::string command =
        "sigrok-cli -I " + input + " -i " + path + " -P " + decoder + " -A " + row + " 2>/dev/null";
    std::FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) return {};
    std::vector<int> numbers;
    std::array<char, 256> line{};
    while (std::fgets(line.data(), static_cast<int>(line.size()), pipe) != nullptr) {
        const std::string text = line.data();
        const std::size_t colon = text.find(": ");
        if (colon != std::string::npos) numbers.push_back(std::atoi(text.c_str() + colon + 2));
    }
    pclose(pipe);
    return numbers;
}

bool has_sigrok() {
    return std::system("sigrok-cli --version >/dev/null 2>&1") == 0;
}

struct Reading {
    Duration timescale;
    const char* input;
};

class SigrokReads : public testing::TestWithParam<Reading> {};

TEST_P(SigrokReads, AsManyStepsAndCountsAsWereWritten) {
    if (!has_sigrok()) GTEST_SKIP() << "sigrok-cli is not installed: apt-get install sigrok-cli";
    const Scratch scratch;
    const std::string path = scratch.path("run.vcd");
    write_moves(path, GetParam().timescale);

    const auto rising = ask(path, GetParam().input, "counter:data=x_step:data_edge=rising", "counter=edge_count");
    ASSERT_FALSE(rising.empty());
    EXPECT_EQ(rising.back(), forward + backward);

    // Motor and encoder decoders report a position when it is left, so the last report is one step short.
    const auto places = ask(path, GetParam().input, "stepper_motor:step=x_step:dir=x_dir", "stepper_motor=position");
    ASSERT_EQ(places.size(), static_cast<std::size_t>(forward + backward - 1));
    EXPECT_EQ(places[forward - 1], forward);
    EXPECT_EQ(places.back() - 1, forward - backward);

    const auto counts = ask(path, GetParam().input, "graycode:d0=x_a:d1=x_b", "graycode=count");
    ASSERT_EQ(counts.size(), static_cast<std::size_t>(forward + backward));
    EXPECT_EQ(counts[forward], forward);
    EXPECT_EQ(counts.back() - 1, forward - backward);
}

INSTANTIATE_TEST_SUITE_P(AtTheTimescaleAndBelow, SigrokReads,
                         testing::Values(Reading{nanoseconds(100), "vcd"},
                                         Reading{nanoseconds(100), "vcd:downsample=10"},
                                         Reading{Duration{1}, "vcd:downsample=1000"}));

}  // namespace
}  // namespace motionrack::trace
