// `motionrack sweep`: its page and its examples, the same table for any number of threads and kills, and every error
// message with its position.
#include <fcntl.h>
#include <gmock/gmock.h>

#include <csignal>
#include <sstream>
#include <string>
#include <tests/source_root.hpp>
#include <tests/text_of.hpp>
#include <vector>

#include "ran.hpp"

namespace motionrack {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* rack_text =
    "[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\nmax_limit_mm = "
    "300\n[axis.X.switches]\nlimit_plus_mm = 302\n[axis.Y]\ncard = \"m\"\nchannel = \"y\"\n";

std::vector<std::string> lines_of(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> out;
    for (std::string line; std::getline(in, line);) out.push_back(line);
    return out;
}

class SweepCommand : public InFolder {
  protected:
    void SetUp() override {
        InFolder::SetUp();
        write("rack.toml", rack_text);
        write("part.ngc", "G21 G90 G64 P{TOLERANCE}\nG1 X40 Y20 F3000\nX80 Y0\nX120 Y40\nG0 X0 Y0\n");
        write("sweep.toml",
              "[sweep]\nprogram = \"part.ngc\"\nrack = \"rack.toml\"\n[vary]\naxis.X.max_accel_mm_s2 = { from = 500, "
              "to = 4000, steps = 8 }\n"
              "text.TOLERANCE = [0.01, 0.05, 0.1, 0.2]\nfault = [\"\", \"X.limit_plus=0@500ms\"]\n");
    }
    /// Sends a signal to a sweep in the background once it has this number of rows. Returns its exit code, or minus the
    /// signal; its output is in said.txt.
    int signal_after(int signal, const std::string& arguments, std::size_t rows) const {
        const pid_t child = ::fork();
        if (child == 0) {
            const int said = ::open((folder / "said.txt").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
            ::dup2(said, 1);
            ::dup2(said, 2);
            if (::chdir(folder.c_str()) == 0)
                ::execl("/bin/sh", "sh", "-c", ("exec " MOTIONRACK_PROGRAM " sweep " + arguments).c_str(), nullptr);
            ::_exit(127);
        }
        int status = 0;
        bool ended = false;
        while (!ended && lines_of(text_of(folder / "out.csv.part")).size() <= rows)
            ended = ::waitpid(child, &status, WNOHANG) != 0;
        if (!ended) {
            ::kill(child, signal);
            ::waitpid(child, &status, 0);
        }
        return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }
    std::string table(const std::string& arguments) const {
        const Ran ran = motionrack("sweep " + arguments);
        EXPECT_EQ(ran.code, 0) << ran.out;
        return text_of(folder / "out.csv");
    }
};

TEST_F(SweepCommand, PageShowsTheOutputAndPicturesOfTheCommand) {
    const auto codes = run_page("docs/howto/sweep.md");
    EXPECT_EQ(codes.size(), 3u);
    const std::string page = text_of(source_root / "docs/howto/sweep.md");
    for (const std::string name : {"acceleration", "tolerance", "chance"}) {
        const std::string picture = "sweep_" + name + ".svg";
        EXPECT_THAT(page, HasSubstr("](../pictures/" + picture + ")"));
        EXPECT_EQ(text_of(folder / picture), text_of(source_root / "docs/pictures" / picture))
            << "make it anew: motionrack sweep examples/sweep/" << name << ".toml --picture docs/pictures/" << picture;
    }
}

TEST_F(SweepCommand, GivesTheSameTableWithAnyNumberOfThreadsAndAfterKills) {
    const std::string whole = table("sweep.toml -o out.csv --jobs 1");
    ASSERT_EQ(lines_of(whole).size(), 65u);
    EXPECT_EQ(table("sweep.toml -o out.csv --jobs 2 --restart"), whole);
    std::filesystem::remove(folder / "out.csv");
    for (const std::size_t rows : {3, 20, 21, 40})
        EXPECT_EQ(signal_after(SIGKILL, "sweep.toml -o out.csv --jobs 2", rows), -SIGKILL);
    EXPECT_FALSE(std::filesystem::exists(folder / "out.csv"));
    // A row truncated by a full disk or a power failure is computed again.
    std::ofstream(folder / "out.csv.part", std::ios::app) << "0123456789abcdef0123456789abcdef,63,4000,0.2,,ok,1.0";
    const Ran rest = motionrack("sweep sweep.toml -o out.csv");
    EXPECT_EQ(rest.code, 0);
    EXPECT_THAT(rest.out, HasSubstr(" of 64 points were finished before\n"));
    EXPECT_EQ(text_of(folder / "out.csv"), whole);
    EXPECT_FALSE(std::filesystem::exists(folder / "out.csv.part"));
}

TEST_F(SweepCommand, GivesTheSameHdf5FileToo) {
    ASSERT_EQ(motionrack("sweep sweep.toml -o a.h5 --jobs 2").code, 0);
    ASSERT_EQ(motionrack("sweep sweep.toml -o b.h5 --jobs 1").code, 0);
    EXPECT_EQ(text_of(folder / "a.h5"), text_of(folder / "b.h5"));
    const Ran again = motionrack("sweep sweep.toml -o a.h5");
    EXPECT_THAT(again.out, HasSubstr("64 of 64 points were finished before"));
    EXPECT_EQ(text_of(folder / "a.h5"), text_of(folder / "b.h5"));
    const Ran read = shell(
        "/usr/bin/python3 -c \"import h5py; f=h5py.File('a.h5'); print(len(f['key']), "
        "f['time_s'].attrs['unit'].decode(), f['text.TOLERANCE'][3], f['ended'][0].decode())\"");
    EXPECT_EQ(read.out, "64 s 0.05 ok\n");
}

TEST_F(SweepCommand, RefusesTablesOfFormerVersions) {
    const auto refused = [&](const std::string& file) {
        const std::string before = text_of(folder / file);
        const Ran ran = motionrack("sweep sweep.toml -o " + file);
        EXPECT_EQ(ran.code, 3) << ran.out;
        EXPECT_EQ(text_of(folder / file), before);
        return ran.out;
    };
    write("former.csv", "key,point,text.TOLERANCE,ended,time_s,worst_deviation_mm\n");
    EXPECT_THAT(refused("former.csv"), HasSubstr("'worst_deviation_mm' is now 'max_deviation_mm'"));
    ASSERT_EQ(motionrack("sweep sweep.toml -o former.h5 --jobs 2").code, 0);
    shell("/usr/bin/python3 -c \"import h5py; f=h5py.File('former.h5','r+'); f.attrs['format_version']=1; f.close()\"");
    EXPECT_THAT(refused("former.h5"), HasSubstr("The table has format 1, as motionrack "));
}

TEST_F(SweepCommand, PrintsTheReportOfRun) {
    const std::string csv = table("sweep.toml -o out.csv");
    const std::vector<std::string> lines = lines_of(csv);
    EXPECT_THAT(lines[0],
                HasSubstr("key,point,axis.X.max_accel_mm_s2,text.TOLERANCE,fault,ended,time_s,max_deviation_mm,x_peak_"
                          "velocity_mm_s,x_peak_accel_mm_s2,x_lost_pulses,x_rest_error_mm,y_peak_velocity"));
    EXPECT_THAT(lines[0], Not(HasSubstr("z_peak")));
    write("same.ngc", "G21 G90 G64 P0.05\nG1 X40 Y20 F3000\nX80 Y0\nX120 Y40\nG0 X0 Y0\n");
    shell("sed -i 's/max_limit_mm = 300/max_limit_mm = 300\\nmax_accel_mm_s2 = 500/' rack.toml");
    const Ran ran = motionrack("run same.ngc --rack rack.toml --no-report --json -q --fault X.limit_plus=0@500ms");
    const std::size_t at = ran.out.find("\"trace_hash\": \"") + 15;
    EXPECT_THAT(lines[4], testing::EndsWith("," + ran.out.substr(at, 16) + "\r"));
    EXPECT_THAT(lines[4], HasSubstr(",3,500,0.05,X.limit_plus=0@500ms,machine,"));
}

TEST_F(SweepCommand, RejectsRowsOfAnotherProgramRackOrValue) {
    (void)table("sweep.toml -o out.csv");
    write("rack.toml", std::string("# a comment changes nothing\n") + rack_text);
    EXPECT_THAT(motionrack("sweep sweep.toml -o out.csv").out, HasSubstr("64 of 64 points were finished before"));
    shell("sed -i 's/0.01, 0.05, 0.1, 0.2/0.02, 0.05, 0.1, 0.2/' sweep.toml");
    EXPECT_THAT(motionrack("sweep sweep.toml -o out.csv").out, HasSubstr("48 of 64 points were finished before"));
    write("rack.toml", std::string(rack_text) + "max_accel_mm_s2 = 900\n");
    EXPECT_THAT(motionrack("sweep sweep.toml -o out.csv").out, Not(HasSubstr("before")));
    shell("sed -i 's/X120/X121/' part.ngc");
    EXPECT_THAT(motionrack("sweep sweep.toml -o out.csv").out, Not(HasSubstr("before")));
    EXPECT_THAT(motionrack("sweep sweep.toml -o out.csv --restart").out, Not(HasSubstr("before")));
}

TEST_F(SweepCommand, EndsOnRequestAndStatesHowToContinue) {
    EXPECT_EQ(signal_after(SIGINT, "examples/sweep/chance.toml -o out.csv --jobs 1", 5), 130);
    EXPECT_THAT(
        text_of(folder / "said.txt"),
        HasSubstr(
            " of 120 points are finished and kept in out.csv.part; the same command continues with the other points."));
    EXPECT_EQ(motionrack("sweep examples/sweep/chance.toml -o out.csv -q").code, 0);
    EXPECT_EQ(lines_of(text_of(folder / "out.csv")).size(), 121u);
}

TEST_F(SweepCommand, RejectsBadFilesWithTheirLocationBeforeAnythingRuns) {
    struct Case {
        const char *vary, *place, *said;
    };
    for (const Case& c : {
             Case{"axis.X.max_acel_mm_s2 = [1]", "bad.toml:5:", "did you mean 'max_accel_mm_s2'?"},
             Case{"axis.X.max_accel_mm_s2 = [500, -5]", "bad.toml:5:32", "outside its range"},
             Case{"\"axis.X.max_accel_mm_s2\" = [500, \"much\"]", "bad.toml:5:34", "must be a number"},
             Case{"axis.X = [500]", "bad.toml:5:6", "table of the rack file"},
             Case{"axis.X.card.name = [500]", "bad.toml:5:", "cannot be varied"},
             Case{"axs.X.max_mm = [500]", "bad.toml:5:", "did you mean 'axis'?"},
             Case{"axis.X.max_limit_mm = [500, 200]\naxis.X.initial_position_mm = [0, 250]", "bad.toml:6:", "250"},
             Case{"axis.X.max_limit_mm = { from = 1, to = 2, stops = 3 }", "bad.toml:5:43", "did you mean 'steps'?"},
             Case{"axis.X.max_limit_mm = { from = 100, to = 200 }", "bad.toml:5:23", "has no steps"},
             Case{"axis.X.max_limit_mm = { from = 100, to = 100, steps = 2 }", "bad.toml:5:42", "are both 100"},
             Case{"axis.X.max_limit_mm = { from = 100, to = nan, steps = 2 }", "bad.toml:5:42", "nan"},
             Case{"axis.X.microsteps = { from = 4, to = 6, steps = 9, integer = true }", "bad.toml:5:49",
                  "only 3 whole numbers"},
             Case{"axis.X.max_limit_mm = { from = 100, to = 200, steps = 400 }\n"
                  "axis.Y.max_limit_mm = { from = 100, to = 200, steps = 400 }",
                  "bad.toml:4:", "160000 points"},
             Case{"axis.X.max_limit_mm = []", "bad.toml:5:23", "has no values"},
             Case{"axis.X.max_limit_mm = [[1]]", "bad.toml:5:24", "an array in its list"},
             Case{"fault = [\"X.limit_plus=0\"]", "bad.toml:5:10", "needs its time"},
             Case{"fault = [\"\", \"X.limitplus=0@1s\"]", "bad.toml:5:14", "did you mean 'X.limit_plus'?"},
             Case{"fault = [1]", "bad.toml:5:10", "faults are texts"},
             Case{"text.WORD = [1]", "bad.toml:5:6", "has no {WORD}"},
             Case{"text.\"A B\" = [1]", "bad.toml:5:6", "is not a text of the program"},
             Case{"\"axis.X.max_limit_mm\" = [100]\naxis.X.max_limit_mm = [200]", "bad.toml:6:", "varied twice"},
             Case{"", "bad.toml:4:2", "Nothing is varied"},
         }) {
        write("good.ngc", "G21 G90\nG1 X10 F600\n");
        write("bad.toml",
              std::string("[sweep]\nprogram = \"good.ngc\"\nrack = \"rack.toml\"\n[vary]\n") + c.vary + "\n");
        const Ran ran = motionrack("sweep bad.toml -o out.csv");
        EXPECT_EQ(ran.code, 2) << c.vary;
        EXPECT_THAT(ran.out, HasSubstr(c.place)) << c.vary;
        EXPECT_THAT(ran.out, HasSubstr(c.said)) << c.vary;
        EXPECT_FALSE(std::filesystem::exists(folder / "out.csv.part")) << c.vary;
    }
}

TEST_F(SweepCommand, RejectsErrorsInItsFiles) {
    const auto refused = [&](const std::string& sweep, int code, const std::string& said) {
        write("bad.toml", sweep);
        const Ran ran = motionrack("sweep bad.toml -o out.csv");
        EXPECT_EQ(ran.code, code) << sweep << ran.out;
        EXPECT_THAT(ran.out, HasSubstr(said));
        EXPECT_FALSE(std::filesystem::exists(folder / "out.csv.part"));
    };
    const std::string vary = "[vary]\ntext.TOLERANCE = [0.1, 0.2]\n";
    refused("[sweep]\nprogram = \"part.ngc\"\nrack = \"rack.toml\"\nthreads = 3\n" + vary, 2, "bad.toml:4:1");
    refused("[sweep]\nprogram = \"part.ngc\"\npoints = 3\n" + vary, 2, "bad.toml:3:10");
    refused("[sweep]\nprogram = \"part.ngc\"\nsampling = \"random\"\n" + vary, 2, "needs points");
    refused("[sweep]\nprogram = \"part.ngc\"\nsampling = \"random\"\npoints = 1000000\n" + vary, 2,
            "outside its range 1 .. 100000");
    refused("[sweep]\nrack = \"rack.toml\"\n" + vary, 2, "has no program");
    refused("[swep]\n" + vary, 2, "did you mean 'sweep'?");
    refused("[sweep\n", 2, "bad.toml:1:");
    refused("[sweep]\nprogram = \"nothere.ngc\"\n" + vary, 5, "nothere.ngc");
    refused("[sweep]\nprogram = \"part.ngc\"\nrack = \"nothere.toml\"\n" + vary, 5, "nothere.toml");
    write("wrong.toml", std::string(rack_text) + "max_mmm = 3\n");
    refused("[sweep]\nprogram = \"part.ngc\"\nrack = \"wrong.toml\"\n" + vary, 2, "wrong.toml:12:1");
    refused("[sweep]\nprogram = \"part.ngc\"\n[vary]\ntext.TOLERANCE = [0.1, \"wide\"]\n", 2, "part.ngc:1:");
    refused("[sweep]\nprogram = \"part.ngc\"\n[vary]\ntext.TOLERANCE = [0.1, \"wide\"]\n", 2,
            "(with TOLERANCE = wide)");
    write("far.ngc", "G21 G90 G64 P{TOLERANCE}\nG1 X4000 F600\n");
    refused("[sweep]\nprogram = \"far.ngc\"\nrack = \"rack.toml\"\n" + vary, 3, "far.ngc:2:");
    EXPECT_EQ(motionrack("sweep sweep.toml -o sweep.toml").code, 3);
    write("other.csv", "name,value\r\na,1\r\n");
    const Ran other = motionrack("sweep sweep.toml -o other.csv");
    EXPECT_EQ(other.code, 3);
    EXPECT_THAT(other.out, HasSubstr("not a table of a sweep"));
    EXPECT_EQ(text_of(folder / "other.csv"), "name,value\r\na,1\r\n");
    EXPECT_EQ(motionrack("sweep sweep.toml -o no/such/folder.csv").code, 5);
    EXPECT_EQ(motionrack("sweep sweep.toml --jobs 0").code, 1);
}

TEST_F(SweepCommand, RowsReportTheErrorOfAPoint) {
    // The travel of one point is too short for the program, which is a valid result.
    write("travel.toml",
          "[sweep]\nprogram = \"part.ngc\"\nrack = \"rack.toml\"\n[vary]\naxis.X.max_limit_mm = [100, "
          "300]\ntext.TOLERANCE = "
          "0.1\nfault = [\"\", \"X.motor.lose_steps=64@500ms\"]\n");
    const std::string csv = table("travel.toml -o out.csv --picture out.svg");
    const std::vector<std::string> lines = lines_of(csv);
    ASSERT_EQ(lines.size(), 5u);
    EXPECT_THAT(lines[1], HasSubstr(",100,0.1,,refused,,,"));
    EXPECT_THAT(lines[3], HasSubstr(",300,0.1,,ok,"));
    EXPECT_THAT(lines[4], HasSubstr(",300,0.1,X.motor.lose_steps=64@500ms,lost_steps,"));
    EXPECT_THAT(text_of(folder / "out.svg"),
                Not(testing::AnyOf(HasSubstr("nan"), HasSubstr("inf\""), HasSubstr("inf,"))));
}

}  // namespace
}  // namespace motionrack
