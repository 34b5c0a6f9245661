// The commands `mark` and `calibrate` from the command line, and their page.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <tests/ran.hpp>

namespace motionrack {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string square = "[drawing]\nsvg = 'examples/marking/square.svg'\nanchor = 'origin'\n";

class MarkCommand : public InFolder {
  protected:
    bool there(const std::string& name) const { return std::filesystem::exists(folder / name); }
    /// Marks an invalid job: expects its exit code, its error message, and no output file.
    void refused(const std::string& job, int code, const std::string& said) const {
        write("job.toml", job);
        const Ran ran = motionrack("mark job.toml --picture p.svg --report r.html");
        EXPECT_EQ(ran.code, code) << ran.out;
        EXPECT_THAT(ran.out, HasSubstr(said)) << job;
        EXPECT_FALSE(there("p.svg") || there("r.html")) << job;
    }
};

/// Returns a big-endian number of a PNG header, at a byte.
std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
    std::uint32_t out = 0;
    for (std::size_t i = 0; i < 4; ++i) out = out << 8 | static_cast<unsigned char>(bytes.at(at + i));
    return out;
}

TEST_F(MarkCommand, ItsPageShowsTheOutputOfItsCommands) {
    std::map<std::string, int> codes = run_page("docs/howto/marking.md");
    ASSERT_GE(codes.size(), 4u);
    for (const auto& [arguments, code] : codes) EXPECT_EQ(code, 0) << arguments;
    EXPECT_EQ(text_of(folder / "square.svg"), text_of(source_root / "docs/pictures/marking_square.svg"))
        << "make it anew: motionrack mark examples/marking/square.toml --picture docs/pictures/marking_square.svg";
}

TEST_F(MarkCommand, TheExamplesGiveTheOutputAndPicturesOfTheirPage) {
    const std::map<std::string, int> codes = run_page("examples/marking/README.md");
    ASSERT_EQ(codes.size(), 8u);
    for (const auto& [arguments, code] : codes)
        EXPECT_EQ(code, arguments.find("serial") != std::string::npos ? 4 : 0) << arguments;
    for (const char* name :
         {"serial", "dial", "long", "speed_encoder", "speed_simulated", "mcbsp_late", "mcbsp_offset"})
        EXPECT_EQ(text_of(folder / fmt::format("{}.svg", name)),
                  text_of(source_root / fmt::format("examples/marking/pictures/{}.svg", name)))
            << fmt::format(
                   "make it anew: motionrack mark examples/marking/{0}.toml --picture "
                   "examples/marking/pictures/{0}.svg",
                   name);
}

TEST_F(MarkCommand, ALongDrawingOnAFastBeltIsRefusedWithTheVelocityThatFits) {
    std::string job = text_of(source_root / "examples/marking/long.toml");
    job.replace(job.find("velocity_mm_s = 150"), 19, "velocity_mm_s = 300");
    job.replace(job.find("ruler.svg"), 9, "examples/marking/ruler.svg");
    refused(job, 3, "The limit is 226.96 mm/s");
}

TEST_F(MarkCommand, WritesPicturesOfBothKindsAndAPage) {
    const Ran ran = motionrack("mark examples/marking/square.toml --picture a.svg --picture b.png --report c.html");
    EXPECT_EQ(ran.code, 0) << ran.out;
    EXPECT_THAT(ran.out, HasSubstr("written: a.svg, b.png, c.html\n"));
    const std::string svg = text_of(folder / "a.svg"), png = text_of(folder / "b.png"),
                      page = text_of(folder / "c.html");
    int width = 0, height = 0;
    ASSERT_EQ(std::sscanf(svg.c_str() + svg.find("viewBox=\"0 0 "), "viewBox=\"0 0 %d %d", &width, &height), 2);
    ASSERT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
    EXPECT_EQ(big_endian(png, 16), 2u * static_cast<unsigned>(width));
    EXPECT_EQ(big_endian(png, 20), 2u * static_cast<unsigned>(height));
    EXPECT_THAT(page, HasSubstr("Without correction"));
    EXPECT_THAT(page, HasSubstr("svg = &quot;square.svg&quot;"));
    EXPECT_FALSE(there("mark.svg"));
}

TEST_F(MarkCommand, WritesMarkSvgByDefault) {
    EXPECT_THAT(motionrack("mark examples/marking/square.toml").out, HasSubstr("written: mark.svg"));
    EXPECT_TRUE(there("mark.svg"));
    std::filesystem::remove(folder / "mark.svg");
    EXPECT_EQ(motionrack("mark examples/marking/square.toml --picture ''").out.find("written"), std::string::npos);
    EXPECT_FALSE(there("mark.svg"));
}

TEST_F(MarkCommand, PrintsTheSameAsJson) {
    const Ran ran = motionrack("mark examples/marking/square.toml --json --picture ''");
    EXPECT_EQ(ran.code, 0);
    const nlohmann::json all = nlohmann::json::parse(ran.out);
    EXPECT_EQ(all["strokes"], 1);
    EXPECT_EQ(all["drawing_mm"], 40);
    EXPECT_LT(all["marked"]["max_deviation_mm"].get<double>(), 0.0025);
    EXPECT_NEAR(all["without_correction"]["max_deviation_mm"].get<double>(), 8, 0.01);
    EXPECT_NEAR(all["fits_times_the_velocity"].get<double>(), 7.57, 0.01);
    EXPECT_NEAR(all["field_margin"]["mm"].get<double>(), 46.568, 0.001);
    EXPECT_EQ(all["field_margin"]["edge"], "right");
    EXPECT_TRUE(all["marked"]["overflows"].empty());
    EXPECT_TRUE(all["warnings"].empty());
}

TEST_F(MarkCommand, WarnsBeforeTheFieldOverflowsAndReportsEachOverflowByName) {
    write("job.toml", square + "[belt]\nvelocity_mm_s = 720\n[fly]\nmode = 'encoder'\n");
    const Ran near = motionrack("mark job.toml");
    EXPECT_EQ(near.code, 0);
    EXPECT_THAT(near.out, HasSubstr("warning: only "));
    EXPECT_THAT(near.out, HasSubstr("mm are left at the right edge of the field"));
    write("job.toml", square + "[belt]\nvelocity_mm_s = 900\n[fly]\nmode = 'encoder'\n");
    const Ran over = motionrack("mark job.toml --report r.html");
    EXPECT_EQ(over.code, 4);
    EXPECT_THAT(over.out, HasSubstr("FLY_X_OVERFLOW at 0.0"));
    EXPECT_THAT(over.out, HasSubstr("It just fits the field at 75"));
    EXPECT_THAT(text_of(folder / "r.html"), HasSubstr("<h2>Overflows</h2>"));
    const Ran json = motionrack("mark job.toml --json -q");
    EXPECT_EQ(json.code, 4);
    const nlohmann::json all = nlohmann::json::parse(json.out);
    EXPECT_EQ(all["marked"]["overflows"][0]["name"], "FLY_X_OVERFLOW");
    EXPECT_GT(all["marked"]["overflows"][0]["beyond_mm"].get<double>(), 0);
}

TEST_F(MarkCommand, ReadsAJobFromStandardInput) {
    const Ran ran = shell("printf '[drawing]\\ntext = \"A1\"\\n' | " MOTIONRACK_PROGRAM " mark - --picture ''");
    EXPECT_EQ(ran.code, 0) << ran.out;
    EXPECT_THAT(ran.out, HasSubstr("drawing: "));
}

TEST_F(MarkCommand, RefusesWrongJobsWithTheirLocations) {
    refused("[drawing]\ntext = \n", 2, "job.toml:2:");
    refused("[drawing]\n", 2, "job.toml:1:");
    refused("[drawing]\ntext = 'A'\n[pace]\nmark_speed_mm_s = nan\n", 2, "job.toml:4:");
    refused("[drawing]\ntext = 'A'\n[bolt]\n", 2, "belt");
    refused("[drawing]\ntext = 'A'\n[belt]\nvelocity_mm_s = 'fast'\n", 2, "job.toml:4:");
    refused("[drawing]\ntext = 'A'\n[pace]\nmark_speed_mm_s = 200000\n", 3, "bits/ms");
    const Ran missing = motionrack("mark none.toml");
    EXPECT_EQ(missing.code, 5);
    EXPECT_THAT(missing.out, HasSubstr("none.toml cannot be read"));
    EXPECT_EQ(motionrack("mark").code, 1);
    EXPECT_EQ(motionrack("mark examples").code, 5) << "a folder";
}

TEST_F(MarkCommand, RefusesWrongDrawingsAndTablesWithTheirLocations) {
    const std::string job = "[drawing]\nsvg = 'd.svg'\n";
    refused(job, 5, "d.svg cannot be read");
    const auto drawing = [&](const std::string& svg, const std::string& said) {
        write("d.svg", svg);
        refused(job, 2, said);
    };
    drawing("<svg><path d='M0 0\nL 1'/>\n</svg>", "d.svg:2:");
    drawing("<svg>\n<path d='M0 0 L 1 1'/>", "d.svg:");
    drawing("<svg>\n <text x='1'>no</text></svg>", "d.svg:2:3: the element 'text' is not supported");
    drawing("<svg><image href='x.png'/></svg>", "'image' is not supported");
    drawing("<svg><path stroke-dasharray='1 2' d='M0 0L1 1'/></svg>", "d.svg:1:");
    drawing("<svg/>", "Nothing was marked");
    write("bad.ct5", std::string(100, 'x'));
    refused("[drawing]\ntext = 'A'\n[optics]\nct5 = 'bad.ct5'\n", 2, "bad.ct5");
    write("d.ngc", "G21\nG1 X5 F\n");
    refused("[drawing]\ngcode = 'd.ngc'\n", 2, "d.ngc:2:");
}

TEST_F(MarkCommand, ReportsBeforeTheRunThatAFileCannotBeWritten) {
    const std::string marking = "mark examples/marking/square.toml ";
    std::filesystem::create_directories(folder / "results");
    for (const char* option : {"--picture no_such_folder/p.png --report r.html", "--picture p.svg --report results"}) {
        const Ran ran = motionrack(marking + option);
        EXPECT_EQ(ran.code, 5) << ran.out;
        EXPECT_THAT(ran.out, HasSubstr("cannot be written"));
        EXPECT_THAT(ran.out, Not(HasSubstr("max mm")));
        EXPECT_FALSE(there("p.svg") || there("r.html"));
    }
    const Ran kind = motionrack(marking + "--picture p.gif");
    EXPECT_EQ(kind.code, 1);
    EXPECT_THAT(kind.out, HasSubstr("p.gif is neither .svg nor .png"));
}

TEST_F(MarkCommand, OverwritesNeitherItsInputsNorAnotherOutput) {
    write("mark.svg", "<svg width='10mm' height='10mm' viewBox='0 0 10 10'><path d='M0 0L9 9'/></svg>");
    write("job.toml", "[drawing]\nsvg = 'mark.svg'\n");
    for (const char* outputs : {"", "--picture mark.svg", "--picture ''  --report job.toml",
                                "--picture a.svg --report a.svg", "--picture a.svg --picture ./a.svg"}) {
        const Ran ran = motionrack(std::string("mark job.toml -q ") + outputs);
        EXPECT_EQ(ran.code, 3) << outputs;
        EXPECT_THAT(ran.out, HasSubstr("Nothing was done")) << outputs;
    }
    EXPECT_THAT(text_of(folder / "job.toml"), HasSubstr("mark.svg"));
    EXPECT_EQ(motionrack("mark job.toml -q --picture other.svg").code, 0);
}

TEST_F(MarkCommand, ReportsThatADrawingIsOutsideTheField) {
    write("job.toml", square + "[fly]\nmode = 'off'\n");
    EXPECT_EQ(motionrack("mark job.toml -q --picture ''").code, 0);
    write("job.toml", "[drawing]\ntext = 'I'\nheight_mm = 200\n");
    const Ran ran = motionrack("mark job.toml -q --picture ''");
    EXPECT_EQ(ran.code, 4);
    EXPECT_THAT(ran.out, HasSubstr("outside the field"));
}

TEST_F(MarkCommand, RefusesADrawingThatDoesNotReachTheField) {
    for (const char* drawing : {"x_mm = 200", "y_mm = -900", "x_mm = 700\nscale = 10"}) {
        write("job.toml", std::string("[drawing]\ntext = 'I'\n") + drawing + "\n");
        const Ran ran = motionrack("mark job.toml -q --picture a.svg");
        EXPECT_EQ(ran.code, 3) << ran.out;
        EXPECT_THAT(ran.out, HasSubstr("Nothing was marked")) << drawing;
        EXPECT_FALSE(std::filesystem::exists(folder / "a.svg"));
    }
    write("job.toml", "[drawing]\ntext = 'I'\nx_mm = 200\n");
    EXPECT_THAT(motionrack("mark job.toml -q --picture ''").out,
                AllOf(HasSubstr("The drawing goes from X 199.167 to 200.833 mm and from Y -2.500 to 2.500 mm"),
                      HasSubstr("outside the field, which goes from -60.569 to 60.569 mm each way")));
    write("job.toml", "[drawing]\ntext = 'I'\ny_mm = 1000\nscale = 1e6\n");
    const Ran far = motionrack("mark job.toml -q --picture ''");
    EXPECT_EQ(far.code, 2);
    EXPECT_THAT(far.out, HasSubstr("more than 100000 mm from the field's middle"));
}

TEST_F(MarkCommand, SuggestsNoVelocityThatAPartCannotReach) {
    write("job.toml",
          "[drawing]\ntext = '.'\nheight_mm = 0.01\n[belt]\nvelocity_mm_s = 60000\ncounts_per_mm = 100\n[fly]\nmode = "
          "'encoder'\n");
    const Ran ran = motionrack("mark job.toml -q --picture ''");
    EXPECT_THAT(ran.out, testing::Not(HasSubstr("velocity profile"))) << ran.out;
}

TEST_F(MarkCommand, ShowsItsProgressAndWritesNothingWhenStopped) {
    write("long.toml",
          "[drawing]\ntext = 'AAAAAAAAAAAAAAAAAAAAAAAA'\n[pace]\nmark_speed_mm_s = 0.4\n[belt]\nvelocity_mm_s = "
          "0.02\n[fly]\nmode "
          "= 'encoder'\n[galvo]\nideal_mirrors = false\n");
    // Runs the command in a separate terminal and sends Ctrl-C once progress is shown.
    const Ran ran = shell(
        "{ for i in $(seq 3000); do grep -qs ' %  marking' seen && break; sleep 0.02; done; printf '\\003'; } | "
        "script -qefc '" MOTIONRACK_PROGRAM " mark long.toml --report r.html' seen > /dev/null");
    EXPECT_EQ(ran.code, 130) << ran.out;
    EXPECT_THAT(text_of(folder / "seen"), AllOf(HasSubstr(" %  marking"), HasSubstr("Stopped; nothing was written.")));
    EXPECT_FALSE(there("mark.svg") || there("r.html"));
    const Ran stopped = shell(interrupted(MOTIONRACK_PROGRAM " mark long.toml --report r.html", "0.3"));
    EXPECT_EQ(stopped.code, 130) << stopped.out;
    EXPECT_THAT(stopped.out, HasSubstr("Stopped; nothing was written."));
    EXPECT_FALSE(there("mark.svg") || there("r.html"));
}

TEST_F(MarkCommand, CalibratesOrReportsWhyNot) {
    EXPECT_THAT(motionrack("calibrate scale --readings 1000 51000 --distance 50").out, HasSubstr("1000 +- "));
    struct Case {
        const char* arguments;
        int code;
        const char* said;
    };
    for (const Case& c :
         {Case{"scale --readings 5 5 --distance 50", 3, "readings"},
          Case{"scale --readings 1 2 --distance 0", 3, "distance"},
          Case{"scale --readings 1 --distance 5", 1, "--readings"}, Case{"scale --readings 1 nan --distance 5", 3, ""},
          Case{"rotary --marks 0 0 0 1 1 100 2 2 200", 3, "line"}, Case{"rotary --marks 1 2 3", 1, "--marks"},
          Case{"lag --velocities 100 100 --shifts 0.1 0.2", 3, "velocity"},
          Case{"lag --velocities 100 500 --shifts 0.1 -9", 3, ""}, Case{"", 1, "subcommand"}}) {
        const Ran ran = motionrack(std::string("calibrate ") + c.arguments);
        EXPECT_EQ(ran.code, c.code) << c.arguments << ": " << ran.out;
        EXPECT_THAT(ran.out, HasSubstr(c.said)) << c.arguments;
    }
}

}  // namespace
}  // namespace motionrack
