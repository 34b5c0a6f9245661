// Recordings over the C interface on a full disk: the file after a failed close, and the recovery.
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <motionrack/frontends/c/test/full_disk.hpp>
#include <motionrack/frontends/c/test/world.hpp>
#include <sstream>
#include <string>

namespace motionrack::c_test {
namespace {

using ::testing::HasSubstr;

/// Records one second of a drive; the disk is full at 0.4 s and at the end, or never.
std::string recorded(const std::string& path, bool full) {
    World world;
    world.set_up(1, 4000);
    world.command(1, 0x06, 500);
    EXPECT_EQ(mr_trace_start(world, path.c_str(), "X.step c1.xpp c1.xlp"), MR_OK) << mr_last_error();
    world.write(0x00, 0x0120);
    world.pass(400'000'000);
    if (full) {
        const FullDisk disk(20);
        const std::uint64_t hash = world.hash();
        EXPECT_EQ(mr_trace_stop(world), MR_IO);
        EXPECT_THAT(mr_last_error(), HasSubstr("The recording continues"));
        EXPECT_EQ(world.hash(), hash);
        EXPECT_EQ(mr_trace_stop(world), MR_IO) << "again";
    }
    world.pass(600'000'000);
    if (full) {
        const FullDisk disk(5000);
        EXPECT_EQ(mr_trace_stop(world), MR_IO);
    }
    EXPECT_EQ(mr_trace_stop(world), MR_OK) << mr_last_error();
    EXPECT_EQ(mr_trace_stop(world), MR_REFUSED);
    const std::string text = text_of_file(path);
    std::filesystem::remove(path);
    return text;
}

/// Removes times of a VCD file without changes: one may remain where the file would have ended.
std::string without_empty_times(const std::string& vcd) {
    std::string out;
    std::istringstream lines(vcd);
    for (std::string line, time; std::getline(lines, line);) {
        if (line.starts_with('#')) {
            time = line + '\n';
        } else {
            out += time + line + '\n';
            time.clear();
        }
    }
    return out;
}

TEST(CRack, ARecordingThatCannotEndContinuesAndCompletesOnceTheDiskHasSpace) {
    const std::string csv = temporary("f.csv"), vcd = temporary("f.vcd");
    const std::string whole = recorded(csv, false);
    EXPECT_EQ(count_of(whole, ",X.step,1\r\n"), 500);
    EXPECT_EQ(recorded(csv, true), whole);
    EXPECT_EQ(without_empty_times(recorded(vcd, true)), without_empty_times(recorded(vcd, false)));
}

TEST(CRack, ARecordingOfWhichChangesAreMissingIsLost) {
    for (const char* name : {"l.csv", "l.vcd"}) {
        const std::string path = temporary(name);
        World world;
        world.set_up(1, 4000);
        world.command(1, 0x06, 50'000);
        ASSERT_EQ(mr_trace_start(world, path.c_str(), "X.step"), MR_OK) << mr_last_error();
        world.write(0x00, 0x0120);
        {
            const FullDisk disk(20'000);
            world.pass(1'500'000'000);
        }
        EXPECT_EQ(mr_trace_stop(world), MR_IO) << "more than the buffer keeps: room comes too late";
        EXPECT_THAT(mr_last_error(), HasSubstr("The recording is lost")) << name;
        EXPECT_FALSE(std::filesystem::exists(path));
        ASSERT_EQ(mr_trace_start(world, path.c_str(), "X.step"), MR_OK) << mr_last_error();
        EXPECT_EQ(mr_trace_stop(world), MR_OK) << mr_last_error();
        std::filesystem::remove(path);
    }
}

TEST(CRack, ARecordingThatCannotBeWrittenIsReplacedByAnother) {
    const std::string full = temporary("g.vcd"), csv = temporary("g.csv");
    if (::access("/dev/full", W_OK) != 0) GTEST_SKIP() << "this system has no /dev/full";
    std::filesystem::create_symlink("/dev/full", full);
    World world;
    world.set_up(1, 4000);
    world.command(1, 0x06, 500);
    ASSERT_EQ(mr_trace_start(world, full.c_str(), "c1.xpp"), MR_OK) << mr_last_error();
    EXPECT_EQ(mr_trace_start(world, csv.c_str(), "c1.xpp"), MR_REFUSED) << "it may yet be written";
    EXPECT_EQ(mr_trace_stop(world), MR_IO);
    EXPECT_EQ(mr_trace_start(world, csv.c_str(), "Q.*"), MR_BAD_CALL);
    EXPECT_EQ(mr_trace_stop(world), MR_IO) << "it is still there";
    ASSERT_EQ(mr_trace_start(world, csv.c_str(), "c1.xpp"), MR_OK) << mr_last_error();
    world.write(0x00, 0x0120);
    world.pass(1'000'000'000);
    ASSERT_EQ(mr_trace_stop(world), MR_OK) << mr_last_error();
    EXPECT_EQ(count_of(text_of_file(csv), ",c1.xpp,1\r\n"), 500);
    std::filesystem::remove(full);
    std::filesystem::remove(csv);
}

}  // namespace
}  // namespace motionrack::c_test
