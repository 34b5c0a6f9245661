// Commands that cannot be intended: each answer has an explanation, and nothing moves.
#include <gmock/gmock.h>

#include <tests/ran.hpp>
#include <tests/served_program.hpp>

namespace motionrack {
namespace {

using nlohmann::json;
using testing::HasSubstr;

using EmptyProgram = InFolder;

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
            const Ran ran = motionrack(line);
            EXPECT_EQ(ran.code, 2) << line << ": " << ran.out;
            EXPECT_THAT(ran.out, HasSubstr(std::string(program) + ":1:1: the program is empty")) << line;
        }
    for (const char* result : {"a.html", "a.h5", "a.vcd", "a.svg"})
        EXPECT_FALSE(std::filesystem::exists(folder / result)) << result;
    EXPECT_EQ(shell("printf '' | " MOTIONRACK_PROGRAM " run - -q --no-report").code, 2);
    write("units.ngc", "G21\n");
    EXPECT_EQ(motionrack("run units.ngc -q --no-report").code, 0) << "it says what is to be set";
}

class ServedMachine : public InFolder {
  protected:
    void SetUp() override {
        InFolder::SetUp();
        write("one.toml",
              "[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\ninitial_position_mm = 10\n");
    }
};

TEST_F(ServedMachine, RefusesWhatCannotBeMeantInTheAnswer) {
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
