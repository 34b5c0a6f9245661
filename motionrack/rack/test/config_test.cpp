// The rack file reader: invalid files and the location of their errors, valid racks, wires, hostile texts.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <motionrack/rack/config.hpp>
#include <motionrack/rack/template.hpp>
#include <motionrack/rack/test/config_helpers.hpp>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::rack {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> wire_names(const RackConfig& config) {
    std::vector<std::string> out;
    for (const RackWire& wire : config.wires)
        out.push_back(config.end_name(wire.from) + " -> " + config.end_name(wire.to));
    return out;
}

/// Returns the driver of input `to`, or "".
std::string driver_of(const RackConfig& config, const std::string& to) {
    for (const RackWire& wire : config.wires) {
        if (config.end_name(wire.to) == to) return config.end_name(wire.from);
    }
    return {};
}

// ---- Invalid files

struct BadFile {
    std::string text;
    TextPosition location;
    std::vector<std::string> words;  ///< the error there contains all of them
};

const std::vector<BadFile>& bad_files() {
    static const std::vector<BadFile> files = {
        {"[card.m\n", {1, 8}, {"not TOML"}},
        {"[card.m]\ntype = \"mcx314\"\ntype = \"mcx314\"\n", {3, 8}, {"not TOML", "type"}},
        {"a = \"\xff\"\n", {1, 5}, {"not TOML"}},
        {"[[{a = 1}]]\n", {1, 1}, {"not TOML", "section needs a name"}},
        {"[]\n", {1, 2}, {"not TOML"}},
        {"x = 1\"a\"\n", {1, 6}, {"not TOML", "middle of a word"}},
        {"x = [\n1.\"a\"]\n", {2, 3}, {"not TOML", "middle of a word"}},
        {"x = 1979-05-27 7\n", {1, 15}, {"Two values", "no dates"}},
        {"x = [}\n", {1, 6}, {"not TOML", "'}'", "not opened"}},
        {"# ä\nx = 1ä\n", {2, 6}, {"only in quotes and comments"}},
        {"x = \"ää\" \u00e4\n", {1, 10}, {"only in quotes and comments"}},
        {"x = \"\"\"\\\n ä\"\"\"\n", {2, 2}, {"After a backslash"}},
        {"x.y.z.a.b.c.d.e.f.g.h.i.j.k.l.m.n.o = 1\n", {1, 34}, {"16 levels"}},
        {"a = [[[[[[[[[[[[[[[[[1]]]]]]]]]]]]]]]]]\n", {1, 21}, {"16 levels"}},
        {"[rack]\nname = \"r\"\n", {1, 1}, {"no card", "mcx314"}},
        {"card = \"mcx314\"\n", {1, 8}, {"needs a name", "card.motion"}},
        {"[card]\nm = 5\n", {2, 5}, {"card.m", "table", "whole number"}},
        {"[[card.m]]\ntype = \"mcx314\"\n", {1, 1}, {"card.m", "table", "array"}},
        {"[card.m]\nslot = 1\n", {1, 7}, {"card m has no type"}},
        {"[card.m]\ntype = \"mcx31\"\n", {2, 8}, {"'mcx31'", "did you mean 'mcx314'?"}},
        {"[card.m]\ntype = 314\n", {2, 8}, {"type of card m", "whole number", "in quotes"}},
        {"[card.m]\ntype = \"mcx314\"\nclock_hz = 8e6\n", {3, 12}, {"is 8000000, but it can be only 16000000 Hz"}},
        {"card.m = \"mcx3\"\n", {1, 10}, {"'mcx3'", "did you mean 'mcx314'?"}},
        {"[card.X]\ntype = \"mcx314\"\n", {1, 7}, {"called X", "axis"}},
        {"[card.estop]\ntype = \"mcx314\"\n", {1, 7}, {"called estop", "emergency stop"}},
        {"[card.\"my card\"]\ntype = \"mcx314\"\n", {1, 7}, {"'my card'", "letters, digits"}},
        {"[card.a]\ntype = \"mcx314\"\nslot = 3\n[card.b]\ntype = \"mcx314\"\nslot = 3\n",
         {6, 8},
         {"Slot 3", "a and b"}},
        {"[crd.m]\n" + rack_with(""), {1, 2}, {"'crd'", "did you mean 'card'?"}},
        {"rack = 1\n" + rack_with(""), {1, 8}, {"[rack]", "whole number"}},
        {rack_with("[controller]\narc_tolerence_mm = 1\n"), {7, 1}, {"did you mean 'arc_tolerance_mm'?"}},
        {rack_with("max_velocty_mm_s = 1\n"),
         {6, 1},
         {"axis X", "'max_velocty_mm_s'", "did you mean 'max_velocity_mm_s'?"}},
        {rack_with("colour = \"blue\"\n"), {6, 1}, {"axis X has no key 'colour'."}},
        {rack_with("max_speed_mm_s = 1\n"), {6, 1}, {"'max_speed_mm_s' is now 'max_velocity_mm_s'."}},
        {rack_with("max_velocity_deg_s = 1\n"), {6, 1}, {"counts in deg", "a linear axis", "max_velocity_mm_s"}},
        {rack_with("max_velocity_mm_s = 1\n", 'A'), {6, 1}, {"counts in mm", "a rotary axis", "max_velocity_deg_s"}},
        {rack_with("gear_ratio = 2\n"), {6, 1}, {"gear_ratio", "does not belong", "linear"}},
        {rack_with("lead_mm = 2\n", 'A'), {6, 1}, {"lead_mm", "does not belong", "rotary"}},
        {rack_with("kind = \"rotary\"\n"), {6, 8}, {"Axis X cannot be rotary"}},
        {rack_with("kind = \"rotery\"\n"), {6, 8}, {"did you mean 'rotary'?"}},
        {rack_with("reversed = \"yes\"\n"), {6, 12}, {"reversed", "true or false"}},
        {rack_with("microsteps = 2.5\n"), {6, 14}, {"2.5", "whole number", "1 .. 1024"}},
        {rack_with("lead_mm = \"5\"\n"), {6, 11}, {"lead_mm", "a text", "a number"}},
        {rack_with("lead_mm = nan\n"), {6, 11}, {"nan"}},
        {rack_with("lead_mm = 1979-05-27\n"), {6, 11}, {"a date"}},
        {rack_with("motor = 5\n"), {6, 9}, {"[axis.X.motor]", "whole number"}},
        {rack_with("[axis.x]\n"), {6, 7}, {"Unknown axis 'x'", "did you mean 'X'?"}},
        {rack_with("[axis.U]\n"), {6, 7}, {"Unknown axis 'U'", "X Y Z", "A B C"}},
        {rack_with("[axis.Y]\nchannel = \"y\"\n"), {6, 7}, {"axis Y has no card"}},
        {rack_with("[axis.Y]\ncard = \"m\"\n"),
         {6, 7},
         {"Axis Y names no channel; a card of type mcx314 has the channels x y z u"}},
        {rack_with("[axis.Y]\ncard = \"q\"\nchannel = \"y\"\n[card.motion]\ntype = \"mcx314\"\n"),
         {7, 8},
         {"Axis Y", "'q'", "which the rack does not have."}},
        {rack_with("[axis.Y]\ncard = \"moton\"\nchannel = \"y\"\n[card.motion]\ntype = \"mcx314\"\n"),
         {7, 8},
         {"Axis Y", "'moton'", "did you mean 'motion'?"}},
        {rack_with("[axis.Y]\ncard = \"m\"\nchannel = \"w\"\n"), {8, 11}, {"'w'", "x y z u"}},
        {rack_with("[axis.Y]\ncard = \"m\"\nchannel = \"x\"\n"), {8, 11}, {"X and Y", "channel x of card m"}},
        {rack_with("min_limit_mm = 10\nmax_limit_mm = 10\ninitial_position_mm = 10\n"),
         {6, 16},
         {"min_limit_mm", "10", "max_limit_mm"}},
        {rack_with("min_limit_mm = 10\n"), {3, 7}, {"initial_position_mm", "is 0", "10 .. 300 mm"}},
        {rack_with("initial_position_mm = 301\n"), {6, 23}, {"initial_position_mm", "301", "0 .. 300 mm"}},
        {rack_with("initial_position_deg = -1\n", 'A'), {6, 24}, {"initial_position_deg", "-1", "0 .. 360 deg"}},
        {rack_with("max_velocity_step_mm_s = 101\n"), {6, 26}, {"max_velocity_step_mm_s", "101", "100"}},
        {rack_with("max_jerk_mm_s3 = 0.0001\n"), {6, 18}, {"0.0001", "0 (trapezoids)", "0.001"}},
        {rack_with("max_velocity_mm_s = 10000\n"),
         {6, 21},
         {"10000", "6400000 pulses/s", "640 pulses/mm", "4000000", "6250"}},
        {rack_with("max_accel_mm_s2 = 1e6\n"), {6, 19}, {"1000000", "640000000 pulses/s2", "500000000"}},
        {rack_with("max_velocity_mm_s = 0.001\nmax_velocity_step_mm_s = 0.001\n"),
         {6, 21},
         {"0.64 pulses/s", "the minimum of card"}},
        {rack_with("max_limit_mm = 4e6\n"), {6, 16}, {"max_limit_mm", "32", "2147483647"}},
        {rack_with("encoder_counts_per_rev = 1001\n"), {6, 26}, {"1001", "multiple of 4"}},
        {rack_with("encoder_counts_per_rev = 1000000\n"), {6, 26}, {"20000000 counts/s", "8000000"}},
        {rack_with("[axis.X.motor]\nstart_stop_hz = 300000\n"), {7, 17}, {"300000", "200000", "pull_out_hz"}},
        {rack_with("[axis.X.switches]\nhome_mm = 301\n"), {7, 11}, {"home_mm", "301", "0 to 300 mm"}},
        {rack_with("[axis.X.switches]\nlimit_minus_mm = 5\nlimit_plus_mm = 4\n"),
         {7, 18},
         {"leave no travel", "5", "4"}},
        {rack_with("[axis.X.switches]\nlimit_minus_mm = 301\n"), {7, 18}, {"leave no travel", "301"}},
    };
    return files;
}

const std::vector<BadFile>& bad_wiring() {
    static const std::vector<BadFile> files = {
        {rack_with("[wires]\n\"m.xin9\" = \"estop\"\n"), {7, 1}, {"'m.xin9'", "did you mean"}},
        {rack_with("[wires]\n\"m.xin1\" = \"X.hom\"\n"), {7, 12}, {"'X.hom'", "did you mean 'X.home'?"}},
        {rack_with("[wires]\n\"m.xin1\" = \"X.home\"\n"), {7, 12}, {"does not have X.home", "home_mm in its switches"}},
        {rack_with("[wires]\n\"m.xin1\" = \"Y.enc_a\"\n"), {7, 12}, {"'Y.enc_a'"}},
        {rack_with("encoder_counts_per_rev = 0\n[wires]\n\"m.xin1\" = \"X.enc_z\"\n"),
         {8, 12},
         {"does not have X.enc_z", "above 0"}},
        {rack_with("[wires]\n\"m.xpp\" = \"m.xpm\"\n"), {7, 1}, {"both outputs", "m.xpp", "m.xpm"}},
        {rack_with("[wires]\n\"m.ypp\" = \"X.step\"\n"), {7, 1}, {"\"X.step\" = \"m.ypp\""}},
        {rack_with("[wires]\n\"m.xin1\" = \"m.xin2\"\n"), {7, 1}, {"both inputs", "m.xin1"}},
        {rack_with("[wires]\n\"m.xin1\" = \"m.xin1\"\n"), {7, 1}, {"to itself"}},
        {rack_with("[wires]\nm.xin1 = \"m.xin2\"\nm.xin2 = \"m.xin1\"\n"),
         {7, 3},
         {"form a loop", "m.xin1 = m.xin2 = m.xin1"}},
        {rack_with("[wires]\nm.xin1 = \"estop\"\n\"m.xin1\" = \"estop\"\n"), {8, 1}, {"wired twice"}},
        {rack_with("[wires]\n\"m.xpp\" = \"open\"\n"), {7, 1}, {"an output", "open"}},
        {rack_with("[wires]\n\"m.xin1\" = 1\n"), {7, 12}, {"whole number", "in quotes"}},
        {rack_with("[wires]\n\"estop\" = \"m.xout0\"\n"), {7, 1}, {"both outputs"}},
    };
    return files;
}

TEST(TomlReader, ArraysHaveTheirValuesWithTheirLocations) {
    const Result<TomlNode> root = parse_toml("a = [1, [2.5, 'x'],\n  true]\n[[t]]\nk = 1\n[[t]]\nk = 2\n", "f");
    ASSERT_TRUE(root) << root.error().text();
    const TomlNode& a = root->children[0];
    ASSERT_EQ(a.type, TomlType::array);
    ASSERT_EQ(a.children.size(), 3u);
    EXPECT_EQ(a.children[0].integer, 1);
    EXPECT_EQ(a.children[1].children[1].text, "x");
    EXPECT_EQ(a.children[2].value_location.line, 2);
    EXPECT_EQ(a.children[2].value_location.column, 3);
    const TomlNode& t = root->children[1];
    ASSERT_EQ(t.type, TomlType::array);
    ASSERT_EQ(t.children.size(), 2u);
    EXPECT_EQ(t.children[1].find("k")->integer, 2);
}

void expect_refused(const std::vector<BadFile>& files) {
    for (const BadFile& bad : files) {
        const RackReading reading = read_rack_text(bad.text, "bad.toml");
        EXPECT_FALSE(reading.config.has_value()) << bad.text;
        ASSERT_EQ(reading.errors.size(), 1U) << all_texts(reading.errors) << bad.text;
        const Error& error = reading.errors[0];
        EXPECT_EQ(error.kind, ErrorKind::invalid_input);
        EXPECT_EQ(error.location, bad.location) << error.text() << '\n' << bad.text;
        EXPECT_EQ(error.file, "bad.toml");
        for (const std::string& word : bad.words) EXPECT_THAT(error.message, HasSubstr(word)) << bad.text;
    }
}

TEST(RackFile, ReportsMistakesWithTheirPosition) {
    expect_refused(bad_files());
    expect_refused(bad_wiring());
}

TEST(RackFile, ListsAllMistakesAtOnceInTheOrderOfTheFile) {
    const RackReading reading = read_rack_text(
        rack_with("initial_position_mm = 500\nlead_mm = 0\n[axis.X.switches]\nbounce_ms = -1\n[rack]\nnaem = "
                  "\"n\"\n[wires]\n\"m.q\" = \"estop\"\n"
                  "[contoller]\n"));
    std::vector<int> lines;
    for (const Error& error : reading.errors) lines.push_back(error.location.line);
    EXPECT_THAT(lines, ElementsAre(6, 7, 9, 11, 13, 14)) << all_texts(reading.errors);
}

TEST(RackFile, ARejectedKeyCausesNoFurtherErrors) {
    // With the default (300), initial_position_mm would be outside; but the intended max_limit_mm is unknown.
    const RackReading reading = read_rack_text(rack_with("max_limit_mm = \"500\"\ninitial_position_mm = 400\n"));
    ASSERT_EQ(reading.errors.size(), 1U) << all_texts(reading.errors);
    EXPECT_EQ(reading.errors[0].location, (TextPosition{6, 16}));
}

TEST(RackFile, ACardOfUnknownTypeCausesNoErrorsAboutItsPins) {
    const RackReading reading = read_rack_text(
        "[card.m]\ntype = \"mcx999\"\nclock_hz = 5\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\n[wires]\n\"m.xin1\" = "
        "\"estop\"\n");
    ASSERT_EQ(reading.errors.size(), 1U) << all_texts(reading.errors);
    EXPECT_EQ(reading.errors[0].location.line, 2);
}

TEST(RackFile, ShowsTwoHundredMistakesAndCountsTheOthers) {
    std::string text = rack_with("");
    for (int i = 0; i < 1000; ++i) text += fmt::format("nonsense_{} = 1\n", i);
    const RackReading reading = read_rack_text(text);
    ASSERT_EQ(reading.errors.size(), 201U);
    EXPECT_THAT(reading.errors.back().message, HasSubstr("and 800 more"));
}

TEST(RackFile, WarnsOfPossibleButUnwantedSettings) {
    const auto warnings = [](const std::string& more) {
        const RackReading reading = read_rack_text(rack_with(more));
        EXPECT_TRUE(reading.config.has_value()) << all_texts(reading.errors);
        return all_texts(reading.warnings);
    };
    EXPECT_EQ(warnings(""), "");
    EXPECT_THAT(warnings("max_velocity_mm_s = 400\n"),
                HasSubstr("6:21: max_velocity_mm_s of axis X is 400, that is 256000 pulses/s"));
    EXPECT_THAT(warnings("max_velocity_step_mm_s = 10\n"), HasSubstr("above the motor's start_stop_hz 2000"));
    EXPECT_THAT(warnings("[axis.X.switches]\nlimit_plus_mm = 250\n"),
                HasSubstr("7:17: limit_plus_mm of axis X acts at 250 mm"));
    EXPECT_THAT(warnings("[axis.X.switches]\nlimit_minus_mm = 0\n"),
                HasSubstr("within the travel (min_limit_mm is 0)"));
}

// ---- Valid racks

TEST(RackFile, GivesThePlannerItsLimits) {
    const RackConfig config = good(rack_with(
        "max_limit_mm = 250\nmax_velocity_mm_s = 80\n[axis.A]\ncard = \"m\"\nchannel = \"u\"\ngear_ratio = 72\n"));
    const control::MachineLimits limits = config.limits();
    EXPECT_TRUE(limits[0].present && limits[3].present);
    EXPECT_FALSE(limits[1].present || limits[2].present || limits[4].present || limits[5].present);
    EXPECT_EQ(limits[0].max_position, 250);
    EXPECT_EQ(limits[0].max_velocity, 80);
    EXPECT_EQ(limits[0].max_accel, 1000);
    EXPECT_EQ(limits[0].max_jerk, 20'000);
    EXPECT_EQ(limits[0].max_velocity_step, 2);
    EXPECT_EQ(limits[0].pulses_per_unit, 640);
    EXPECT_EQ(limits[3].pulses_per_unit, 640);
    EXPECT_EQ(config.axis('A')->counts_per_unit(), 800);
    EXPECT_EQ(config.axis('B'), nullptr);
}

TEST(RackFile, WiresByTheDefaultRule) {
    const RackConfig config =
        good(rack_with("[axis.X.switches]\nlimit_minus_mm = -1\nlimit_plus_mm = 301\nhome_mm = 1\n"));
    EXPECT_THAT(wire_names(config), ElementsAre("estop -> m.emgn", "X.enc_a -> m.xeca", "X.enc_b -> m.xecb",
                                                "X.home -> m.xin0", "X.enc_z -> m.xin2", "X.limit_minus -> m.xlmtm",
                                                "X.limit_plus -> m.xlmtp", "m.xpm -> X.dir", "m.xpp -> X.step"));
    for (const RackWire& wire : config.wires) EXPECT_TRUE(wire.by_default);
}

TEST(RackFile, WiresExistingPartsOnly) {
    EXPECT_THAT(wire_names(good(rack_with("encoder_counts_per_rev = 0\n"))),
                ElementsAre("estop -> m.emgn", "m.xpm -> X.dir", "m.xpp -> X.step"));
}

TEST(RackFile, ChangesOnlyTheWiresThatTheFileNames) {
    const std::string machine = "[axis.X.switches]\nhome_mm = 1\n[wires]\n";
    const RackConfig config =
        good(rack_with(machine + "m.xin1 = \"X.home\"\n\"m.xin2\" = \"open\"\n\"m.xeca\" = \"X.enc_b\"\n"
                                 "\"m.xecb\" = \"X.enc_a\"\n\"X.step\" = \"m.upp\"\n\"X.dir\" = \"m.upm\"\n"
                                 "\"m.xin3\" = \"m.xout0\"\n"));
    EXPECT_EQ(driver_of(config, "m.xin0"), "X.home");
    EXPECT_EQ(driver_of(config, "m.xin1"), "X.home");
    EXPECT_EQ(driver_of(config, "m.xin2"), "");
    EXPECT_EQ(driver_of(config, "m.xeca"), "X.enc_b");
    EXPECT_EQ(driver_of(config, "m.xecb"), "X.enc_a");
    EXPECT_EQ(driver_of(config, "X.step"), "m.upp");
    EXPECT_EQ(driver_of(config, "X.dir"), "m.upm");
    EXPECT_EQ(driver_of(config, "m.xin3"), "m.xout0");
}

TEST(RackFile, GivesCardsWithoutASlotTheLowestFreeOne) {
    const RackConfig config =
        good("[card.a]\ntype=\"mcx314\"\n[card.b]\ntype=\"mcx314\"\nslot=0\n[card.c]\ntype=\"mcx314\"\n");
    EXPECT_EQ(config.card("a")->slot, 1);
    EXPECT_EQ(config.card("b")->slot, 0);
    EXPECT_EQ(config.card("c")->slot, 2);
    EXPECT_THAT(config.axes, IsEmpty());
}

TEST(RackFile, ACardAloneDrivesFourIdealAxes) {
    const RackReading reading = read_rack("card.c1 = \"mcx314\"");
    ASSERT_TRUE(reading.config.has_value()) << all_texts(reading.errors);
    EXPECT_THAT(reading.warnings, IsEmpty());
    std::string letters, channels;
    for (const RackAxis& axis : reading.config->axes) {
        letters += axis.letter;
        channels += axis.channel;
        EXPECT_EQ(axis.pulses_per_unit(), 1000);
        EXPECT_EQ(axis.counts_per_unit(), 1000);
        EXPECT_EQ(axis.max_pulse_hz(), 4e6);
        EXPECT_GE(axis.motor.start_stop_hz, axis.max_pulse_hz());
        EXPECT_FALSE(axis.switches.home || axis.switches.limit_minus || axis.switches.limit_plus);
    }
    EXPECT_EQ(letters, "XYZA");
    EXPECT_EQ(channels, "xyzu");
    EXPECT_EQ(driver_of(*reading.config, "A.step"), "c1.upp");
    EXPECT_EQ(driver_of(*reading.config, "c1.emgn"), "estop");
}

TEST(RackFile, TheShortFormWithAxesIsACardWithDefaultSettings) {
    const RackConfig config = good("card.c1 = \"mcx314\"\n[axis.B]\ncard = \"c1\"\nchannel = \"z\"\n");
    ASSERT_EQ(config.axes.size(), 1U);
    EXPECT_EQ(config.axes[0].letter, 'B');
    EXPECT_EQ(driver_of(config, "B.step"), "c1.zpp");
}

// ---- Text, paths, sizes

TEST(RackFile, ReportsAMissingFileByName) {
    const RackReading reading = read_rack("no/such/rack.toml");
    ASSERT_EQ(reading.errors.size(), 1U);
    EXPECT_EQ(reading.errors[0].kind, ErrorKind::io);
    EXPECT_EQ(reading.errors[0].file, "no/such/rack.toml");
    EXPECT_THAT(reading.errors[0].message, HasSubstr("motionrack new"));
    EXPECT_THAT(read_rack("/").errors.at(0).message, HasSubstr("folder"));
    EXPECT_THAT(read_rack("").errors.at(0).message, HasSubstr("No rack file"));
}

TEST(RackFile, RefusesMoreThanAMegabyte) {
    const RackReading reading = read_rack_text(std::string(max_toml_bytes + 1, '\n'));
    ASSERT_EQ(reading.errors.size(), 1U);
    EXPECT_THAT(reading.errors[0].message, HasSubstr("1000001 bytes"));
    EXPECT_EQ(read_rack_text(std::string(max_toml_bytes, '\n')).errors.at(0).message.find("bytes"), std::string::npos);
}

TEST(RackFile, SurvivesNestingThatWouldOverrunTheStack) {
    std::string dots;
    for (int i = 0; i < 400'000; ++i) dots += "a.";
    const std::string brackets(500'000, '[');
    for (const std::string& text :
         {dots + "a = 1", "[" + dots + "a]", "x = " + brackets, "x = \"\"\"\"\"\"\n" + dots + "a = 1",
          "x = '''\n\"'''\n" + dots + "a = 1", "x = {" + dots + "a = 1}"}) {
        const RackReading reading = read_rack_text(text);
        ASSERT_EQ(reading.errors.size(), 1U);
        EXPECT_THAT(reading.errors[0].message, HasSubstr("16 levels"));
    }
    good(rack_with("# ....................................... [[[[[[[[[[[[[[[[[[[[[[[[[\n") +
         "[rack]\nname = \"a.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p.q.r.s.t.u.v [[[[[[[[[[[[[[[[[[[[[\"\n");
}

TEST(RackFile, AcceptsTextsOfAllLanguages) {
    EXPECT_EQ(good("\xEF\xBB\xBF[rack]\nname = \"Fräse 数控\"  # für Übungen\n" + rack_with("")).name, "Fräse 数控");
    EXPECT_EQ(good("rack = { \"name\" = 'ü' }\n" + rack_with("[wires]\nm.\"xin1\" = \"estop\"\n")).name, "ü");
    EXPECT_EQ(good("[rack]\nname = \"\"\"a\\\n  b \\u00e4\"\"\"\n" + rack_with("")).name, "ab ä");
}

TEST(RackFile, ShowsTheUsersTextWithoutItsControlCharacters) {
    const RackReading reading =
        read_rack_text(rack_with("\"\\u001b[31m\\n\" = 1\n\"" + std::string(5000, 'k') + "\" = 1\n"));
    ASSERT_EQ(reading.errors.size(), 2U);
    EXPECT_THAT(reading.errors[0].message, HasSubstr("'?[31m?'"));
    EXPECT_LT(reading.errors[1].message.size(), 200U);
}

TEST(RackFile, AnyChangeOfAGoodFileGivesAConfigOrErrors) {
    const std::string start = *rack_template("single");
    EXPECT_TRUE(rc::check("a damaged file is read or refused", [&] {
        std::string text = start;
        const int edits = *rc::gen::inRange(1, 6);
        for (int i = 0; i < edits; ++i) {
            const std::size_t at = *rc::gen::inRange<std::size_t>(0, text.size());
            const std::size_t length = *rc::gen::inRange<std::size_t>(0, 8);
            text.replace(at, length,
                         *rc::gen::container<std::string>(rc::gen::elementOf(std::string("0159.-=[]{}\"'\n#eXmx_"))));
        }
        const RackReading reading = read_rack_text(text);
        RC_ASSERT(reading.config.has_value() == reading.errors.empty());
    }));
}

}  // namespace
}  // namespace motionrack::rack
