// Captures as logic analysers write them, and malformed ones: each has a clear result or an error with its location.
#include <gtest/gtest.h>

#include <motionrack/decode/analysis.hpp>
#include <motionrack/decode/report.hpp>

#include "referee.hpp"

namespace motionrack::decode {
namespace {

Result<std::unique_ptr<Capture>> opened(std::string_view text, const std::string& name,
                                        const CaptureSettings& settings = {}) {
    return open_capture(from_memory(text), name, settings);
}

Result<Analysis> analysed(std::string_view text, const std::string& name, const std::vector<std::string>& channels = {},
                          const CaptureSettings& settings = {}, const AnalysisSettings& how = {}) {
    MOTIONRACK_TRY(const auto capture, opened(text, name, settings));
    MOTIONRACK_TRY(const auto choices, choose_channels(capture->signals(), channels));
    return analyse(*capture, choices, how);
}

/// Returns the error for a refused `text`, with its location; "not refused" if there is no error.
std::string refusal(std::string_view text, const std::string& name, const std::vector<std::string>& channels = {},
                    const CaptureSettings& settings = {}) {
    const auto analysis = analysed(text, name, channels, settings);
    if (analysis) return "not refused";
    EXPECT_NE(analysis.error().kind, ErrorKind::io);
    return analysis.error().text();
}

::testing::AssertionResult has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos ? ::testing::AssertionSuccess()
                                                : ::testing::AssertionFailure() << text << "\nhas no '" << part << "'";
}

const std::string vcd_head =
    "$timescale 1 us $end\n$scope module top $end\n$var wire 1 ! X.enc_a $end\n$var wire 1 \" X.enc_b $end\n$var wire "
    "1 # X.enc_z $end\n"
    "$var wire 4 $ bus [3:0] $end\n$var real 64 % speed $end\n$upscope $end\n$enddefinitions $end\n";

// ---- VCD

TEST(VcdCapture, CountsWithTimesAndIndexes) {
    const auto analysis = analysed(
        vcd_head +
            "#0\n$dumpvars 0! 0\" 0# b0 $ r1.5 % $end\n#100 1!\n#200\n1\" r2 %\n#300 0! 1#\n#400 0#\n#500 1!\n#1000\n",
        "a.vcd");
    ASSERT_TRUE(analysis) << analysis.error().text();
    ASSERT_EQ(analysis->channels.size(), 1u);
    const ChannelResult& x = analysis->channels[0];
    EXPECT_EQ(x.name, "X");
    EXPECT_EQ(x.a, "top.X.enc_a");
    EXPECT_EQ(x.count, 2);
    EXPECT_EQ(x.up, 3u);
    EXPECT_EQ(x.down, 1u);
    EXPECT_EQ(x.illegal, 0u);
    ASSERT_EQ(x.first_indexes.size(), 1u);
    EXPECT_EQ(x.first_indexes[0].count, 3);
    EXPECT_DOUBLE_EQ(x.first_indexes[0].time_s, 300e-6);
    EXPECT_DOUBLE_EQ(x.seconds, 1e-3);
    EXPECT_DOUBLE_EQ(x.mean_per_s, 2000);
    ASSERT_TRUE(x.peak);
    EXPECT_DOUBLE_EQ(x.peak->counts_per_s, 2000);
    EXPECT_FALSE(analysis->cut);
}

TEST(VcdCapture, TakesBitsOfVectors) {
    const auto analysis = analysed(vcd_head + "#0 b0 $\n#1 b100 $\n#2 b1100 $\n#3 b1000 $\n#4 b0 $\n#5 b11xx $\n",
                                   "a.vcd", {"E=bus[2],bus[3]", "F=bus[0],bus[1]"});
    ASSERT_TRUE(analysis) << analysis.error().text();
    EXPECT_EQ(analysis->channels[0].count, 4);
    EXPECT_EQ(analysis->channels[0].illegal, 1u);
    EXPECT_EQ(analysis->channels[0].first_illegal[0].sample, 5u);
    EXPECT_DOUBLE_EQ(analysis->channels[0].first_illegal[0].time_s, 5e-6);
    ASSERT_EQ(analysis->channels[1].notes.size(), 2u);
    EXPECT_EQ(analysis->channels[1].notes[0].unknown, 1u);
}

TEST(VcdCapture, KeepsTheLevelOfALineAtXOrZAndCountsTheseSamples) {
    const auto analysis = analysed(vcd_head + "#0 0! 0\" 0#\n#1 1!\n#2 x!\n#3 X!\n#4 1!\n#5 z!\n#6 1\" 0!\n", "a.vcd");
    ASSERT_TRUE(analysis);
    const ChannelResult& x = analysis->channels[0];
    EXPECT_EQ(x.count, 1);
    EXPECT_EQ(x.illegal, 1u);
    ASSERT_EQ(x.notes.size(), 1u);
    EXPECT_EQ(x.notes[0].unknown, 2u);
    EXPECT_EQ(x.notes[0].first_unknown, "line 12");
    EXPECT_TRUE(has(analysis_warnings(*analysis).at(0), "X or Z 2 times"));
}

TEST(VcdCapture, StartsAChannelOnceAllItsLinesHaveALevel) {
    const auto late = analysed(vcd_head + "#0 x! 0\" 0#\n#5 1\"\n#7 1!\n#9 0\"\n", "a.vcd");
    ASSERT_TRUE(late);
    EXPECT_EQ(late->channels[0].count, -1) << "A came up with a level, not by an edge";
    EXPECT_EQ(late->channels[0].illegal, 0u);
    EXPECT_TRUE(has(analysis_warnings(*late).at(0), "no level before 7e-06 s"));
    const auto never = analysed(vcd_head + "#0 0! x\" 0#\n#5 1!\n", "a.vcd");
    ASSERT_TRUE(never);
    EXPECT_EQ(never->channels[0].up, 0u);
    EXPECT_TRUE(has(analysis_warnings(*never).at(0), "has no level in the whole capture"));
}

TEST(VcdCapture, RefusesTimeThatGoesBackwardsWithItsLine) {
    const std::string text = refusal(vcd_head + "#0 0! 0\" 0#\n#100 1!\n#99 1\"\n#200 0!\n", "a.vcd");
    EXPECT_TRUE(has(text, "a.vcd:12:1: Time goes backwards, from #100 to #99."));
}

TEST(VcdCapture, DecodesATruncatedFileToItsLastCompleteValue) {
    for (const std::string end :
         {"#300 b10", "#300 1", "#300 b1 \n", "#", "#300 $comment so", "#20", "r1.5", "1(", "junk"}) {
        const auto analysis = analysed(vcd_head + "#0 0! 0\" 0#\n#100 1!\n#200 1\"\n" + end, "a.vcd");
        ASSERT_TRUE(analysis) << end << ": " << analysis.error().text();
        EXPECT_EQ(analysis->channels[0].count, 2) << end;
        ASSERT_TRUE(analysis->cut) << end;
        EXPECT_EQ(analysis->cut->location.line, 13) << end;
        EXPECT_TRUE(has(analysis->cut->text(), "cut off")) << end;
    }
    EXPECT_TRUE(has(refusal(vcd_head.substr(0, 60), "a.vcd"), "a.vcd:3:15: The file ends inside its header"));
    EXPECT_TRUE(has(refusal("$comment", "a.vcd"), "cut off. Nothing was decoded."));
}

TEST(VcdCapture, RejectsInvalidVcdFilesWithThePosition) {
    EXPECT_TRUE(has(refusal("hello world\n", "a.vcd"), "a.vcd:1:1: 'hello'"));
    EXPECT_TRUE(has(refusal("$enddefinitions $end\n#0\n", "a.vcd"), "no $timescale"));
    EXPECT_TRUE(has(refusal("$timescale 7 us $end $enddefinitions $end\n", "a.vcd"), "'7us'"));
    EXPECT_TRUE(has(refusal("$timescale 1 us $end $var wire x ! a $end\n", "a.vcd"), "width 'x'"));
    EXPECT_TRUE(has(refusal("$timescale 1 us $end $var wire $end\n", "a.vcd"), "1 words"));
    EXPECT_TRUE(has(refusal(vcd_head + "#0\n  nonsense\n#1\n", "a.vcd"), "a.vcd:11:3: 'nonsense'"));
    EXPECT_TRUE(has(refusal(vcd_head + "#0 1(\n#1\n", "a.vcd"), "'('"));
    EXPECT_TRUE(has(refusal(vcd_head + "#0 b12 !\n#1\n", "a.vcd"), "'b12'"));
    EXPECT_TRUE(has(refusal(vcd_head + "#0 1\n#1\n", "a.vcd"), "without the code"));
    EXPECT_TRUE(has(refusal(vcd_head + "#99999999999999999999\n#1\n", "a.vcd"), "is not a time"));
}

TEST(VcdCapture, LimitsTheLengthOfNames) {
    const std::string head = "$timescale 1 us $end\n", scope = "$scope module ", end = " $end\n";
    const std::string name(1000, 'n'), line = "$var wire 1 ! a $end\n";
    std::string deep = head;
    for (int i = 0; i < 500; ++i) deep += scope + "s" + end;
    for (const std::string& text :
         {head + scope + name + end + line, deep + line, head + "$var wire 1 ! " + name + "n $end\n",
          head + "$var wire 1 ! a [" + name + "] $end\n", head + "$var wire 4096 ! " + name + " [4095:0] $end\n"})
        EXPECT_TRUE(has(refusal(text, "a.vcd"), "more than 1000 bytes, its scopes included")) << text.substr(0, 60);
    EXPECT_TRUE(opened(head + "$var wire 1 ! " + name + " $end\n$enddefinitions $end\n", "a.vcd"));
}

// ---- CSV

TEST(CsvCapture, ReadsFilesOfSigrok) {
    const std::string text =
        "; CSV generated by libsigrok 0.5.2\n; from unknown on Sat Nov 21 15:03:36 2026\n; Channels (3/3): A, B, Z\n"
        "META samplerate: 1000000\nlogic,logic,logic\n0,0,0\n1,0,0\n1,1,1\n0,1,0\n0,0,0\n1,0,0\n";
    const auto analysis = analysed(text, "a.csv");
    ASSERT_TRUE(analysis) << analysis.error().text();
    EXPECT_EQ(analysis->channels[0].count, 5);
    EXPECT_EQ(analysis->channels[0].z, "Z");
    EXPECT_DOUBLE_EQ(analysis->channels[0].first_indexes.at(0).time_s, 2e-6);
    EXPECT_DOUBLE_EQ(analysis->channels[0].seconds, 5e-6);
}

TEST(CsvCapture, ReadsFilesOfSaleae) {
    const auto analysis = analysed(
        "\xEF\xBB\xBFTime [s],Channel 0,Channel 1\r\n-0.001000000,0,0\r\n0.000000000,1,0\r\n0.0015,1,1\r\n1e-2,0,1\r\n",
        "a.csv", {"spindle=Channel 0,Channel 1"});
    ASSERT_TRUE(analysis) << analysis.error().text();
    EXPECT_EQ(analysis->channels[0].count, 3);
    EXPECT_NEAR(analysis->channels[0].seconds, 0.011, 1e-12);
    EXPECT_DOUBLE_EQ(analysis->first_s, -0.001);
}

TEST(CsvCapture, ReadsOtherSeparatorsUnitsAndFilesWithoutAHeader) {
    const auto semicolons = analysed("Time (ms);A;B\n0,5;0;0\n1,5;\"1\";0\n", "a.csv");
    ASSERT_TRUE(semicolons) << semicolons.error().text();
    EXPECT_EQ(semicolons->channels[0].count, 1);
    EXPECT_NEAR(semicolons->channels[0].seconds, 1e-3, 1e-12);
    const auto plain = analysed("0\t0\n1\t0\n1\t1\n", "a.csv", {"E=0,1"}, {Format::automatic, 1e3, 1});
    ASSERT_TRUE(plain) << plain.error().text();
    EXPECT_EQ(plain->channels[0].count, 2);
    EXPECT_DOUBLE_EQ(plain->channels[0].seconds, 2e-3);
    const auto timed = analysed("0,0,0\n0.5,1,0\n1.0,1,1,\n", "a.csv", {"E=0,1"});
    ASSERT_TRUE(timed) << timed.error().text();
    EXPECT_EQ(timed->channels[0].count, 2);
    EXPECT_DOUBLE_EQ(timed->channels[0].mean_per_s, 2);
}

TEST(CsvCapture, CountsUnknownLevelsAndHoldsTheLastOne) {
    const auto analysis = analysed("t,a,b\n0,0,0\n1,1,0\n2,x,0\n3,x,0\n4,1,z\n5,1,1\n", "a.csv");
    ASSERT_TRUE(analysis) << analysis.error().text();
    EXPECT_EQ(analysis->channels[0].count, 2);
    ASSERT_EQ(analysis->channels[0].notes.size(), 2u);
    EXPECT_EQ(analysis->channels[0].notes[0].unknown, 1u);
    EXPECT_EQ(analysis->channels[0].notes[1].first_unknown, "line 6");
}

TEST(CsvCapture, RejectsInvalidFilesWithTheLine) {
    EXPECT_TRUE(has(refusal("t,a,b\n0,0,0\n2,1,0\n1,1,1\n3,0,0\n", "a.csv"),
                    "a.csv:4:1: Time goes backwards, from 2 s to 1 s."));
    EXPECT_TRUE(
        has(refusal("t,a,b\n0,0,0\n1,0\n2,0,0\n", "a.csv"), "a.csv:3:1: The row has 2 columns, the first row 3."));
    EXPECT_TRUE(has(refusal("t,a,b\n0,0,0\n1,3.3,0\n2,0,0\n", "a.csv"), "a.csv:3:1: Column 2 holds '3.3'"));
    EXPECT_TRUE(has(refusal("t,a,b\n2026-11-21T10:00,0,0\n1,1,0\n", "a.csv"), "is not a time"));
    EXPECT_TRUE(has(refusal("t,a,b\nnan,0,0\n1,1,0\n", "a.csv"), "is not a time"));
    EXPECT_TRUE(has(refusal("a,b\n0,0\n", "a.csv"), "--sample-rate"));
    EXPECT_TRUE(has(refusal("; nothing\n", "a.csv"), "no rows"));
    EXPECT_TRUE(has(refusal("", "a.csv"), "empty"));
    EXPECT_TRUE(has(refusal("PK\3\4", "a.sr"), "sigrok-cli"));
    EXPECT_TRUE(has(refusal("time_s,signal,value\n0,X.step,1\n", "a.csv"), "VCD"));
    EXPECT_TRUE(has(refusal(std::string(3'000'000, '0'), "a.csv"), "this is not a text file"));
}

TEST(CsvCapture, DecodesATruncatedFileToItsLastCompleteRow) {
    for (const std::string end : {"0.003,1", "0.0", "0.003,1,q"}) {
        const auto analysis = analysed("t,a,b\n0.001,0,0\n0.002,1,0\n" + end, "a.csv");
        ASSERT_TRUE(analysis) << analysis.error().text();
        EXPECT_EQ(analysis->channels[0].count, 1);
        ASSERT_TRUE(analysis->cut) << end;
        EXPECT_EQ(analysis->cut->location.line, 4);
    }
}

// ---- raw

TEST(RawCapture, CountsSamplesOfEverySizeAsTheReferenceDecoder) {
    const std::size_t samples = 600'001;
    const auto lines = random_lines(8, samples);
    Referee referee, second;
    for (const std::uint8_t byte : lines) referee.sample(byte, {0, 1, 2}), second.sample(byte, {4, 5, -1});
    for (int size = 1; size <= 8; ++size) {
        std::string file(samples * static_cast<std::size_t>(size), '\x55');
        const auto at = static_cast<std::size_t>(size - 1);
        for (std::size_t i = 0; i < samples; ++i)
            file[i * static_cast<std::size_t>(size) + at] = static_cast<char>(lines[i]);
        const auto bit = [&](int i) { return std::to_string(static_cast<int>(8 * at) + i); };
        const auto analysis =
            analysed(file, "a.bin", {"X=" + bit(0) + "," + bit(1) + "," + bit(2), "Y=" + bit(4) + "," + bit(5)},
                     {Format::automatic, 1e6, size});
        ASSERT_TRUE(analysis) << analysis.error().text();
        EXPECT_EQ(analysis->samples, samples);
        EXPECT_EQ(analysis->channels[0].count, referee.count);
        EXPECT_EQ(analysis->channels[0].illegal, referee.illegal.size());
        EXPECT_EQ(analysis->channels[0].indexes, referee.indexes.size());
        ASSERT_GT(analysis->channels[0].first_indexes.size(), 10u);
        EXPECT_EQ(analysis->channels[0].first_indexes[10].sample, referee.indexes[10].sample);
        EXPECT_EQ(analysis->channels[0].first_indexes[10].count, referee.indexes[10].count);
        EXPECT_EQ(analysis->channels[1].count, second.count);
        EXPECT_FALSE(analysis->cut);
    }
}

TEST(RawCapture, ReportsThePeakVelocityOfItsWindows) {
    std::string file;
    unsigned phase = 0;
    const auto run = [&](int samples, int each, unsigned step) {
        for (int i = 0; i < samples; ++i) {
            if (i % each == 0) phase += step;
            file += static_cast<char>((phase & 3U) ^ (phase & 3U) >> 1);
        }
    };
    run(100'000, 50, 1);  // 20,000 counts/s at 1 MHz; the first change sets the initial lines
    run(100'000, 10, 3);  // 100,000 counts/s backwards
    run(100'000, 1000, 1);
    AnalysisSettings how;
    how.window_s = 0.01;
    const auto analysis = analysed(file, "a.bin", {"X=0,1"}, {Format::automatic, 1e6, 1}, how);
    ASSERT_TRUE(analysis);
    ASSERT_TRUE(analysis->channels[0].peak);
    EXPECT_DOUBLE_EQ(analysis->channels[0].peak->counts_per_s, -100'000);
    EXPECT_NEAR(analysis->channels[0].peak->time_s, 0.1, 1e-9);
    EXPECT_NEAR(analysis->channels[0].mean_per_s, (1999 - 10'000 + 100) / 0.299999, 0.1);
}

TEST(RawCapture, SkipsTheHeaderLineOfSigrok) {
    const auto analysis = analysed(std::string_view("META samplerate: 2000000\n\0\1\3\2\0", 30), "a.bin", {"X=0,1"});
    ASSERT_TRUE(analysis) << analysis.error().text();
    EXPECT_EQ(analysis->samples, 5u);
    EXPECT_EQ(analysis->channels[0].count, 4);
    EXPECT_DOUBLE_EQ(analysis->channels[0].seconds, 2e-6);
}

TEST(RawCapture, ReportsMissingSettingsAndTruncatedSamples) {
    EXPECT_TRUE(has(refusal("abc", "a.bin", {"X=0,1"}), "--sample-rate 24M"));
    EXPECT_TRUE(has(refusal("abc", "a.bin", {}, {Format::automatic, 1e6, 1}), "--channel"));
    EXPECT_TRUE(has(refusal("abc", "a.bin", {"X=0,9"}, {Format::automatic, 1e6, 1}), "no line '9'"));
    const auto cut = analysed("abcde", "a.bin", {"X=0,9"}, {Format::raw, 1e6, 2});
    ASSERT_TRUE(cut);
    EXPECT_EQ(cut->samples, 2u);
    ASSERT_TRUE(cut->cut);
    EXPECT_TRUE(has(cut->cut->text(), "1 of 2 bytes into a sample, after 5 bytes"));
}

// ---- channels

TEST(Channels, AreSelectedByName) {
    const auto two = choose_channels(
        {"top.X.X_enc_a", "top.X.X_enc_b", "top.X.X_enc_z", "top.Y.enc_b", "top.Y.enc_a", "top.a", "top.b"}, {});
    ASSERT_TRUE(two) << two.error().text();
    ASSERT_EQ(two->size(), 2u);
    EXPECT_EQ((*two)[0].name, "X");
    EXPECT_EQ((*two)[0].z, 2u);
    EXPECT_EQ((*two)[1].name, "Y");
    EXPECT_EQ((*two)[1].a, 4u);
    EXPECT_FALSE((*two)[1].z);
    const auto plain = choose_channels({"A", "B", "Z"}, {});
    ASSERT_TRUE(plain);
    EXPECT_EQ((*plain)[0].name, "encoder");
    const auto chosen = choose_channels({"top.X.X_enc_a", "top.X.X_enc_b", "top.a"}, {"M=X.enc_a,X_enc_b", "N=1,2"});
    ASSERT_TRUE(chosen) << chosen.error().text();
    EXPECT_EQ((*chosen)[0].b, 1u);
    EXPECT_EQ((*chosen)[1].b, 2u);
}

TEST(Channels, AreRejectedWithTheAvailableLines) {
    const std::vector<std::string> lines = {"x.a", "y.a", "y.b"};
    for (const char* text : {"X", "X=a", "=a,b", "X=x.a,y.b,,", "X=x.a,", "X=x.a,x.a", "X=x.a,y.b,q", "X=a,y.b"})
        EXPECT_FALSE(choose_channels(lines, {text})) << text;
    EXPECT_TRUE(has(choose_channels(lines, {"X=q,r"}).error().message, "x.a, y.a, y.b"));
    EXPECT_TRUE(has(choose_channels(lines, {"X=a,y.b"}).error().message, "'a' matches x.a, y.a"));
    EXPECT_TRUE(has(choose_channels(lines, {"X=1,2", "X=0,1"}).error().message, "Two channels have the name 'X'"));
    EXPECT_TRUE(has(choose_channels({"p", "q"}, {}).error().message, "--channel"));
}

TEST(SampleRate, AcceptsTheUsualNotations) {
    for (const char* text : {"24000000", "24M", "24 MHz", "24000k", "2.4e7", "0.024 GHz"})
        EXPECT_DOUBLE_EQ(read_rate(text).value(), 24e6) << text;
    for (const char* text : {"", "M", "24X", "-1", "0", "nan", "1e300", "inf"}) EXPECT_FALSE(read_rate(text)) << text;
}

}  // namespace
}  // namespace motionrack::decode
