// Points, their texts and keys; values of grids and random draws; hostile texts.
#include <gmock/gmock.h>

#include <motionrack/sweep/sweep.hpp>
#include <random>
#include <set>

namespace motionrack::sweep {
namespace {

using testing::HasSubstr;

constexpr const char* rack_text = "card.c1 = \"mcx314\"\n";
constexpr const char* program_text = "G21 G90 G64 P{P}\nG1 X10 Y5 F{F}\nX0 ({other} {P})\n";

Sweep sweep_of(const std::string& text) {
    SweepFileReading file = read_sweep_file(text, "sweep.toml");
    EXPECT_TRUE(file.errors.empty()) << file.errors.front().text();
    SweepFiles files;
    files.rack = rack_text;
    files.rack_name = "rack.toml";
    files.program = program_text;
    files.program_name = "part.ngc";
    SweepReading reading = prepare(std::move(*file.file), "sweep.toml", files);
    EXPECT_TRUE(reading.errors.empty()) << reading.errors.front().text();
    return std::move(*reading.sweep);
}

const std::string grid =
    "[sweep]\nprogram = \"part.ngc\"\n[vary]\ntext.P = [0.01, 0.5]\ntext.F = { from = 100, to = 200, steps = 4 }\n";
const std::string chance =
    "[sweep]\nprogram = \"part.ngc\"\nsampling = \"random\"\npoints = 40\nseed = 3\n[vary]\ntext.P = [0.01, "
    "0.5]\ntext.F "
    "= { from = 100, to = 200 }\n";

TEST(Sweep, GridChangesItsLastParameterFirst) {
    const Sweep sweep = sweep_of(grid);
    ASSERT_EQ(sweep.points(), 8);
    std::string all;
    for (std::int64_t i = 0; i < 8; ++i)
        all += value_text(sweep.values(i)[0]) + " " + value_text(sweep.values(i)[1]) + "\n";
    EXPECT_EQ(all, "0.01 100\n0.01 133.33\n0.01 166.67\n0.01 200\n0.5 100\n0.5 133.33\n0.5 166.67\n0.5 200\n");
}

TEST(Sweep, InsertsValuesIntoTheProgramAndKeepsOtherBraces) {
    EXPECT_EQ(sweep_of(grid).point(5).program, "G21 G90 G64 P0.5\nG1 X10 Y5 F133.33\nX0 ({other} 0.5)\n");
}

TEST(Sweep, DrawsTheSamePointsForTheSameSeedAndMorePointsStartWithThem) {
    const Sweep few = sweep_of(chance);
    std::string more_text = chance;
    more_text.replace(more_text.find("40"), 2, "90");
    const Sweep more = sweep_of(more_text);
    std::string other_text = chance;
    other_text.replace(other_text.find("seed = 3"), 8, "seed = 4");
    const Sweep other = sweep_of(other_text);
    std::set<std::string> keys;
    for (std::int64_t i = 0; i < few.points(); ++i) {
        EXPECT_EQ(few.key(i), more.key(i));
        EXPECT_NE(few.key(i), other.key(i));
        keys.insert(few.key(i));
        const double feed = few.values(i)[1].number;
        EXPECT_GE(feed, 100);
        EXPECT_LE(feed, 200);
    }
    EXPECT_GT(keys.size(), 35u);
}

TEST(Sweep, DrawsEvenly) {
    std::string text = chance;
    text.replace(text.find("40"), 2, "4000");
    const Sweep sweep = sweep_of(text);
    double sum = 0, first = 0;
    for (std::int64_t i = 0; i < sweep.points(); ++i)
        sum += sweep.values(i)[1].number, first += sweep.values(i)[0].number == 0.01;
    EXPECT_NEAR(sum / 4000, 150, 2);
    EXPECT_NEAR(first, 2000, 130);
}

TEST(Sweep, NumbersBetweenOthersHaveFewDigits) {
    for (const auto& [value, from, to, text] :
         std::vector<std::tuple<double, double, double, std::string>>{{0.1 + 0.2, 0, 1, "0.3"},
                                                                      {1.0 / 3, 0, 1, "0.3333"},
                                                                      {1234.5678901, 500, 4000, "1234.6"},
                                                                      {-3e-7 / 7, -1e-6, 0, "-0.00000004286"},
                                                                      {123456789.0 / 7, 0, 1e9, "17636684"},
                                                                      {0.99999999, 0, 0.99999, "0.99999"}})
        EXPECT_EQ(rack::number_text(tidied(value, {from, to, false})), text);
    EXPECT_EQ(tidied(2.6, {1, 4, true}), 3);
}

TEST(Point, IsFoundAgainInItsText) {
    PointText point;
    point.rack = rack_text;
    point.program = "G1 X1 (\xE4 \x01 rack 3\n)\n";
    point.subprograms = {{"a", "o<a> sub\n"}, {"b", ""}};
    point.tools = "T1 P1 Z3\n";
    point.block_delete = true;
    point.faults = {"X.motor.stall@1s", "estop=0@2s"};
    const std::string text = text_of(point);
    const auto read = read_point(text);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(text_of(*read), text);
    EXPECT_EQ(read->program, point.program);
    EXPECT_EQ(read->subprograms, point.subprograms);
    EXPECT_EQ(read->faults, point.faults);
    EXPECT_EQ(key_of(text).size(), 32u);
    point.faults.pop_back();
    EXPECT_NE(key_of(text_of(point)), key_of(text));
}

TEST(Point, DamagedTextsAndOtherVersionsAreRefused) {
    PointText point;
    point.rack = rack_text;
    point.program = "G1 X1 F100\n";
    const std::string text = text_of(point);
    for (std::size_t size = 0; size < text.size(); ++size) EXPECT_FALSE(read_point(text.substr(0, size))) << size;
    std::mt19937 random(1);
    for (int i = 0; i < 20'000; ++i) {
        std::string damaged = text;
        for (int k = 0; k < 3; ++k) damaged[random() % damaged.size()] = static_cast<char>(random());
        (void)read_point(damaged);
    }
    std::string other = text;
    const std::size_t begin = other.find("version "), end = other.find('\n', other.find('\n', begin) + 1);
    other.replace(begin, end - begin, "version 5\n9.9.9");
    EXPECT_THAT(read_point(other).error().message, HasSubstr("version 9.9.9"));
}

TEST(Point, GivesTheSameRowAgain) {
    const Sweep sweep = sweep_of(grid);
    const std::string text = text_of(sweep.point(6));
    const auto row = run_point(text, nullptr), again = run_point(text, nullptr);
    ASSERT_TRUE(row && again);
    EXPECT_EQ(*row, *again);
    EXPECT_EQ(cell_of(*row, "ended"), "ok");
    EXPECT_EQ(cell_of(*row, "trace_hash").size(), 16u);
    EXPECT_EQ(cell_of(*row, "x_lost_pulses"), "0");
}

TEST(Point, ReportsLostStepsThatWereRegainedByChance) {
    // A motor that loses steps in both directions may end at its commanded position.
    PointText point;
    point.rack = "[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\n";
    point.program = "G21 G90\nG1 X20 F3000\nX0\n";
    point.faults = {"X.motor.lose_steps=64@100ms", "X.motor.lose_steps=-64@200ms"};
    const auto row = run_point(text_of(point), nullptr);
    ASSERT_TRUE(row) << row.error().message;
    EXPECT_EQ(cell_of(*row, "x_lost_pulses"), "0");
    EXPECT_EQ(cell_of(*row, "ended"), "lost_steps");
}

TEST(SweepFile, SurvivesAnyText) {
    std::mt19937 random(7);
    const std::string seed_text =
        grid + "fault = [\"X.motor.stall@1s\"]\naxis.X.max_limit_mm = { from = 1, to = 9, steps = 3, whole = true }\n";
    for (int i = 0; i < 20'000; ++i) {
        std::string text = seed_text;
        for (int k = 0; k < 4; ++k) text[random() % text.size()] = "[]{}=\"',.\n#0123456789eE-+ ax"[random() % 29];
        const SweepFileReading reading = read_sweep_file(text, "s");
        EXPECT_NE(reading.file.has_value(), !reading.errors.empty());
    }
}

}  // namespace
}  // namespace motionrack::sweep
