// HDF5 recordings over the C interface, read back by the C++ reader.
#include <gmock/gmock.h>

#include <filesystem>
#include <motionrack/frontends/c/test/full_disk.hpp>
#include <motionrack/frontends/c/test/world.hpp>
#include <motionrack/trace/recording.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace motionrack::c_test {
namespace {

using ::testing::HasSubstr;
using Changes = std::vector<std::pair<std::int64_t, std::int64_t>>;  // instant in ticks, value

/// Changes of a signal in the recording, without its initial value.
Changes read(const trace::RecordingReader& recording, const std::string& name) {
    const trace::RecordedSeries* series = recording.find(name);
    EXPECT_NE(series, nullptr) << name;
    if (series == nullptr) return {};
    const auto columns = recording.columns(*series);
    EXPECT_TRUE(columns) << name;
    std::vector<std::int64_t> times(columns->size), values(columns->size);
    EXPECT_TRUE(columns->time.read(0, times.size(), times.data()));
    EXPECT_TRUE(columns->value.read(0, values.size(), values.data()));
    Changes out;
    for (std::size_t i = 0; i < times.size(); ++i) out.emplace_back(times[i], values[i]);
    return out;
}

/// Changes of a signal in a CSV recording, without its initial value; values in multiples of `unit`.
Changes of_csv(const std::string& text, const std::string& name, double unit = 1) {
    std::istringstream lines(text);
    Changes out;
    bool first = true;
    for (std::string line; std::getline(lines, line);) {
        const std::size_t comma = line.find(',');
        if (line.compare(comma + 1, name.size() + 1, name + ",") != 0) continue;
        if (!std::exchange(first, false)) {
            std::string at = line.substr(0, comma);
            at.erase(at.find('.'), 1);
            out.emplace_back(std::stoll(at), std::llround(std::stod(line.substr(comma + name.size() + 2)) / unit));
        }
    }
    return out;
}

/// Records one second of a drive of X.
void record(const std::string& path, const char* signals) {
    World world;
    world.set_up(1, 4000);
    world.command(1, 0x06, 500);
    world.pass(1'000);
    ASSERT_EQ(mr_trace_start(world, path.c_str(), signals), MR_OK) << mr_last_error();
    world.write(0x00, 0x0120);
    world.pass(700'000'000);
    world.set("c1.xin0", 0);
    world.pass(300'000'000);
    EXPECT_EQ(mr_trace_stop(world), MR_OK) << mr_last_error();
}

TEST(CHdf5, HasTheSameChangesAsTheTable) {
    const std::string h5 = temporary("w.h5"), csv = temporary("w.csv");
    record(h5, "X.* c1.xlp c1.xpp c1.xin0");
    record(csv, "X.* c1.xlp c1.xpp c1.xin0");
    const std::string table = text_of_file(csv);
    const auto recording = trace::RecordingReader::open(h5);
    ASSERT_TRUE(recording) << recording.error().text();
    EXPECT_TRUE(recording->whole());
    EXPECT_EQ(recording->began().count(), 47'500) << "15 accesses and 1 us, in ticks of 100 ps";
    EXPECT_GE(recording->head().signals.size(), 7u);
    for (const trace::RecordedSignal& signal : recording->head().signals) {
        EXPECT_EQ(read(*recording, signal.name), of_csv(table, signal.name)) << signal.name;
        EXPECT_THAT(signal.path, HasSubstr("wires/"));
    }
    EXPECT_EQ(read(*recording, "X.step").size(), 1000u);
    EXPECT_EQ(read(*recording, "c1.xin0").size(), 1u);
    std::filesystem::remove(h5);
    std::filesystem::remove(csv);
}

TEST(CHdf5, VoltagesHaveTheirUnit) {
    const std::string h5 = temporary("v.h5");
    World world("card.b1 = \"databoard4002\"");
    ASSERT_EQ(mr_trace_start(world, h5.c_str(), "b1.vout b1.relay"), MR_OK) << mr_last_error();
    world.pass(1'000'000);
    ASSERT_EQ(mr_trace_stop(world), MR_OK) << mr_last_error();
    const auto recording = trace::RecordingReader::open(h5);
    ASSERT_TRUE(recording) << recording.error().text();
    for (const trace::RecordedSignal& signal : recording->head().signals) {
        EXPECT_EQ(signal.unit, signal.name == "b1.vout" ? "V" : "");
        EXPECT_EQ(signal.scale == 1, signal.name != "b1.vout");
    }
    std::filesystem::remove(h5);
}

TEST(CHdf5, AFullDiskAndAMissingFolderAreReported) {
    World world;
    EXPECT_EQ(mr_trace_start(world, "/no/such/folder/a.h5", nullptr), MR_IO);
    EXPECT_THAT(mr_last_error(), HasSubstr("/no/such/folder/a.h5"));
    EXPECT_EQ(mr_trace_stop(world), MR_REFUSED);

    const std::string h5 = temporary("full.h5"), csv = temporary("full.csv");
    world.set_up(1, 4000);
    world.command(1, 0x06, 50'000);
    ASSERT_EQ(mr_trace_start(world, h5.c_str(), "X.step"), MR_OK) << mr_last_error();
    world.write(0x00, 0x0120);
    {
        const FullDisk disk(20'000);
        world.pass(1'500'000'000);
        const std::uint64_t hash = world.hash();
        EXPECT_EQ(mr_trace_stop(world), MR_IO);
        EXPECT_THAT(mr_last_error(), HasSubstr("The recording is lost"));
        EXPECT_EQ(world.hash(), hash);
    }
    world.pass(100'000'000);
    EXPECT_EQ(mr_trace_stop(world), MR_IO) << "it stays lost";
    ASSERT_EQ(mr_trace_start(world, csv.c_str(), "X.step"), MR_OK) << mr_last_error();
    world.pass(100'000'000);
    EXPECT_EQ(mr_trace_stop(world), MR_OK) << mr_last_error();
    EXPECT_FALSE(std::filesystem::exists(h5));
    std::filesystem::remove(h5 + ".incomplete");
    std::filesystem::remove(csv);
}

TEST(CHdf5, AnInterruptedRecordingIsReadableUpToItsLastSecond) {
    const std::string h5 = temporary("cut.h5"), seen = temporary("cut_seen.h5");
    World world;
    world.set_up(1, 4000);
    world.command(1, 0x06, 500'000);
    ASSERT_EQ(mr_trace_start(world, h5.c_str(), "X.step"), MR_OK) << mr_last_error();
    world.write(0x00, 0x0120);
    world.pass(3'900'000'000);
    std::filesystem::copy_file(h5 + ".incomplete", seen);  // as a program leaves it that is killed now
    const auto recording = trace::RecordingReader::open(seen);
    ASSERT_TRUE(recording) << recording.error().text();
    EXPECT_FALSE(recording->whole());
    EXPECT_GE(recording->known_to() - recording->began(), milliseconds(2'800));
    EXPECT_GT(read(*recording, "X.step").size(), 100'000u);
    EXPECT_EQ(mr_trace_stop(world), MR_OK) << mr_last_error();
    std::filesystem::remove(h5);
    std::filesystem::remove(seen);
}

TEST(CHdf5, ALostRecordingAndARefusedNextOneLeaveTheRackRunning) {
    const std::filesystem::path folder = temporary("gone");
    std::filesystem::create_directory(folder);
    World world;
    ASSERT_EQ(mr_trace_start(world, (folder / "a.h5").c_str(), "c1.xlp"), MR_OK) << mr_last_error();
    world.pass(1'000'000);
    std::filesystem::remove_all(folder);
    EXPECT_EQ(mr_trace_stop(world), MR_IO);
    EXPECT_THAT(mr_last_error(), HasSubstr("The recording is lost"));
    EXPECT_EQ(mr_trace_start(world, temporary("b.csv").c_str(), "Q.*"), MR_BAD_CALL);
    EXPECT_EQ(mr_trace_stop(world), MR_REFUSED) << "the lost one was discarded";
    world.pass(10'000'000);
    EXPECT_EQ(mr_now_ns(world), 11'000'000u);
}

TEST(CHdf5, AFullDiskAtTheEndIsReportedAndTheFileDoesNotGetItsName) {
    World world;
    world.set_up(1, 4000);
    const std::string h5 = temporary("end.h5"), part = h5 + ".incomplete";
    for (const rlim_t beyond : {0, 1, 500, 2'000}) {  // data written up to that point fits
        SCOPED_TRACE(beyond);
        ASSERT_EQ(mr_trace_start(world, h5.c_str(), "X.step"), MR_OK) << mr_last_error();
        world.command(1, 0x06, 500);
        world.write(0x00, 0x0120);
        world.pass(1'000'000'000);
        const std::uint64_t hash = world.hash();
        {
            const FullDisk disk(std::filesystem::file_size(part) + beyond);
            EXPECT_EQ(mr_trace_stop(world), MR_IO);
        }
        EXPECT_THAT(mr_last_error(), HasSubstr("was not renamed"));
        EXPECT_EQ(world.hash(), hash);
        EXPECT_FALSE(std::filesystem::exists(h5));
        const auto cut_off = trace::RecordingReader::open(part);
        EXPECT_FALSE(cut_off && cut_off->whole());
    }
    ASSERT_EQ(mr_trace_start(world, h5.c_str(), "X.step"), MR_OK) << mr_last_error();
    EXPECT_EQ(mr_trace_stop(world), MR_OK) << "with room again: " << mr_last_error();
    std::filesystem::remove(h5);
    std::filesystem::remove(part);
}

TEST(CHdf5, ClosingARackReportsTheStateOfItsRecording) {
    const std::string h5 = temporary("closed.h5");
    mr_rack* rack = nullptr;
    ASSERT_EQ(mr_rack_open(one_card, &rack), MR_OK);
    ASSERT_EQ(mr_trace_start(rack, h5.c_str(), "X.step"), MR_OK) << mr_last_error();
    ASSERT_EQ(mr_advance_ns(rack, 1'000'000), MR_OK);
    EXPECT_EQ(mr_trace_unit(rack, 7), MR_REFUSED);
    const std::string before = mr_last_error();
    {
        const FullDisk disk(std::filesystem::file_size(h5 + ".incomplete"));
        mr_rack_close(rack);
    }
    EXPECT_NE(mr_last_error(), before);
    EXPECT_THAT(mr_last_error(), HasSubstr("was not renamed"));
    EXPECT_FALSE(std::filesystem::exists(h5));
    std::filesystem::remove(h5 + ".incomplete");
}

}  // namespace
}  // namespace motionrack::c_test
