// Belts, tables and scan heads of a rack file around an RTC5: encoders, words, parts, marks; faults, copies, refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/rtc5_card.hpp>
#include <motionrack/rack/session.hpp>
#include <motionrack/rack/test/config_helpers.hpp>

namespace motionrack::rack {
namespace {

using rtc5::Op;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* marking_line = R"([card.scan]
type = "rtc5"
list_memory = 256
[belt.line]
card = "scan"
velocity_mm_s = 100
counts_per_mm = 1000
[scanner.head]
card = "scan"
conveyor = "line"
bits_per_mm = 5184
)";

struct Line {
    explicit Line(const std::string& text = marking_line) {
        auto opened = Session::open(text);
        if (!opened) ADD_FAILURE() << opened.error().message;
        session = std::move(*opened);
    }

    rtc5::Engine& engine() { return rtc5_card_of(session->rack(), "scan")->engine(); }
    void put(Op op, std::initializer_list<double> parameters = {}) {
        ASSERT_TRUE(engine().put(*rtc5::list_command(op, parameters)));
    }
    void ms(int time) { ASSERT_TRUE(session->advance(static_cast<std::uint64_t>(time) * 1'000'000)); }
    double part(const char* name) {
        const auto value = session->part(name);
        EXPECT_TRUE(value) << value.error().message;
        return value.value_or(NAN);
    }
    std::int64_t peek(const char* name) { return *session->peek("scan", name); }
    /// Marks a square of 10 mm at 500 mm/s from the field's origin, with or without correction by encoder 0.
    void square(double scale) {
        ASSERT_TRUE(engine().set_start_list(1));
        put(Op::set_mark_speed, {5184 * 0.5});
        put(Op::set_jump_speed, {50'000});
        if (scale != 0) put(Op::set_fly_x, {scale});
        for (const auto& [x, y] : {std::pair{10, 0}, std::pair{10, 10}, std::pair{0, 10}, std::pair{0, 0}})
            put(Op::mark_abs, {x * 5184.0, y * 5184.0});
        if (scale != 0) put(Op::fly_return, {0, 0});
        put(Op::set_end_of_list);
    }
    const parts::Workpiece& workpiece() { return session->rack().scanner("head")->workpiece(); }

    std::unique_ptr<Session> session;
};

TEST(MarkingLine, TheBeltsEncoderIsCountedByTheCard) {
    Line bench;
    bench.ms(100);
    EXPECT_DOUBLE_EQ(bench.part("line.position_mm"), 10);
    EXPECT_DOUBLE_EQ(bench.part("line.speed_mm_s"), 100);
    EXPECT_NEAR(bench.part("line.encoder_counts"), 10'000, 1);
    EXPECT_NEAR(static_cast<double>(bench.peek("ENCODER0")), bench.part("line.encoder_counts"), 1);
    EXPECT_EQ(bench.peek("MARKING_INFO"), 0);
    EXPECT_EQ(*bench.session->wire("line.enc_a"), *bench.session->wire("scan.enc0_a"));
}

TEST(MarkingLine, ASquareOnTheMovingPartIsASquareOnlyWithCorrection) {
    for (const bool corrected : {false, true}) {
        Line bench;
        bench.square(corrected ? 5184.0 / 1000 : 0);
        ASSERT_TRUE(bench.engine().execute_list(1));
        bench.ms(200);
        parts::Workpiece marked = bench.workpiece();
        marked.finish();
        ASSERT_GE(marked.points().size(), 5u);
        // The part moves 2 mm to +X while a side is marked: without correction the corners are further back on it.
        const sim::Spot at = marked.points()[0].at;
        const double late = corrected ? 0 : 2;
        const sim::Spot corners[] = {at,
                                     {at.x + 10 - late, at.y},
                                     {at.x + 10 - 2 * late, at.y + 10},
                                     {at.x - 3 * late, at.y + 10},
                                     {at.x - 4 * late, at.y}};
        std::vector<parts::DrawnSegment> drawing;
        for (int i = 0; i < 4; ++i) drawing.push_back({corners[i], corners[i + 1]});
        const parts::Deviation off = marked.compare(drawing);
        EXPECT_LT(off.max_mm, 0.003) << corrected;
        EXPECT_EQ(off.missing_mm, 0) << corrected;
        EXPECT_NEAR(bench.part("head.marked_mm"), corrected ? 40 : 8 + 12 + 2 * std::hypot(10, 2), 0.05);
        EXPECT_NEAR(bench.part("head.energy_j"), 20 * 0.08, 0.02);
    }
}

TEST(MarkingLine, ReadingTheMarksDuringARunHasNoEffect) {
    Line looked, other;
    for (Line* bench : {&looked, &other}) {
        bench->square(5184.0 / 1000);
        ASSERT_TRUE(bench->engine().execute_list(1));
    }
    double before = 0;
    for (int i = 0; i < 60; ++i) {
        looked.ms(1);
        EXPECT_GE(looked.part("head.marked_mm"), before);
        before = looked.part("head.marked_mm");
        static_cast<void>(looked.workpiece().collecting());
    }
    EXPECT_GT(before, 20);
    EXPECT_NEAR(looked.part("head.spot_y_mm"), 10, 0.2);
    other.ms(60);
    EXPECT_EQ(looked.part("head.marked_mm"), other.part("head.marked_mm"));
    EXPECT_EQ(looked.session->rack().kernel().trace_hash(), other.session->rack().kernel().trace_hash());
}

TEST(MarkingLine, ACopyDuringAMarkContinuesIdentically) {
    Line bench(std::string(marking_line) +
               "[scanner.head.galvo]\nideal_mirrors = false\ndead_time_us = 100\n[scanner.head.laser]\non_delay_us = "
               "35\noff_delay_us = 12\n");
    bench.square(5184.0 / 1000);
    ASSERT_TRUE(bench.engine().execute_list(1));
    bench.ms(37);
    const std::unique_ptr<Session> copy = *bench.session->copy();
    EXPECT_EQ(copy->state_hash(), bench.session->state_hash());
    bench.ms(150);
    ASSERT_TRUE(copy->advance(150'000'000));
    EXPECT_EQ(copy->state_hash(), bench.session->state_hash());
    const auto a = bench.workpiece().points(), b = copy->rack().scanner("head")->workpiece().points();
    ASSERT_EQ(a.size(), b.size());
    ASSERT_GT(a.size(), 4u);
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].at.x, b[i].at.x);
}

TEST(MarkingLine, ARestoredSnapshotRemovesLaterMarks) {
    Line bench;
    bench.square(0);
    ASSERT_TRUE(bench.engine().execute_list(1));
    bench.ms(30);
    sim::Kernel& kernel = bench.session->rack().kernel();
    const sim::Snapshot snapshot = kernel.snapshot();
    const double marked = bench.part("head.marked_mm");
    bench.ms(100);
    const double all = bench.part("head.marked_mm");
    const std::size_t points = bench.workpiece().points().size();
    kernel.restore(snapshot);
    EXPECT_EQ(bench.part("head.marked_mm"), marked);
    bench.ms(100);
    EXPECT_EQ(bench.part("head.marked_mm"), all);
    EXPECT_EQ(bench.workpiece().points().size(), points);
}

TEST(MarkingLine, TheVelocityCanBeChangedAndTheEncoderBroken) {
    Line bench;
    bench.ms(100);
    ASSERT_TRUE(bench.session->set_part("line.speed_mm_s", 0));
    bench.ms(100);
    EXPECT_DOUBLE_EQ(bench.part("line.position_mm"), 10);
    const std::int64_t stood = bench.peek("ENCODER0");
    ASSERT_TRUE(bench.session->set_part("line.speed_mm_s", -20));
    bench.ms(100);
    EXPECT_NEAR(bench.part("line.position_mm"), 8, 1e-9);
    EXPECT_NEAR(static_cast<double>(bench.peek("ENCODER0") - stood), -2'000, 1);
    ASSERT_TRUE(bench.session->fault("drive.profile", "line"));
    EXPECT_DOUBLE_EQ(bench.part("line.speed_mm_s"), 100);
    ASSERT_TRUE(bench.session->fault("encoder.broken_a", "line"));
    const std::int64_t broken = bench.peek("ENCODER0");
    bench.ms(100);
    EXPECT_LE(std::llabs(bench.peek("ENCODER0") - broken), 2) << "one line alone goes to and fro";
    EXPECT_THAT(bench.session->set_part("line.position_mm", 0).error().message, HasSubstr("only speed_mm_s"));
    EXPECT_THAT(bench.session->set_part("line.speed_mm_s", NAN).error().message,
                HasSubstr("it must be -10000 to 10000"));
    EXPECT_FALSE(bench.session->fault("drive.speed=20000", "line"));
    EXPECT_THAT(bench.session->fault("sender.silent", "line").error().message, HasSubstr("drive.speed"));
    EXPECT_THAT(bench.session->part("line.height").error().message, HasSubstr("encoder_counts"));
    EXPECT_THAT(bench.session->part("head.height").error().message, HasSubstr("marked_mm"));
}

TEST(MarkingLine, DerivedQuantitiesCannotBeSet) {
    Line bench;
    for (const char* name : {"head.light", "scan.mark_speed_bits_ms"}) {
        const Result<void> set = bench.session->set_part(name, 1);
        ASSERT_FALSE(set) << name;
        EXPECT_EQ(set.error().kind, ErrorKind::refused) << name;
        EXPECT_THAT(set.error().message, HasSubstr(std::string(name) + " follows from the machine and cannot be set"))
            << name;
    }
    EXPECT_THAT(bench.session->set_part("head.height", 1).error().message,
                HasSubstr("head has no quantity 'height'; it has: spot_x_mm"));
    EXPECT_THAT(bench.session->set_part("tail.light", 1).error().message, HasSubstr("Unknown quantity 'tail.light'"));
}

TEST(MarkingLine, ASenderDelaysItsWordsAndCanStop) {
    Line bench(std::string(marking_line) + "[belt.line.sender]\nbits_per_mm = 1000\nperiod_us = 100\ndelay_us = 350\n");
    bench.ms(100);
    // The last reading with a complete word: at 99.6 ms, 9.96 mm.
    EXPECT_EQ(bench.part("line.word"), 9960);
    EXPECT_EQ(*bench.session->wire("scan.mcbsp"), 9960);
    EXPECT_EQ(bench.engine().state().mcbsp.word, 9960);
    ASSERT_TRUE(bench.session->fault("sender.silent", "line"));
    bench.ms(10);
    EXPECT_EQ(bench.part("line.word"), 9960);
    ASSERT_TRUE(bench.session->fault("sender.silent=0", "line"));
    bench.ms(10);
    EXPECT_EQ(bench.part("line.word"), 11960);
}

TEST(MarkingLine, RepeatedEqualWordsAreReceived) {
    Line bench(std::string(marking_line) + "[belt.line.sender]\nbits_per_mm = 1000\nperiod_us = 100\n");
    ASSERT_TRUE(bench.session->set_part("line.speed_mm_s", 0));
    ASSERT_TRUE(bench.session->set_wire("line.mcbsp", 77)) << "the line between sender and card, driven by hand";
    ASSERT_TRUE(bench.engine().parts().fly.set_multi_mcbsp_in(1, 16384, 0));
    bench.ms(1);
    // 77 = 9 * 8 + 5: words of type 5 fill the locations in turn.
    for (const char* place : {"MCBSP0", "MCBSP1", "MCBSP2", "MCBSP3"}) EXPECT_EQ(bench.peek(place), 77);
}

TEST(MarkingLine, PartsThatPassTheSensorStartTheList) {
    Line bench(std::string(marking_line) + "[belt.line.parts]\npart_pitch_mm = 20\nfirst_part_mm = 5\nlength_mm = 8\n");
    ASSERT_TRUE(bench.engine().set_start_list(1));
    bench.put(Op::mark_abs, {1000, 0});
    bench.put(Op::jump_abs, {0, 0});
    bench.put(Op::set_end_of_list);
    bench.engine().set_control_mode(rtc5::control_ext_start);
    bench.ms(49);
    EXPECT_EQ(bench.part("line.parts"), 0);
    EXPECT_EQ(*bench.session->wire("line.sensor_n"), 1);
    EXPECT_EQ(bench.part("head.marked_mm"), 0);
    bench.ms(2);
    EXPECT_EQ(bench.part("line.parts"), 1);
    EXPECT_EQ(*bench.session->wire("scan.start_n"), 0);
    bench.ms(99);
    EXPECT_EQ(*bench.session->wire("scan.start_n"), 1) << "the part is past the sensor after 8 mm";
    const double one = bench.part("head.marked_mm");
    EXPECT_GT(one, 0);
    bench.ms(540);
    EXPECT_EQ(bench.part("line.parts"), 4);
    EXPECT_NEAR(bench.part("head.marked_mm"), 4 * one, 1e-9);
}

TEST(MarkingLine, ATableTurnsThePartAndItsEncoderCountsDegrees) {
    Line bench(
        "[card.scan]\ntype = \"rtc5\"\nlist_memory = 64\n[table.dial]\ncard = \"scan\"\nencoder = 1\nvelocity_deg_s = "
        "90\ncounts_per_deg = 100\n"
        "centre_x_mm = 20\n[scanner.head]\ncard = \"scan\"\nconveyor = \"dial\"\nbits_per_mm = 1000\n");
    ASSERT_TRUE(bench.engine().set_start_list(1));
    bench.put(Op::laser_on_list, {400'000});
    bench.put(Op::set_end_of_list);
    ASSERT_TRUE(bench.engine().execute_list(1));
    bench.ms(4'000);
    EXPECT_DOUBLE_EQ(bench.part("dial.position_deg"), 360);
    EXPECT_NEAR(static_cast<double>(bench.peek("ENCODER1")), 36'000, 1);
    EXPECT_EQ(bench.peek("ENCODER0"), 0);
    EXPECT_NEAR(bench.part("head.marked_mm"), 2 * 3.14159265 * 20, 0.01)
        << "the spot stands still and draws a circle on the part";
}

TEST(MarkingLine, TheFileOverridesDefaultProfilesAndWires) {
    Line bench(std::string(marking_line) +
               "[wires]\n\"scan.enc0_a\" = \"line.enc_b\"\n\"scan.enc0_b\" = \"line.enc_a\"\n");
    bench.ms(10);
    EXPECT_NEAR(static_cast<double>(bench.peek("ENCODER0")), -1'000, 1) << "the lines crossed over count backwards";
    Line ramp(
        "[card.scan]\ntype = \"rtc5\"\nlist_memory = 64\n[belt.line]\ncard = \"scan\"\nprofile = [[0, 0], [0.1, "
        "100]]\ncounts_per_mm = -100\n");
    ramp.ms(200);
    EXPECT_NEAR(ramp.part("line.position_mm"), 15, 1e-9);
    EXPECT_NEAR(static_cast<double>(ramp.peek("ENCODER0")), -1500, 1);
}

TEST(MarkingLine, InconsistentSettingsAreReportedWithTheirLocation) {
    const auto refused = [](const std::string& text) {
        const RackReading reading =
            read_rack_text("[card.scan]\ntype = \"rtc5\"\n[card.m]\ntype = \"mcx314\"\n" + text);
        EXPECT_FALSE(reading.config) << text;
        return reading.errors.empty() ? std::string() : all_texts(reading.errors);
    };
    EXPECT_THAT(refused("[belt.line]\ncard = \"none\"\n"), HasSubstr("6:8: belt line: unknown card 'none'"));
    EXPECT_THAT(refused("[belt.line]\ncard = \"m\"\n"), HasSubstr("one of type rtc5 marks"));
    EXPECT_THAT(refused("[belt.scan]\n"), HasSubstr("cannot be the name"));
    EXPECT_THAT(refused("[belt.line]\ncentre_x_mm = 1\n"), HasSubstr("centre_x_mm"));
    EXPECT_THAT(refused("[belt.line]\nvelocity_mm_s = 1\nprofile = [[0, 1]]\n"), HasSubstr("leave one out"));
    EXPECT_THAT(refused("[belt.line]\nprofile = [[1, 1], [0, 2]]\n"), HasSubstr("rise"));
    EXPECT_THAT(refused("[belt.line]\nprofile = [1, 2]\n"), HasSubstr("pair [seconds, velocity]"));
    EXPECT_THAT(refused("[belt.one]\ncard = \"scan\"\n[belt.two]\ncard = \"scan\"\n"),
                HasSubstr("encoder input 0 of card scan has the encoder of one"));
    EXPECT_THAT(refused("[belt.line]\n[belt.line.sender]\nperiod_us = 10\ndelay_us = 5000\n"),
                HasSubstr("it must be less than 2550 us"));
    EXPECT_THAT(refused("[belt.line]\n[belt.line.sender]\nbits_per_mm = 0\n"),
                HasSubstr("a sender needs bits other than 0"));
    EXPECT_THAT(refused("[belt.line]\n[belt.line.parts]\npart_pitch_mm = 5\n"),
                HasSubstr("the next one comes after 5"));
    EXPECT_THAT(refused("[table.dial]\n[table.dial.sender]\ntwo_axes = true\n"), HasSubstr("two_axes"));
    EXPECT_THAT(refused("[scanner.head]\n"), HasSubstr("scanner head has no card"));
    EXPECT_THAT(refused("[scanner.head]\ncard = \"scan\"\nconveyor = \"line\"\n"),
                HasSubstr("unknown belt or table 'line'"));
    EXPECT_THAT(refused("[scanner.one]\ncard = \"scan\"\n[scanner.two]\ncard = \"scan\"\n"),
                HasSubstr("drives scanner one already"));
    EXPECT_THAT(refused("[scanner.head]\ncard = \"scan\"\nbits_per_mm = 5000\n[scanner.head.lens]\n"),
                HasSubstr("in the table lens"));
    EXPECT_THAT(refused("[belt.line]\n[wires]\n\"scan.start_n\" = \"line.sensor_n\"\n"), HasSubstr("section parts"));
    EXPECT_THAT(refused("[belt.line]\nvelocity_mm_s = 1000\ncounts_per_mm = 20000\n"),
                HasSubstr("above 500 mm/s its encoder"));
    EXPECT_THAT(
        refused("[belt.line]\nvelocity_mm_s = 1000\n[belt.line.parts]\npart_pitch_mm = 0.002\nlength_mm = 0.001\n"),
        HasSubstr("above 200 mm/s"));
}

}  // namespace
}  // namespace motionrack::rack
