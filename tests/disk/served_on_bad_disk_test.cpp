// A served rack whose disk fails: a command that is not recorded is not acknowledged, the machine holds, and the next
// start has no valid position. A pairing that is not written is not acknowledged either.
#include <gmock/gmock.h>

#include <cstdlib>
#include <functional>
#include <motionrack/journal/journal.hpp>
#include <tests/environment.hpp>
#include <tests/ran.hpp>
#include <tests/served_program.hpp>

namespace motionrack {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// Makes the disk fail for the programs that are started during its lifetime.
class BadDiskAhead {
  public:
    /// `plan`: "fail 12"; `full`: path of a file, the disk is full while it exists; `count`: receives the number of
    /// calls.
    BadDiskAhead(const std::string& folder, const std::string& plan, const std::string& full,
                 const std::string& count) {
        ::setenv("MOTIONRACK_BAD_FOLDER", (folder + "/").c_str(), 1);
        ::setenv("MOTIONRACK_BAD_CALL", plan.c_str(), 1);
        ::setenv("MOTIONRACK_BAD_WHILE", full.c_str(), 1);
        ::setenv("MOTIONRACK_BAD_COUNT", count.c_str(), 1);
        ::setenv("LD_PRELOAD", MOTIONRACK_BAD_CALLS, 1);
    }
    ~BadDiskAhead() {
        for (const char* name : {"MOTIONRACK_BAD_FOLDER", "MOTIONRACK_BAD_CALL", "MOTIONRACK_BAD_WHILE",
                                 "MOTIONRACK_BAD_COUNT", "LD_PRELOAD"})
            ::unsetenv(name);
    }
    BadDiskAhead(const BadDiskAhead&) = delete;
    BadDiskAhead& operator=(const BadDiskAhead&) = delete;
};

class ServedRackOnABadDisk : public InFolder {
  protected:
    void SetUp() override {
        InFolder::SetUp();
        std::filesystem::create_directory(folder / "data");
        write("table.toml",
              "[rack]\nname = \"table\"\n[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = "
              "\"x\"\nmax_limit_mm "
              "= 1000\n");
    }
    std::string at(const char* name) const { return (folder / name).string(); }
    std::vector<std::string> arguments() const {
        return {at("table.toml"), "--port",        "0", "--no-auth", "--journal", at("data/table.journal"),
                "--users",        at("users.json")};
    }
    std::vector<std::string> with_pairing() const {
        return {at("table.toml"), "--port", "0", "--users", at("data/users.json")};
    }
    std::int64_t calls() const { return std::atoll(text_of(folder / "count").c_str()); }
    static bool is_done(const json& answer) { return answer.is_object() && answer.contains("done"); }
    /// Starts a program; repeats the command while the machine still sets the position.
    static json begin(Served& served, const std::string& name, const std::string& text) {
        json answer;
        do answer = served.post("start_program", {{"name", name}, {"text", text}});
        while (answer.dump().find("try again") != std::string::npos);
        return answer;
    }
    /// Result of a short session: its acknowledged commands, and how far it came.
    struct Session {
        std::vector<std::string> acknowledged;
        bool started = false, arrived = false;
        int code = -1;
    };
    /// Sets the position, runs a program that moves to `x`, and ends the server by SIGTERM.
    Session short_session(const std::string& plan, double x) const {
        const BadDiskAhead disk(at("data"), plan, "", at("count"));
        Session out;
        Served served(arguments(), false);
        out.started = served.port() != 0;
        const auto took = [&](const json& answer, const std::string& in_journal) {
            if (is_done(answer) && !answer.contains("unrecorded")) out.acknowledged.push_back(in_journal);
            return is_done(answer);
        };
        if (out.started) {
            took(served.post("take_control"), "take_control");
            took(served.post("enable", {{"on", true}}), "enable on=true");
            took(served.post("set_position", {{"axis", "X"}, {"position", 0}}), "set_position");
        }
        const std::string name = "to_" + json(x).dump() + ".ngc";
        if (out.started && took(begin(served, name, "G1 F6000 X" + json(x).dump() + "\nM30\n"), name))
            while (!out.arrived) {
                const json status = served.status();
                if (!status.contains("state")) break;
                out.arrived = status["axes"][0]["commanded"] == x && status["state"] == "standstill";
                if (status["state"] != "moving" && status["state"] != "standstill") break;
            }
        out.code = served.end(SIGTERM);
        return out;
    }
    /// Checks the journal of a session on a good disk. `lies`: the disk reported success for a call that it dropped.
    void check(const Session& session, bool lies) const {
        if (session.code != 0) {
            EXPECT_EQ(session.code, 5);
        }
        if (!lies) {
            auto book = journal::Journal::open(at("data/table.journal"));
            ASSERT_TRUE(book) << book.error().message;
            const auto read = (*book)->read({0, "command", 10000});
            ASSERT_TRUE(read);
            std::string orders;
            for (const journal::Entry& entry : *read) orders += entry.text + " " + entry.data + "\n";
            for (const std::string& one : session.acknowledged) EXPECT_THAT(orders, HasSubstr(one));
        }
    }
    /// Checks the position at the next start. `before`: position at the end of the previous session; `x`: target of
    /// this.
    void check_positions(const Session& session, bool lies, double before, double x) const {
        Served next(arguments(), false);
        if (next.port() == 0) {
            EXPECT_TRUE(lies) << next.said;
            return;
        }
        const json status = next.status();
        ASSERT_TRUE(status.contains("axes")) << next.said;
        if (status["axes"][0]["position_valid"].get<bool>()) {
            EXPECT_TRUE(session.code == 0 || !session.started);
            EXPECT_EQ(status["axes"][0]["commanded"], session.started ? x : before);
        } else if (!lies) {
            EXPECT_NE(session.code, 0) << next.said;
        }
    }
};

TEST_F(ServedRackOnABadDisk, HoldsWhenTheDiskIsFullAndHasNoValidPositionAfterwards) {
    const BadDiskAhead disk(at("data"), "", at("full"), at("count"));
    {
        Served served(arguments());
        EXPECT_TRUE(is_done(served.post("take_control")));
        EXPECT_TRUE(is_done(served.post("enable", {{"on", true}})));
        EXPECT_TRUE(is_done(served.post("set_position", {{"axis", "X"}, {"position", 0}})));
        EXPECT_TRUE(is_done(begin(served, "a.ngc", "G1 X500 F3000\nX0\nM30\n")));
        while (served.status()["axes"][0]["commanded"].get<double>() < 2) continue;
        write("full", "");
        const json answer = served.post("set_overrides", {{"feed", 0.5}});
        EXPECT_FALSE(is_done(answer)) << answer;
        EXPECT_THAT(answer.dump(), HasSubstr("'set_overrides' is not recorded. The machine holds"));
        while (served.status()["state"] == "moving") continue;
        const json status = served.status();
        EXPECT_EQ(status["state"], "hold");
        ASSERT_EQ(status["alarms"].size(), 1u) << status["alarms"];
        EXPECT_EQ(status["alarms"][0]["source"], "journal");
        std::filesystem::remove(folder / "full");
        for (const char* order : {"resume", "home"}) EXPECT_FALSE(is_done(served.post(order))) << order;
        EXPECT_TRUE(is_done(served.post("stop")));
        EXPECT_FALSE(is_done(served.post("start_program", {{"name", "b.ngc"}, {"text", "G1 X0 F3000\n"}})));
        EXPECT_EQ(served.end(SIGTERM), 5);
    }
    Served served(arguments());
    EXPECT_THAT(served.said, HasSubstr("interrupted"));
    const json status = served.status();
    EXPECT_FALSE(status["axes"][0]["position_valid"]);
    EXPECT_EQ(status["alarms"].size(), 1u);
}

TEST_F(ServedRackOnABadDisk, DoesNotStartWhereTheDiskIsFull) {
    const BadDiskAhead disk(at("data"), "", at("full"), at("count"));
    write("full", "");
    Served served(arguments(), false);
    EXPECT_EQ(served.port(), 0);
    EXPECT_THAT(served.said, HasSubstr("table.journal"));
    EXPECT_EQ(served.end(SIGTERM), 5);
}

TEST_F(ServedRackOnABadDisk, LosesNothingAcknowledgedAndHasNoWrongPositionAsValid) {
    for (const bool first_run : {true, false}) {
        const double before = first_run ? 0 : 0.5, x = 1.5;
        const auto start_anew = [&] {
            std::filesystem::remove_all(folder / "data");
            std::filesystem::create_directory(folder / "data");
            if (!first_run) {
                ASSERT_EQ(short_session("", before).code, 0);
            }
        };
        start_anew();
        const Session good = short_session("", x);
        ASSERT_TRUE(good.arrived);
        ASSERT_EQ(good.code, 0);
        const std::int64_t count = calls();
        check_positions(good, false, before, x);
        for (const std::int64_t before_last : spread_by_seed(count, trials("MOTIONRACK_SERVED_CALLS", 2, 12)))
            for (const char* fault : {"fail", "tear", "drop"}) {
                const std::int64_t nth = count - before_last;
                const std::string plan = fault + (" " + std::to_string(nth));
                SCOPED_TRACE(plan + " of about " + std::to_string(count) + (first_run ? ", first run" : ""));
                start_anew();
                const Session session = short_session(plan, x);
                const bool lies = fault[0] == 'd';
                check_positions(session, lies, before, x);
                check(session, lies);
            }
    }
}

/// Changes of the users file: each is acknowledged once it is written, and only then in force.
class UsersOfAServedRackOnABadDisk : public ServedRackOnABadDisk {
  protected:
    /// Sends a request that changes the file; returns the answer.
    using Change = std::function<json(Served&)>;

    static json pair(Served& served, const char* name) {
        const std::size_t at = served.said.find("#pair=");
        return served.post("pair", {{"code", served.said.substr(at + 6, 9)}, {"name", name}});
    }
    /// Pairs a user on a good disk; returns the token.
    std::string paired(const char* name) const {
        Served served(with_pairing());
        const json answer = pair(served, name);
        EXPECT_EQ(served.end(SIGTERM), 0);
        EXPECT_TRUE(answer.contains("token")) << answer;
        return answer.contains("token") ? answer["token"].get<std::string>() : "";
    }
    static bool is_token_known(const Served& served, const std::string& token) {
        ServedLink link(served.port());
        link.token = token;
        return !token.empty() && link.get("status").contains("status");
    }
    std::string users_text() const { return text_of(folder / "data/users.json"); }
    /// Names in the users file, each followed by a blank.
    std::string names() const {
        std::string out;
        const json users = json::parse(users_text(), nullptr, false);
        EXPECT_TRUE(users.contains("users")) << users_text();
        for (const json& one : users.value("users", json::array())) out += one["name"].get<std::string>() + " ";
        return out;
    }
    /// Returns the number of disk calls of a session with this change.
    std::int64_t calls_with(const Change& change) const {
        const BadDiskAhead disk(at("data"), "fail 0", "", at("count"));
        Served served(with_pairing());
        change(served);
        EXPECT_EQ(served.end(SIGTERM), 0);
        return calls();
    }
    /// Makes a change on disks whose calls during it fail in turn. Expects the file to have the change if it was
    /// acknowledged, else the change or the old text. `after`: names after the change; `token`: of the changed user,
    /// may be set by `change`; `is_known`: the token is valid after the change.
    void expect_acknowledged_if_written(const Change& change, const std::string& after, const std::string& token,
                                        bool is_known) const {
        const std::string old = users_text();
        const std::int64_t before = calls_with([](Served&) { return json(); }), count = calls_with(change);
        ASSERT_GT(count, before);
        EXPECT_EQ(names(), after);
        const auto tried = static_cast<std::int64_t>(trials("MOTIONRACK_SERVED_CALLS", 3, 20));
        const std::int64_t step = std::max<std::int64_t>(1, (count - before) / tried);
        for (std::int64_t nth = before + 1; nth <= count; nth += step)
            for (const char* fault : {"fail", "tear", "drop"}) {
                const std::string plan = fault + (" " + std::to_string(nth));
                SCOPED_TRACE(plan + " of " + std::to_string(before) + " and " + std::to_string(count));
                write("data/users.json", old);
                const BadDiskAhead disk(at("data"), plan, "", at("count"));
                Served served(with_pairing());
                const json answer = change(served);
                const bool done = is_done(answer) || answer.contains("token");
                EXPECT_NE(done, answer.dump().find("users file") != std::string::npos) << answer;
                EXPECT_TRUE(names() == after || (!done && users_text() == old)) << users_text();
                EXPECT_EQ(is_token_known(served, token), done == is_known);
                EXPECT_EQ(served.end(SIGTERM), 0);
            }
    }
};

TEST_F(UsersOfAServedRackOnABadDisk, AcknowledgesNoPairingThatIsNotWritten) {
    paired("anna");
    std::string token;
    const auto pair_berta = [&](Served& served) {
        const json answer = pair(served, "berta");
        token = answer.contains("token") ? answer["token"].get<std::string>() : "";
        return answer;
    };
    expect_acknowledged_if_written(pair_berta, "anna berta ", token, true);
}

TEST_F(UsersOfAServedRackOnABadDisk, AcknowledgesNoRevocationThatIsNotWritten) {
    const std::string anna = paired("anna"), berta = paired("berta");
    const auto revoke_berta = [&](Served& served) {
        served.token = anna;
        return served.post("revoke_user", {{"user", "berta"}});
    };
    expect_acknowledged_if_written(revoke_berta, "anna ", berta, false);
}

TEST_F(UsersOfAServedRackOnABadDisk, AcknowledgesNoForgottenTokenThatIsNotWritten) {
    paired("anna");
    const std::string berta = paired("berta");
    const auto forget_berta = [&](Served& served) {
        served.token = berta;
        return served.send("POST", "forget", "") ? served.answer() : json();
    };
    expect_acknowledged_if_written(forget_berta, "anna ", berta, false);
}

}  // namespace
}  // namespace motionrack
