// Known differences are found with name, instant and both values; equal files are equal.
#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <motionrack/trace/diff.hpp>
#include <motionrack/trace/report_csv.hpp>
#include <motionrack/trace/vcd_writer.hpp>

#include "recorded.hpp"
#include "scratch.hpp"

namespace motionrack::trace {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Diff diff_of(const PlainRecording& a, const PlainRecording& b) {
    const Scratch scratch;
    EXPECT_TRUE(a.write(scratch.path("a.h5")));
    EXPECT_TRUE(b.write(scratch.path("b.h5")));
    auto diff = diff_files(scratch.path("a.h5"), scratch.path("b.h5"));
    EXPECT_TRUE(diff) << diff.error().text();
    return diff ? *diff : Diff();
}

TEST(DiffOfRecordings, IsEmptyForARecordingAndItself) {
    const Diff diff = diff_of(busy(50'000), busy(50'000));
    EXPECT_TRUE(diff.same()) << diff_text(diff, "a", "b");
    EXPECT_EQ(diff.signals, 5u + 4 + 5 + 1);
    EXPECT_THAT(diff_text(diff, "a", "b"), HasSubstr("are the same: 15 signals"));
}

RC_GTEST_PROP(DiffOfRecordings, FindsAnEventThatComesATickLater, ()) {
    const PlainRecording a = busy(4000);
    PlainRecording b = a;
    const std::size_t i = *rc::gen::inRange<std::size_t>(10, 3990);
    if (a.events[i].signal >= 3) return;  // unchanged levels are not recorded
    ++b.events[i].at;
    const Diff diff = diff_of(a, b);
    RC_ASSERT(diff.differences.size() == 1u);
    RC_ASSERT(diff.differences[0].signal == a.head.signals[a.events[i].signal].name);
    RC_ASSERT(diff.differences[0].at == Instant{a.events[i].at});
}

TEST(DiffOfRecordings, FindsAMissingPulseAndAWrongValueInTheOrderOfTime) {
    PlainRecording a = busy(4000), b = a;
    b.events.erase(b.events.begin() + 3500);  // signal 0
    b.samples[20].axes[1].position += 1e-12;
    const Diff diff = diff_of(a, b);
    ASSERT_EQ(diff.differences.size(), 2u);
    EXPECT_EQ(diff.differences[0].signal, "Y.position");
    EXPECT_EQ(diff.differences[0].at, Instant{a.samples[20].at});
    EXPECT_EQ(diff.differences[0].a, "-0.5");
    EXPECT_EQ(diff.differences[1].signal, a.head.signals[a.events[3500].signal].name);
    EXPECT_EQ(diff.differences[1].at, Instant{a.events[3500].at});
    const std::string text = diff_text(diff, "a", "b");
    EXPECT_THAT(text, HasSubstr("2 of 15 signals differ. The first difference:\n  Y.position, mm, at "));
    EXPECT_THAT(text, HasSubstr(" ns, tick " + std::to_string(a.samples[20].at)));
}

TEST(DiffOfRecordings, ReportsTheirSourcesAndSignalsOfOneAlone) {
    PlainRecording a = busy(100), b = a;
    b.head.program = "G21 G90\nG1 X2 F600\nM2\n";
    b.head.inputs = {{milliseconds(1), "hold"}};
    b.head.signals.push_back({"estop", "wires/rack/estop", SignalKind::levels, "", 1});
    b.head.version = "9.9.9";
    b.end.outcome[1].text = "fedcba9876543210";
    const Diff diff = diff_of(a, b);
    EXPECT_TRUE(diff.differences.empty());
    EXPECT_THAT(diff.only_b, ElementsAre("estop"));
    EXPECT_THAT(diff.made_of, ElementsAre("the programs differ, first in line 2", HasSubstr("hold at 0.0010000 s"),
                                          HasSubstr("trace_hash")));
    EXPECT_EQ(diff.notes.size(), 1u);
    EXPECT_FALSE(diff.same());
}

TEST(DiffOfRecordings, OfATruncatedRecordingComparesUpToItsEnd) {
    const Scratch scratch;
    const PlainRecording plain = busy(4000);
    ASSERT_TRUE(plain.write(scratch.path("whole.h5")));
    {
        PlainRecording first = plain;
        first.events.resize(2000);
        std::erase_if(first.samples, [&](const PlainSample& sample) { return sample.at > first.events.back().at; });
        auto writer = RecordingWriter::create(scratch.path("cut.h5"), first.head, Instant{0});
        ASSERT_TRUE(writer);
        first.write(*writer);
        writer->flush(Instant{first.events.back().at + 1});
        // An unfinished file is read beside its writer.
        const auto diff = diff_files(scratch.path("cut.h5.incomplete"), scratch.path("whole.h5"));
        ASSERT_TRUE(diff) << diff.error().text();
        EXPECT_TRUE(diff->same()) << diff_text(*diff, "cut", "whole");
        EXPECT_EQ(diff->until, Instant{first.events.back().at + 1});
    }
}

// ---- VCD

struct Waves {
    std::vector<std::pair<int, std::uint64_t>> changes;  ///< signal, value; 1 us apart
    Duration timescale{1};
    int signals = 3;
};

void write_vcd(const Waves& waves, const std::string& path) {
    VcdSettings settings;
    settings.timescale = waves.timescale;
    auto vcd = VcdWriter::create(path, settings);
    ASSERT_TRUE(vcd);
    vcd->push_scope("x");
    std::vector<VcdWriter::Id> ids;
    for (int i = 0; i < waves.signals; ++i)
        ids.push_back(i == 0 ? vcd->add_wire("step") : vcd->add_vector("v" + std::to_string(i), 16));
    vcd->pop_scope();
    std::int64_t at = 0;
    for (const auto& [signal, value] : waves.changes)
        vcd->change(ids[static_cast<std::size_t>(signal)], value, microseconds(++at));
    ASSERT_TRUE(vcd->close(microseconds(at + 1)));
}

Result<Diff> diff_of(const Waves& a, const Waves& b) {
    const Scratch scratch;
    write_vcd(a, scratch.path("a.vcd"));
    write_vcd(b, scratch.path("b.vcd"));
    return diff_files(scratch.path("a.vcd"), scratch.path("b.vcd"));
}

TEST(DiffOfWaves, ComparesValuesAtInstantsWhateverTheTimescale) {
    const Waves a{{{0, 1}, {1, 77}, {0, 0}, {2, 9}, {1, 78}}};
    Waves same = a, other = a;
    same.timescale = nanoseconds(1);
    other.changes[3].second = 10;
    EXPECT_TRUE(diff_of(a, same)->same());
    const auto diff = diff_of(a, other);
    ASSERT_TRUE(diff) << diff.error().text();
    ASSERT_EQ(diff->differences.size(), 1u);
    EXPECT_EQ(diff->differences[0].signal, "x.v2");
    EXPECT_EQ(diff->differences[0].at, microseconds(4));
    EXPECT_EQ(diff->differences[0].a, "1001");
    EXPECT_EQ(diff->differences[0].b, "1010");
    EXPECT_EQ(diff->signals, 3u);
}

TEST(DiffOfWaves, FindsAChangeThatIsMissingAndAVariableThatIs) {
    const Waves a{{{0, 1}, {1, 77}, {0, 0}}};
    Waves missing = a;
    missing.changes.pop_back();
    missing.signals = 4;
    const auto diff = diff_of(a, missing);
    ASSERT_TRUE(diff);
    ASSERT_EQ(diff->differences.size(), 1u);
    EXPECT_EQ(diff->differences[0].signal, "x.step");
    EXPECT_EQ(diff->differences[0].at, microseconds(3));
    EXPECT_THAT(diff->only_b, ElementsAre("x.v3"));
}

Result<Diff> diff_of_texts(const std::string& a, const std::string& b, const std::string& ending) {
    const Scratch scratch;
    std::ofstream(scratch.path("a." + ending), std::ios::binary) << a;
    std::ofstream(scratch.path("b." + ending), std::ios::binary) << b;
    return diff_files(scratch.path("a." + ending), scratch.path("b." + ending));
}

TEST(DiffOfWaves, ReportsWhereAVcdFileIsInvalid) {
    const std::string head =
        "$timescale 1 ns $end $scope module x $end $var wire 1 ! a $end $upscope $end $enddefinitions $end\n";
    for (const std::string& bad :
         {std::string("$timescale 1 ns"), std::string("$timescale 3 ns $end"), head + "#5 #4\n", head + "1? \n",
          head + "hello \n", head + "#-1 \n", std::string("$var wire 1 $end"), std::string("$upscope $end"),
          std::string("$enddefinitions $end"), head + "#99999999999999999999999 \n",
          "$timescale 1 ns $end $var wire 1 ! " + std::string(1001, 'a') + " $end $enddefinitions $end\n",
          "$timescale 1 ns $end $scope module " + std::string(1000, 'a') + " $end $enddefinitions $end\n"}) {
        const auto diff = diff_of_texts(head + "#5 1! \n", bad, "vcd");
        ASSERT_FALSE(diff) << bad;
        EXPECT_EQ(diff.error().kind, ErrorKind::invalid_input);
    }
    EXPECT_TRUE(diff_of_texts(head + "#5 1!\n", head + "$comment x $end #5\n$dumpvars 1! $end\n#9\n", "vcd")->same());
}

// ---- CSV

TEST(DiffOfTables, FindsTheFirstFieldOfEachColumnThatDiffers) {
    const auto diff =
        diff_of_texts("time_s,x_position_mm,note\r\n0,0,a\r\n0.001,0.5,\"b,c\"\r\n0.002,0.75,d\r\n",
                      "time_s,x_position_mm,note,more\n0,0.0,a,1\n1e-3,5e-1,\"b,d\",1\n0.002,0.76,e,1\n", "csv");
    ASSERT_TRUE(diff) << diff.error().text();
    ASSERT_EQ(diff->differences.size(), 2u);
    EXPECT_EQ(diff->differences[0].signal, "note");
    EXPECT_EQ(diff->differences[0].at, milliseconds(1));
    EXPECT_EQ(diff->differences[0].b, "b,d");
    EXPECT_EQ(diff->differences[1].signal, "x_position_mm");
    EXPECT_EQ(diff->differences[1].at, milliseconds(2));
    EXPECT_THAT(diff->only_b, ElementsAre("more"));
}

TEST(DiffOfTables, PairsColumnsOfOneNameInTheirOrder) {
    EXPECT_TRUE(diff_of_texts("a,a,b\n1,2,3\n", "a,b,a\n1,3,2\n", "csv")->same());
}

TEST(DiffOfTables, ReportsWhichOneEndsFirst) {
    const auto diff = diff_of_texts("time_s,a\n0,1\n0.001,2\n", "time_s,a\n0,1\n", "csv");
    ASSERT_TRUE(diff);
    ASSERT_EQ(diff->differences.size(), 1u);
    EXPECT_EQ(diff->differences[0].signal, "number of rows");
    EXPECT_EQ(diff->differences[0].b, "ends after 1 rows");
    EXPECT_EQ(diff->differences[0].at, milliseconds(1));
}

TEST(DiffOfTables, ComparesTablesOfChangesByInstant) {
    const auto diff = diff_of_texts("time_s,signal,value\n0,X.step,0\n0.0000001250,X.step,1\n",
                                    "time_s,signal,value\n0,X.step,0\n0.0000001251,X.step,1\n", "csv");
    ASSERT_TRUE(diff) << diff.error().text();
    ASSERT_EQ(diff->differences.size(), 1u);
    EXPECT_EQ(diff->differences[0].at, Instant{1250});
    EXPECT_THAT(diff_text(*diff, "a", "b"),
                HasSubstr("X.step, at 0.0000001250 s (125.0 ns, tick 1250)\n    A: 1\n    B: 0\n"));
}

TEST(Diff, RejectsFilesOfDifferentAndUnknownKinds) {
    const Scratch scratch;
    std::ofstream(scratch.path("a.csv")) << "time_s,a\n0,1\n";
    std::ofstream(scratch.path("b.vcd")) << "$timescale 1 ns $end $enddefinitions $end\n";
    std::ofstream(scratch.path("c.bin")) << "\x01\x02";
    EXPECT_THAT(diff_files(scratch.path("a.csv"), scratch.path("b.vcd")).error().message, HasSubstr("same kind"));
    EXPECT_THAT(diff_files(scratch.path("a.csv"), scratch.path("c.bin")).error().message,
                HasSubstr("Unknown file format"));
    EXPECT_EQ(diff_files(scratch.path("a.csv"), scratch.path("nowhere")).error().kind, ErrorKind::io);
}

TEST(ReportFromCsv, ShowsTheColumnsThatAreThere) {
    const Scratch scratch;
    std::ofstream(scratch.path("a.csv"))
        << "time_s,x_position_mm,a_velocity_deg_s,y_drive_v,deviation_mm,driven_x_mm,driven_y_mm,driven_z_mm,other\n"
           "0,1,-7,3,0.5,1,2,3,q\n0.001,1.5,,4,,1,2,3,q\n";
    const auto data = report_from_csv(scratch.path("a.csv"));
    ASSERT_TRUE(data) << data.error().text();
    ASSERT_EQ(data->axes.size(), 3u);
    EXPECT_THAT(data->axes[0].position, ElementsAre(1.0F, 1.5F));
    EXPECT_EQ(data->axes[1].name, "A");
    EXPECT_EQ(data->axes[1].unit, "deg");
    EXPECT_EQ(data->axes[1].peak_velocity, 7);
    EXPECT_TRUE(data->axes[2].servo);
    EXPECT_EQ(data->driven.size(), 2u);
    std::ofstream(scratch.path("sheet.csv")) << "\xEF\xBB\xBFtime_s,x_position_mm\r\n0,1\r\n\r\n1,2\r\n\r\n";
    const auto sheet = report_from_csv(scratch.path("sheet.csv"));
    ASSERT_TRUE(sheet) << sheet.error().text();
    EXPECT_THAT(sheet->axes[0].position, ElementsAre(1.0F, 2.0F))
        << "a byte order mark and empty lines are a spreadsheet's";
    std::ofstream(scratch.path("b.csv")) << "time_s,event\n0,move\n";
    EXPECT_FALSE(report_from_csv(scratch.path("b.csv")));
    std::ofstream(scratch.path("former.csv")) << "time_s,x_position_mm,x_speed_mm_s\n0,1,2\n";
    const auto former = report_from_csv(scratch.path("former.csv"));
    ASSERT_FALSE(former);
    EXPECT_EQ(former.error().message,
              "The column 'x_speed_mm_s' is now 'x_velocity_mm_s'. The file was not read; rename the column.");
    std::ofstream(scratch.path("c.csv")) << "time_s,x_position_mm\n1,1\n0,1\n";
    EXPECT_FALSE(report_from_csv(scratch.path("c.csv")));
}

}  // namespace
}  // namespace motionrack::trace
