// VCD writer: bytes, names, times, and errors on a full disk.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <filesystem>
#include <limits>
#include <motionrack/trace/vcd_writer.hpp>
#include <sstream>
#include <vector>

#include "scratch.hpp"

namespace motionrack::trace {
namespace {

/// Opens a writer or fails the test by throwing.
VcdWriter open(const std::string& path, const VcdSettings& settings = {}) {
    auto writer = VcdWriter::create(path, settings);
    if (!writer) throw std::runtime_error(writer.error().text());
    return std::move(*writer);
}

TEST(VcdWriter, WritesWiresVectorsAndRealsAsTheStandardStates) {
    const Scratch vcd_scratch;
    VcdWriter vcd = open(vcd_scratch.path("a.vcd"));
    vcd.push_scope("x");
    const auto step = vcd.add_wire("step");
    const auto limit = vcd.add_wire("limit+", true);
    vcd.pop_scope();
    const auto counter = vcd.add_vector("counter", 32, 5);
    const auto velocity = vcd.add_real("velocity");
    vcd.change(step, 1, microseconds(5));
    vcd.change(counter, 6, microseconds(5));
    vcd.change(step, 0, microseconds(7));
    vcd.change(limit, 0, whole_seconds(1));
    vcd.change_real(velocity, -2.5, whole_seconds(1));
    vcd.change(counter, 0, whole_seconds(1) + Duration{1});
    ASSERT_TRUE(vcd.close(whole_seconds(2)));
    EXPECT_EQ(file_text(vcd_scratch.path("a.vcd")),
              "$version Motionrack $end\n"
              "$timescale 100 ps $end\n"
              "$scope module x $end\n"
              "$var wire 1 ! step $end\n"
              "$var wire 1 \" limitp $end\n"
              "$upscope $end\n"
              "$var wire 32 # counter [31:0] $end\n"
              "$var real 64 $ velocity $end\n"
              "$enddefinitions $end\n"
              "#0\n$dumpvars\n0!\n1\"\nb101 #\nr0 $\n$end\n"
              "#50000\n1!\nb110 #\n"
              "#70000\n0!\n"
              "#10000000000\n0\"\nr-2.5 $\n"
              "#10000000001\nb0 #\n"
              "#20000000000\n");
}

TEST(VcdWriter, WritesAValueOnlyWhenItIsNew) {
    const Scratch vcd_scratch;
    VcdWriter vcd = open(vcd_scratch.path("a.vcd"));
    const auto wire = vcd.add_wire("w");
    const auto real = vcd.add_real("r", 1.5);
    const auto nibble = vcd.add_vector("n", 4, 0x13);
    for (int i = 0; i < 10; ++i) vcd.change(wire, 0, Instant{i});
    vcd.change(nibble, 0xF3, Instant{10});
    vcd.change_real(real, 1.5, Instant{11});
    vcd.change_real(real, std::numeric_limits<double>::quiet_NaN(), Instant{11});
    vcd.change_real(real, std::numeric_limits<double>::infinity(), Instant{12});
    ASSERT_TRUE(vcd.close(Instant{12}));
    const std::string text = file_text(vcd_scratch.path("a.vcd"));
    EXPECT_EQ(text.substr(text.find("$dumpvars")), "$dumpvars\n0!\nr1.5 \"\nb11 #\n$end\n#12\n");
}

TEST(VcdWriter, KeepsTheOrderOfChangesInsideOneUnitOfACoarseTimescale) {
    const Scratch vcd_scratch;
    VcdSettings settings;
    settings.timescale = nanoseconds(100);
    VcdWriter vcd = open(vcd_scratch.path("a.vcd"), settings);
    const auto wire = vcd.add_wire("w");
    vcd.change(wire, 1, nanoseconds(250));
    vcd.change(wire, 0, nanoseconds(299));
    vcd.change(wire, 1, nanoseconds(300));
    ASSERT_TRUE(vcd.close(nanoseconds(1000)));
    const std::string text = file_text(vcd_scratch.path("a.vcd"));
    EXPECT_NE(text.find("$timescale 100 ns $end"), std::string::npos);
    EXPECT_EQ(text.substr(text.find("$dumpvars")), "$dumpvars\n0!\n$end\n#2\n1!\n0!\n#3\n1!\n#10\n");
}

TEST(VcdWriter, RefusesATimescaleThatVcdDoesNotHave) {
    const Scratch vcd_scratch;
    for (const Duration bad : {nanoseconds(125), Duration{0}, Duration{-10}, Duration{3}, whole_seconds(10)}) {
        VcdSettings settings;
        settings.timescale = bad;
        const auto writer = VcdWriter::create(vcd_scratch.path("a.vcd"), settings);
        ASSERT_FALSE(writer);
        EXPECT_EQ(writer.error().kind, ErrorKind::refused);
        const std::string seen = bad > Duration{0} ? std::to_string(bad.count() * 100) + " ps" : "this timescale";
        EXPECT_NE(writer.error().message.find(seen), std::string::npos);
    }
    EXPECT_FALSE(std::filesystem::exists(vcd_scratch.path("a.vcd")));
}

TEST(VcdWriter, MakesUniqueNamesThatEveryReaderAccepts) {
    const Scratch vcd_scratch;
    VcdWriter vcd = open(vcd_scratch.path("a.vcd"));
    vcd.push_scope("Fr\xC3\xA4se 1");
    for (const char* name : {"limit-", "", "1st", "a b", "a_b", "a.b", "x[3]", "$end"}) vcd.add_wire(name);
    ASSERT_TRUE(vcd.close(Instant{0}));
    std::istringstream text(file_text(vcd_scratch.path("a.vcd")));
    std::vector<std::string> names;
    for (std::string line; std::getline(text, line);) {
        std::istringstream words(line);
        std::string first, second, third, code, name;
        words >> first >> second >> third >> code >> name;
        if (first == "$var") names.push_back(name);
        if (first == "$scope") {
            EXPECT_EQ(third, "Fr_se_1");
        }
    }
    EXPECT_EQ(names, (std::vector<std::string>{"limitm", "_", "_1st", "a_b", "a_b_2", "a_b_3", "x_3_", "_end"}));
}

TEST(VcdWriter, CodesOfThousandsOfWiresAreUnique) {
    const Scratch vcd_scratch;
    VcdWriter vcd = open(vcd_scratch.path("a.vcd"));
    for (int i = 0; i < 20'000; ++i) vcd.add_wire(std::string("w").append(std::to_string(i)));
    ASSERT_TRUE(vcd.close(Instant{0}));
    std::istringstream text(file_text(vcd_scratch.path("a.vcd")));
    std::set<std::string> codes;
    for (std::string line; std::getline(text, line);) {
        if (line.rfind("$var", 0) == 0) codes.insert(line.substr(12, line.find(' ', 12) - 12));
    }
    EXPECT_EQ(codes.size(), 20'000U);
}

TEST(VcdWriter, ReportsAtTheEndThatTheDiskIsFull) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
    VcdWriter vcd = open("/dev/full");
    const auto wire = vcd.add_wire("w");
    for (int i = 0; i < 200'000; ++i) vcd.change(wire, static_cast<unsigned>(i + 1) & 1U, Instant{i * 1000});
    const auto closed = vcd.close(whole_seconds(1));
    ASSERT_FALSE(closed);
    EXPECT_EQ(closed.error().kind, ErrorKind::io);
    EXPECT_EQ(closed.error().file, "/dev/full");
    EXPECT_NE(closed.error().message.find("No space left"), std::string::npos);
    EXPECT_FALSE(vcd.close(whole_seconds(1))) << "changes were left out";
}

TEST(VcdWriter, DestroyedWithoutCloseLeavesTheOldFile) {
    const Scratch vcd_scratch;
    std::ofstream(vcd_scratch.path("a.vcd")) << "old";
    {
        VcdWriter vcd = open(vcd_scratch.path("a.vcd"));
        vcd.change(vcd.add_wire("w"), 1, Instant{10});
    }
    EXPECT_EQ(file_text(vcd_scratch.path("a.vcd")), "old");
    EXPECT_NE(file_text(vcd_scratch.path("a.vcd.incomplete")).find("$var"), std::string::npos);
}

TEST(VcdWriter, ReportsThatAFileCannotBeCreated) {
    const auto writer = VcdWriter::create("/nowhere/at/all/a.vcd");
    ASSERT_FALSE(writer);
    EXPECT_EQ(writer.error().kind, ErrorKind::io);
}

/// `changes`: for each change of a random file, a number that determines the gap before it, and its value.
RC_GTEST_PROP(VcdWriter, TimesAndValuesAreReadBackAsTheyWereWritten,
              (std::vector<std::pair<std::uint32_t, int>> changes)) {
    const Scratch vcd_scratch;
    VcdWriter vcd = open(vcd_scratch.path("a.vcd"));
    const auto id = vcd.add_vector("v", 64);
    Instant now{1};
    std::vector<std::pair<std::int64_t, std::uint64_t>> expected;
    std::uint64_t last = 0;
    for (const auto& [gap, value] : changes) {
        now += Duration{std::int64_t{gap} * (gap % 1000) + 1};
        const auto wide = static_cast<std::uint64_t>(static_cast<std::int64_t>(value) * 1'000'003);
        vcd.change(id, wide, now);
        if (wide != last) expected.emplace_back(now.count(), wide);
        last = wide;
    }
    RC_ASSERT(vcd.close(now).has_value());
    std::istringstream text(file_text(vcd_scratch.path("a.vcd")));
    std::vector<std::pair<std::int64_t, std::uint64_t>> read;
    std::int64_t time = 0;
    bool body = false;
    for (std::string line; std::getline(text, line);) {
        if (line[0] == '#') time = std::stoll(line.substr(1));
        if (body && line[0] == 'b') read.emplace_back(time, std::stoull(line.substr(1), nullptr, 2));
        body = body || line == "$end";
    }
    RC_ASSERT(read == expected);
}

}  // namespace
}  // namespace motionrack::trace
