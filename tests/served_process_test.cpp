// The served program as a process: signals, and a blocked or closed output.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <tests/ran.hpp>
#include <tests/served_program.hpp>

namespace motionrack {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class ServedProcess : public InFolder {
  protected:
    void SetUp() override {
        InFolder::SetUp();
        write("one.toml", "[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\n");
    }
    std::vector<std::string> arguments() const {
        return {(folder / "one.toml").string(), "--port", "0", "--users", (folder / "users.json").string()};
    }
    /// Pairs with the printed code; the next code is printed then.
    static json pair(Served& served) {
        const std::size_t at = served.said.find("#pair=");
        return served.post("pair", {{"code", served.said.substr(at + 6, 9)}, {"name", "anna"}});
    }
};

TEST_F(ServedProcess, ContinuesWhileItsOutputIsNotRead) {
    Served served(arguments());
    served.fill_output();
    EXPECT_TRUE(pair(served).contains("token"));
    EXPECT_TRUE(served.status().contains("axes"));
    EXPECT_TRUE(served.post("stop").contains("done"));
    EXPECT_EQ(served.end(SIGTERM), 0);
}

TEST_F(ServedProcess, ContinuesWhenTheReaderOfItsOutputCloses) {
    Served served(arguments());
    served.close_output();
    EXPECT_TRUE(pair(served).contains("token"));
    EXPECT_TRUE(served.status().contains("axes"));
    EXPECT_EQ(served.end(SIGTERM), 0);
}

TEST_F(ServedProcess, StopsTheAxesWhenItsTerminalIsClosed) {
    Served served(arguments());
    EXPECT_EQ(served.end(SIGHUP), 0);
}

TEST_F(ServedProcess, ContinuesAfterItsTerminalClosesUnderNohup) {
    ::signal(SIGHUP, SIG_IGN);
    Served served(arguments());
    ::signal(SIGHUP, SIG_DFL);
    ::kill(served.process(), SIGHUP);
    EXPECT_TRUE(served.status().contains("axes"));
    EXPECT_EQ(served.end(SIGTERM), 0);
}

TEST_F(ServedProcess, IsNotStartedWithAJournalThatOthersMayWriteOrReplace) {
    const std::string command = "serve one.toml --port 0 --users users.json --journal ";
    write("open.journal", "");
    ::chmod((folder / "open.journal").c_str(), 0666);
    Ran ran = motionrack(command + "open.journal");
    EXPECT_EQ(ran.code, 2);
    EXPECT_THAT(ran.out, HasSubstr("Others may write the journal (mode 666)"));
    std::filesystem::create_directory(folder / "open");
    ::chmod((folder / "open").c_str(), 0777);
    ran = motionrack(command + "open/rack.journal");
    EXPECT_EQ(ran.code, 2);
    EXPECT_THAT(ran.out, HasSubstr("Others may replace the journal: its folder open is open to them"));
    std::filesystem::create_symlink("open/rack.journal", folder / "link.journal");
    ran = motionrack(command + "link.journal");
    EXPECT_EQ(ran.code, 2);
    EXPECT_THAT(ran.out, HasSubstr("Others may replace the journal: its folder open is open to them"));
    EXPECT_FALSE(std::filesystem::exists(folder / "open/rack.journal"));
}

TEST_F(ServedProcess, IsNotStartedWithARealCardThatCannotBeServed) {
    write("two.toml",
          "[card.m]\ntype = \"mcx314\"\n[card.bench]\ntype = \"mcx314\"\n"
          "[axis.X]\ncard = \"m\"\nchannel = \"x\"\n");
    struct Bad {
        const char* options;
        int code;
        const char* says;
    };
    for (const auto& [options, code, says] :
         {Bad{"--unthrottled --live bench=port:/dev/zero", 3,
              "the rack's clock is 'unthrottled' with factor 1. Nothing was started."},
          Bad{"--paused --live bench=port:/dev/zero", 3, "the rack's clock is 'paused'"},
          Bad{"--time-scale 2 --live bench=port:/dev/zero", 3, "the rack's clock is 'real' with factor 2"},
          Bad{"--live m=port:/dev/zero", 3, "Card m moves X of the machine"},
          Bad{"--live other=port:/dev/zero", 2, "the cards of this rack are: m, bench"},
          Bad{"--live bench", 2, "does not name a card and its address"}}) {
        const Ran ran = motionrack("serve two.toml --port 0 --users users.json " + std::string(options));
        EXPECT_EQ(ran.code, code) << options;
        EXPECT_THAT(ran.out, HasSubstr(says));
    }
}

}  // namespace
}  // namespace motionrack
