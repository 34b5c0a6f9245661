// Commands with nonsensical arguments are rejected with an explanation and little processor time, and nothing moves.
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <tests/ran.hpp>
#include <tests/served_program.hpp>
#include <vector>

namespace motionrack {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// Returns the processor time that all ended commands used, s.
double processor_seconds() {
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) / 1e6;
    };
    rusage usage{};
    EXPECT_EQ(::getrusage(RUSAGE_CHILDREN, &usage), 0);
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

class RefusedCommand : public InFolder {
  protected:
    /// Expects the command to use less than a second of processor time, which is dozens of times its need.
    Ran refused(const std::string& arguments) const {
        const double before = processor_seconds();
        Ran ran = motionrack(arguments);
        EXPECT_LT(processor_seconds() - before, 1) << arguments;
        return ran;
    }
    void expect_no_file(const std::vector<const char*>& names) const {
        for (const char* name : names) EXPECT_FALSE(std::filesystem::exists(folder / name)) << name;
    }
};
using EmptyProgram = RefusedCommand;
using DrawingOutsideTheField = RefusedCommand;

TEST_F(EmptyProgram, IsRefusedByEachCommand) {
    write("empty.ngc", "");
    write("comments.ngc", "%\n(part 7)\n\n; to do\n%\n");
    write("stage.toml", text_of(source_root / "examples/13_stage/machine.toml"));
    for (const char* program : {"empty.ngc", "comments.ngc"})
        for (const char* command :
             {"run PROGRAM -q --report a.html --record a.h5", "run PROGRAM -q --no-report --stream",
              "trace PROGRAM a.vcd -q", "check PROGRAM", "plan PROGRAM --picture a.svg", "bench PROGRAM"}) {
            std::string line = command;
            line.replace(line.find("PROGRAM"), 7, program);
            const Ran ran = refused(line);
            EXPECT_EQ(ran.code, 2) << line << ": " << ran.out;
            EXPECT_THAT(ran.out, HasSubstr(std::string(program) + ":1:1: the program is empty")) << line;
        }
    expect_no_file({"a.html", "a.h5", "a.vcd", "a.svg"});
    EXPECT_EQ(shell("printf '' | " MOTIONRACK_PROGRAM " run - -q --no-report").code, 2);
    write("units.ngc", "G21\n");
    EXPECT_EQ(motionrack("run units.ngc -q --no-report").code, 0) << "it says what is to be set";
}

TEST_F(DrawingOutsideTheField, IsRejectedBeforeAnythingIsMarked) {
    write("line.svg", "<svg width='10mm' height='10mm' viewBox='0 0 10 10'><path d='M 0 0 H 10'/></svg>");
    write("far.svg", "<svg width='10mm' height='10mm' viewBox='0 0 10 10'><path d='M 0 0 H 1e8'/></svg>");
    const auto expect_refusal = [&](const std::string& drawing, int code, const char* sentence) {
        write("job.toml", "[drawing]\n" + drawing + "\n");
        const Ran ran = refused("mark job.toml -q --picture a.svg --report a.html");
        EXPECT_EQ(ran.code, code) << drawing << ": " << ran.out;
        EXPECT_THAT(ran.out, HasSubstr(sentence)) << drawing;
        EXPECT_THAT(ran.out, HasSubstr("Nothing was marked")) << drawing;
    };
    expect_refusal("svg = 'line.svg'\nx_mm = 1000", 3, "outside the field");
    expect_refusal("text = 'I'\ny_mm = -1000", 3, "outside the field");
    expect_refusal("svg = 'line.svg'\nx_mm = 1000\nscale = 1e6", 2, "more than 100000 mm from the field's middle");
    expect_refusal("svg = 'far.svg'", 2, "more than 100000 mm from the field's middle");
    expect_no_file({"a.svg", "a.html"});
}

class ServedMachine : public InFolder {
  protected:
    void SetUp() override {
        InFolder::SetUp();
        write("one.toml",
              "[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\ninitial_position_mm = 10\n");
    }
};

TEST_F(ServedMachine, RejectsImplausibleCommandsInTheAnswer) {
    Served served(
        {(folder / "one.toml").string(), "--port", "0", "--no-auth", "--users", (folder / "users.json").string()});
    EXPECT_TRUE(served.post("take_control").contains("done"));
    EXPECT_TRUE(served.post("enable", {{"on", true}}).contains("done"));
    const auto refused = [&](const char* order, const json& fields, const char* sentence) {
        const json answer = served.post(order, fields);
        EXPECT_FALSE(answer.contains("done")) << answer;
        EXPECT_THAT(answer.dump(), HasSubstr(sentence));
    };
    refused("jog", {{"axis", "X"}, {"speed", 1e6}}, "the jog speed is 1e+06 mm/s; it must be at most 100 for axis X");
    refused("jog", {{"axis", "X"}, {"speed", -1e6}}, "Nothing was moved");
    refused("jog_by", {{"axis", "X"}, {"distance", 1}, {"speed", 1e6}}, "the jog speed is 1e+06 mm/s");
    refused("jog_by", {{"axis", "X"}, {"distance", 1e6}, {"speed", 5}}, "the travel of axis X is 300");
    refused("start_program", {{"name", "a.ngc"}, {"text", "; nothing\n"}}, "the program is empty");
    refused("start_program", {{"name", "a.ngc"}, {"text", ""}}, "");
    refused("mdi", {{"text", "G0 X1e9"}}, "");
    const json status = served.status();
    EXPECT_EQ(status["state"], "standstill");
    EXPECT_EQ(status["axes"][0]["commanded"], 10);
    EXPECT_EQ(served.end(SIGTERM), 0);
}

}  // namespace
}  // namespace motionrack
