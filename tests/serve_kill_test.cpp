// What is left of a run that was killed: nothing that was acknowledged is lost, and the next run knows what ran, where,
// and that no position is to be trusted.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <csignal>
#include <motionrack/journal/journal.hpp>
#include <nlohmann/json.hpp>
#include <random>
#include <tests/environment.hpp>
#include <tests/ran.hpp>

namespace motionrack {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// `motionrack serve`, until it is killed.
class Served {
  public:
    explicit Served(const std::vector<std::string>& arguments) {
        int ends[2];
        if (::pipe(ends) != 0) return;
        child_ = ::fork();
        if (child_ == 0) {
            ::dup2(ends[1], 1);
            ::dup2(ends[1], 2);
            ::close(ends[0]);
            ::close(ends[1]);
            std::vector<char*> words{const_cast<char*>(MOTIONRACK_PROGRAM), const_cast<char*>("serve")};
            for (const std::string& one : arguments) words.push_back(const_cast<char*>(one.c_str()));
            words.push_back(nullptr);
            ::execv(MOTIONRACK_PROGRAM, words.data());
            ::_exit(127);
        }
        ::close(ends[1]);
        output_ = ends[0];
        read_until("Ctrl-C");
        const std::size_t at = said.find("http://127.0.0.1:");
        if (at != std::string::npos) port_ = std::stoi(said.substr(at + 17));
        connect();
    }
    ~Served() { end(SIGKILL); }
    Served(const Served&) = delete;
    Served& operator=(const Served&) = delete;

    /// The exit code, or minus the signal.
    int end(int signal) {
        if (child_ <= 0) return 0;
        ::kill(child_, signal);
        int status = 0;
        ::waitpid(child_, &status, 0);
        child_ = 0;
        ::close(socket_);
        ::close(output_);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }
    bool send(const std::string& method, const std::string& name, const std::string& body) const {
        const std::string text =
            method + " /api/" + name + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port_) +
            "\r\nContent-Type: application/json\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
        return ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(text.size());
    }
    /// The body of the next answer; discarded if the server is gone.
    json answer() {
        std::string text;
        for (char c; text.size() < 4 || text.compare(text.size() - 4, 4, "\r\n\r\n") != 0; text += c)
            if (::recv(socket_, &c, 1, 0) != 1) return json(json::value_t::discarded);
        const std::size_t at = text.find("Content-Length: ");
        std::string body(at == std::string::npos ? 0 : std::stoul(text.substr(at + 16)), '\0');
        if (::recv(socket_, body.data(), body.size(), MSG_WAITALL) != static_cast<ssize_t>(body.size()))
            return json(json::value_t::discarded);
        return json::parse(body, nullptr, false);
    }
    json post(const std::string& name, const json& fields = json::object()) {
        return send("POST", name, fields.dump()) ? answer() : json(json::value_t::discarded);
    }
    json status() {
        const json all = send("GET", "status", "") ? answer() : json(json::value_t::discarded);
        return all.is_object() ? all.value("status", json()) : json();
    }

    std::string said;

  private:
    void read_until(const std::string& word) {
        for (char c; said.find(word) == std::string::npos && ::read(output_, &c, 1) == 1;) said += c;
    }
    void connect() {
        socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(port_));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        EXPECT_EQ(::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0) << said;
    }

    pid_t child_ = 0;
    int output_ = -1, socket_ = -1, port_ = 0;
};

class AServedRack : public InFolder {
  protected:
    void SetUp() override {
        InFolder::SetUp();
        write("table.toml",
              "[rack]\nname = \"table\"\n[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\nmax_mm "
              "= 1000\n");
    }
    std::vector<std::string> arguments() const {
        return {(folder / "table.toml").string(), "--port", "0", "--no-pairing", "--journal", journal(), "--users",
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
    /// Enabled, with control, and trusted.
    static void make_ready(Served& served) {
        EXPECT_TRUE(served.post("take_control").contains("done"));
        EXPECT_TRUE(served.post("enable", {{"on", true}}).contains("done"));
        EXPECT_TRUE(served.post("declare_position", {{"axis", "X"}, {"position", 0}}).contains("done"));
    }
};

constexpr const char* long_way = "G1 X500 F3000\nX0\nX500\nX0\nM30\n";

TEST_F(AServedRack, LosesNothingAcknowledgedInAHundredKills) {
    const auto seed = static_cast<std::uint32_t>(seed_from_environment());
    SCOPED_TRACE("MOTIONRACK_SEED=" + std::to_string(seed));
    std::mt19937 random(seed);
    const auto among = [&](int least, int greatest) {
        return std::uniform_int_distribution<int>(least, greatest)(random);
    };
    std::vector<std::string> acknowledged;
    std::string ran;
    for (int kill = 0; kill < 100; ++kill) {
        Served served(arguments());
        if (kill > 0) {
            EXPECT_THAT(served.said, HasSubstr("was cut off"));
            if (!ran.empty()) {
                EXPECT_THAT(served.said, HasSubstr(ran));
            }
            const json status = served.status();
            ASSERT_TRUE(status.contains("axes")) << status.dump();
            EXPECT_FALSE(status["axes"][0]["trusted"]);
            ASSERT_EQ(status["alarms"].size(), 1u);
        }
        make_ready(served);
        const std::string name = "kill_" + std::to_string(kill) + ".ngc";
        ran.clear();
        if (served.post("begin", {{"name", name}, {"text", long_way}}).contains("done"))
            acknowledged.push_back(ran = name);
        for (int order = among(0, 12); order > 0; --order) {
            const double feed = 0.5 + 0.00001 * static_cast<double>(acknowledged.size());
            if (served.post("set_overrides", {{"feed", feed}}).contains("done"))
                acknowledged.push_back(json(feed).dump());
        }
        // Half of the kills come while an order is on its way.
        if (among(0, 1) == 1) (void)served.send("POST", "set_overrides", json{{"feed", 1.5}}.dump());
        ASSERT_EQ(served.end(SIGKILL), -SIGKILL);
    }
    EXPECT_GT(acknowledged.size(), 300u);
    const std::vector<std::string> orders = entries("order");
    std::size_t at = 0;
    for (const std::string& one : acknowledged) {
        while (at < orders.size() && orders[at].find(one) == std::string::npos) ++at;
        ASSERT_LT(at, orders.size()) << one << " was acknowledged and is not in the journal, or not in its place";
    }
}

TEST_F(AServedRack, KilledWhileItStoodKnowsIt) {
    {
        Served served(arguments());
        make_ready(served);
        EXPECT_EQ(served.end(SIGKILL), -SIGKILL);
    }
    {
        Served served(arguments());
        EXPECT_THAT(served.said, HasSubstr("was cut off"));
        const json status = served.status();
        EXPECT_FALSE(status["axes"][0]["trusted"]) << "anything could have moved it since";
    }
    EXPECT_EQ(entries("order").size(), 3u);
}

TEST_F(AServedRack, StandsWhereItStoodAfterAnEndThatWasAskedFor) {
    {
        Served served(arguments());
        make_ready(served);
        EXPECT_TRUE(served.post("begin", {{"name", "there.ngc"}, {"text", "G1 X12.5 F6000\nM30\n"}}).contains("done"));
        while (served.status()["axes"][0]["commanded"] != 12.5) continue;
        EXPECT_EQ(served.end(SIGTERM), 0);
    }
    Served served(arguments());
    EXPECT_THAT(served.said, testing::Not(HasSubstr("cut off")));
    const json status = served.status();
    EXPECT_EQ(status["axes"][0]["commanded"], 12.5);
    EXPECT_TRUE(status["axes"][0]["trusted"]);
    EXPECT_TRUE(status["alarms"].empty());
}

TEST_F(AServedRack, StopsAMoveBeforeItEnds) {
    Served served(arguments());
    make_ready(served);
    EXPECT_TRUE(served.post("begin", {{"name", "long.ngc"}, {"text", long_way}}).contains("done"));
    while (served.status()["axes"][0]["commanded"].get<double>() < 5) continue;
    EXPECT_EQ(served.end(SIGINT), 0);
    const std::vector<std::string> jobs = entries("job");
    ASSERT_EQ(jobs.size(), 2u);
    EXPECT_THAT(jobs[1], HasSubstr("long.ngc was stopped at line 1 of 5"));
}

}  // namespace
}  // namespace motionrack
