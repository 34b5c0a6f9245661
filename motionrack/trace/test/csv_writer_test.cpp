// The CSV writer: quoting, numbers, column headers with units, full disks.
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <motionrack/trace/csv_writer.hpp>

#include "scratch.hpp"

namespace motionrack::trace {
namespace {

TEST(CsvWriter, QuotesFieldsAsInRfc4180) {
    const Scratch scratch;
    auto csv = CsvWriter::create(scratch.path("a.csv"), {"time_s", "a,b", "say \"hi\"", "line\nbreak"});
    ASSERT_TRUE(csv);
    csv->add(0.1);
    csv->add(std::int64_t{-7});
    csv->add(std::string_view("plain"));
    csv->add(std::string_view("\""));
    csv->end_line();
    ASSERT_TRUE(csv->close());
    EXPECT_EQ(file_text(scratch.path("a.csv")),
              "time_s,\"a,b\",\"say \"\"hi\"\"\",\"line\nbreak\"\r\n0.1,-7,plain,\"\"\"\"\r\n");
}

TEST(CsvWriter, WritesNumbersThatReadBackTheSameAndOmitsMissingOnes) {
    const Scratch scratch;
    auto csv = CsvWriter::create(scratch.path("a.csv"), {"a", "b", "c", "d", "e"});
    ASSERT_TRUE(csv);
    csv->add(0.1 + 0.2);
    csv->add(0.1F);
    csv->add(-0.0);
    csv->add(std::numeric_limits<double>::quiet_NaN());
    csv->add(std::numeric_limits<float>::infinity());
    csv->end_line();
    ASSERT_TRUE(csv->close());
    EXPECT_EQ(file_text(scratch.path("a.csv")), "a,b,c,d,e\r\n0.30000000000000004,0.1,0,,\r\n");
}

TEST(WriteCsv, NamesEveryColumnWithItsUnit) {
    ReportData data;
    data.seconds = {0, 0.001};
    data.axes.resize(2);
    data.axes[0].name = std::string("X");
    data.axes[0].position = {0, 0.0125F};
    data.axes[0].velocity = {0, 25};
    data.axes[0].accel = {500, 500};
    data.axes[1].name = std::string("A");
    data.axes[1].unit = "deg";
    data.axes[1].position = {90};
    data.driven = {{0, 0, 0}, {0.0125, 0, -1}};
    data.deviation_mm = {0, 0.001F};
    const Scratch scratch;
    ASSERT_TRUE(write_csv(data, scratch.path("a.csv")));
    EXPECT_EQ(file_text(scratch.path("a.csv")),
              "time_s,x_position_mm,x_velocity_mm_s,x_acceleration_mm_s2,a_position_deg,deviation_mm,"
              "driven_x_mm,driven_y_mm,driven_z_mm\r\n"
              "0,0,0,500,90,0,0,0,0\r\n"
              "0.001,0.0125,25,500,,0.001,0.0125,0,-1\r\n");
}

TEST(WriteEventsCsv, WritesMovesWarningsMaximumDeviationAndStopInOrderOfTime) {
    ReportData data;
    data.seconds = {0, 1, 2};
    data.driven = {{0, 0, 5}, {10, 0, 5}, {10, 4, 5}};
    data.moves.resize(2);
    data.moves[0].line = 3;
    data.moves[0].kind = "line";
    data.moves[1].line = 4;
    data.moves[1].kind = "arc";
    data.moves[1].start = 1;
    data.warnings = {{1.5, 4, "Y, close to \"+\""}, {-1, 0, "No instant"}, {7, 0, "Later than the path"}};
    data.max_deviation = ReportMaxDeviation{0.25, 0.5, 3, {5, 0.25, 5}};
    data.stop = ReportStop{2, 4, {10, 4, 5}, "Limit switch"};
    const Scratch scratch;
    ASSERT_TRUE(write_events_csv(data, scratch.path("e.csv")));
    EXPECT_EQ(file_text(scratch.path("e.csv")),
              "time_s,event,line,x_mm,y_mm,z_mm,text\r\n"
              ",warning,,,,,No instant\r\n"
              "0,move,3,0,0,5,line\r\n"
              "0.5,max deviation,3,5,0.25,5,0.25 mm\r\n"
              "1,move,4,10,0,5,arc\r\n"
              "1.5,warning,4,10,2,5,\"Y, close to \"\"+\"\"\"\r\n"
              "2,stop,4,10,4,5,Limit switch\r\n"
              "7,warning,,,,,Later than the path\r\n");
}

TEST(CsvWriter, DestroyedWithoutCloseLeavesTheOldFile) {
    const Scratch scratch;
    std::ofstream(scratch.path("a.csv")) << "old";
    {
        auto csv = CsvWriter::create(scratch.path("a.csv"), {"a"});
        ASSERT_TRUE(csv);
        csv->add(std::string_view("half"));
    }
    EXPECT_EQ(file_text(scratch.path("a.csv")), "old");
    EXPECT_NE(file_text(scratch.path("a.csv.incomplete")).find("half"), std::string::npos);
}

TEST(CsvWriter, ReportsAtTheEndThatTheDiskIsFull) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
    auto csv = CsvWriter::create("/dev/full", {"a"});
    ASSERT_TRUE(csv);
    for (std::int64_t i = 0; i < 100'000; ++i) {
        csv->add(i);
        csv->end_line();
    }
    const auto closed = csv->close();
    ASSERT_FALSE(closed);
    EXPECT_EQ(closed.error().kind, ErrorKind::io);
    EXPECT_NE(closed.error().message.find("No space left"), std::string::npos);
    EXPECT_FALSE(csv->close()) << "lines were left out";
    EXPECT_FALSE(CsvWriter::create("/nowhere/at/all.csv", {"a"}));
}

}  // namespace
}  // namespace motionrack::trace
