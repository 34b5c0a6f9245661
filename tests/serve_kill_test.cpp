// State after a run was killed: no acknowledged command is lost. The next run knows the executed program and its line,
// and that no axis position is valid. After a requested end all positions are valid.
#include <gmock/gmock.h>

#include <motionrack/journal/journal.hpp>
#include <random>
#include <tests/environment.hpp>
#include <tests/ran.hpp>
#include <tests/served_program.hpp>

namespace motionrack {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class RackServer : public InFolder {
  protected:
    void SetUp() override {
        InFolder::SetUp();
        write("table.toml",
              "[rack]\nname = \"table\"\n[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = "
              "\"x\"\nmax_limit_mm "
              "= 1000\n");
    }
    std::vector<std::string> arguments() const {
        return {(folder / "table.toml").string(), "--port", "0", "--no-auth", "--journal", journal(), "--users",
                (folder / "users.json").string()};
    }
    std::string journal() const { return (folder / "table.journal").string(); }
    std::vector<std::string> entries(const std::string& kind) const {
        auto book = journal::Journal::open(journal());
        EXPECT_TRUE(book) << book.error().message;
        std::vector<std::string> out;
        const auto read = (*book)->read({0, kind, 10000});
        for (const journal::Entry& entry : *read) out.push_back(entry.text + " " + entry.data);
        return out;
    }
    /// Enables the machine, takes control, and makes the positions valid.
    static void make_ready(Served& served) {
        EXPECT_TRUE(served.post("take_control").contains("done"));
        EXPECT_TRUE(served.post("enable", {{"on", true}}).contains("done"));
        EXPECT_TRUE(served.post("set_position", {{"axis", "X"}, {"position", 0}}).contains("done"));
    }
};

constexpr const char* long_way = "G1 X500 F3000\nX0\nX500\nX0\nM30\n";

TEST_F(RackServer, LosesNothingAcknowledgedInAHundredKills) {
    const auto seed = static_cast<std::uint32_t>(seed_from_environment());
    SCOPED_TRACE("MOTIONRACK_SEED=" + std::to_string(seed));
    std::mt19937 random(seed);
    const auto among = [&](int min, int max) { return std::uniform_int_distribution<int>(min, max)(random); };
    std::vector<std::string> acknowledged;
    std::string ran;
    const auto kills = static_cast<int>(cases("MOTIONRACK_KILLS", 100));
    for (int kill = 0; kill < kills; ++kill) {
        Served served(arguments());
        if (kill > 0) {
            EXPECT_THAT(served.said, HasSubstr("was interrupted"));
            if (!ran.empty()) {
                EXPECT_THAT(served.said, HasSubstr(ran));
            }
            const json status = served.status();
            ASSERT_TRUE(status.contains("axes")) << status.dump();
            EXPECT_FALSE(status["axes"][0]["position_valid"]);
            ASSERT_EQ(status["alarms"].size(), 1u);
        }
        make_ready(served);
        const std::string name = "kill_" + std::to_string(kill) + ".ngc";
        ran.clear();
        if (served.post("start_program", {{"name", name}, {"text", long_way}}).contains("done"))
            acknowledged.push_back(ran = name);
        for (int order = among(0, 12); order > 0; --order) {
            const double feed = 0.5 + 0.00001 * static_cast<double>(acknowledged.size());
            if (served.post("set_overrides", {{"feed", feed}}).contains("done"))
                acknowledged.push_back(json(feed).dump());
        }
        // Half of the kills happen while a command is in progress.
        if (among(0, 1) == 1) (void)served.send("POST", "set_overrides", json{{"feed", 1.5}}.dump());
        ASSERT_EQ(served.end(SIGKILL), -SIGKILL);
    }
    EXPECT_GT(acknowledged.size(), 3u * static_cast<std::size_t>(kills));
    const std::vector<std::string> orders = entries("command");
    std::size_t at = 0;
    for (const std::string& one : acknowledged) {
        while (at < orders.size() && orders[at].find(one) == std::string::npos) ++at;
        ASSERT_LT(at, orders.size()) << one << " was acknowledged and is not in the journal, or not in its place";
    }
}

TEST_F(RackServer, KilledAtStandstillKeepsItsPositionsAsKnown) {
    {
        Served served(arguments());
        make_ready(served);
        EXPECT_EQ(served.end(SIGKILL), -SIGKILL);
    }
    {
        Served served(arguments());
        EXPECT_THAT(served.said, HasSubstr("was interrupted"));
        const json status = served.status();
        EXPECT_FALSE(status["axes"][0]["position_valid"]) << "anything could have moved it since";
    }
    EXPECT_EQ(entries("command").size(), 3u);
}

TEST_F(RackServer, KeepsItsPositionsAfterARequestedEnd) {
    {
        Served served(arguments());
        make_ready(served);
        EXPECT_TRUE(
            served.post("start_program", {{"name", "there.ngc"}, {"text", "G1 X12.5 F6000\nM30\n"}}).contains("done"));
        while (served.status()["axes"][0]["commanded"] != 12.5) continue;
        EXPECT_EQ(served.end(SIGTERM), 0);
    }
    Served served(arguments());
    EXPECT_THAT(served.said, testing::Not(HasSubstr("cut off")));
    const json status = served.status();
    EXPECT_EQ(status["axes"][0]["commanded"], 12.5);
    EXPECT_TRUE(status["axes"][0]["position_valid"]);
    EXPECT_TRUE(status["alarms"].empty());
}

TEST_F(RackServer, KeepsItsPositionsAfterAStartThatFailed) {
    {
        Served served(arguments());
        make_ready(served);
        EXPECT_EQ(served.end(SIGTERM), 0);
    }
    {
        const Served other({(folder / "table.toml").string(), "--port", "0", "--no-auth", "--users",
                            (folder / "others.json").string()});
        const Ran ran = motionrack("serve table.toml --no-auth --users users.json --journal table.journal --port " +
                                   std::to_string(other.port()));
        EXPECT_EQ(ran.code, 5);
        EXPECT_THAT(ran.out, HasSubstr("is used by another program. Nothing was started"));
    }
    Served served(arguments());
    EXPECT_THAT(served.said, testing::Not(HasSubstr("interrupted")));
    const json status = served.status();
    EXPECT_TRUE(status["axes"][0]["position_valid"]);
    EXPECT_TRUE(status["alarms"].empty());
}

TEST_F(RackServer, StopsAMoveBeforeItEnds) {
    Served served(arguments());
    make_ready(served);
    EXPECT_TRUE(served.post("start_program", {{"name", "long.ngc"}, {"text", long_way}}).contains("done"));
    while (served.status()["axes"][0]["commanded"].get<double>() < 5) continue;
    EXPECT_EQ(served.end(SIGINT), 0);
    const std::vector<std::string> jobs = entries("job");
    ASSERT_EQ(jobs.size(), 2u);
    EXPECT_THAT(jobs[1], HasSubstr("long.ngc was stopped at line 1 of 5"));
}

}  // namespace
}  // namespace motionrack
