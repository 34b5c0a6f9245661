// A sweep over several processes with a real nats-server: the same table as on one machine, although a worker is
// killed.
#include <fcntl.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "ran.hpp"

namespace motionrack {
namespace {

using testing::HasSubstr;

/// A program in the background, until it ends or is killed.
class Process {
  public:
    Process(const std::filesystem::path& folder, const std::string& command, const std::string& said) {
        child_ = ::fork();
        if (child_ != 0) return;
        const int file = ::open((folder / said).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
        ::dup2(file, 1);
        ::dup2(file, 2);
        if (::chdir(folder.c_str()) == 0) ::execl("/bin/sh", "sh", "-c", ("exec " + command).c_str(), nullptr);
        ::_exit(127);
    }
    ~Process() { end(SIGKILL); }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    bool runs() {
        if (child_ > 0 && ::waitpid(child_, &status_, WNOHANG) != 0) child_ = 0;
        return child_ > 0;
    }
    /// Returns the exit code, or minus the signal.
    int wait() {
        if (child_ > 0) ::waitpid(std::exchange(child_, 0), &status_, 0);
        return WIFEXITED(status_) ? WEXITSTATUS(status_) : -WTERMSIG(status_);
    }
    void signal(int number) const {
        if (child_ > 0) ::kill(child_, number);
    }
    int end(int number) {
        signal(number);
        return wait();
    }

  private:
    pid_t child_ = 0;
    int status_ = 0;
};

class NatsSweep : public InFolder {
  protected:
    void SetUp() override {
        InFolder::SetUp();
        // Path of the Debian package, which is not in every user's PATH.
        ::setenv("PATH", (std::string(std::getenv("PATH")) + ":/usr/sbin").c_str(), 1);
        if (shell("command -v nats-server").code != 0) GTEST_SKIP() << "nats-server is not installed";
        start_server("-1");
        write("part.ngc",
              "G21 G90 G64 P{TOLERANCE}\nG1 X40 Y20 F3000\nX80 Y0\nX120 Y40\nG0 X0 Y0\nG1 X40 Y20 F3000\nX80 Y0\nX120 "
              "Y40\nG0 X0 Y0\n");
        write(
            "sweep.toml",
            "[sweep]\nprogram = \"part.ngc\"\n[vary]\naxis.X.max_accel_mm_s2 = { from = 500, to = 4000, steps = 12 }\n"
            "text.TOLERANCE = [0.01, 0.05, 0.1, 0.2]\nfault = [\"\", \"X.limit_plus=0@500ms\"]\n");
    }
    void TearDown() override {
        server_.reset();
        InFolder::TearDown();
    }
    /// `port`: -1 selects a free one, which the server writes to a file.
    void start_server(const std::string& port) {
        server_ = std::make_unique<Process>(
            folder, "nats-server -js -sd store -a 127.0.0.1 -p " + port + " --ports_file_dir .", "server.txt");
        while (server_->runs() && text_of(folder / "server.txt").find("Server is ready") == std::string::npos) {
        }
        ASSERT_TRUE(server_->runs()) << text_of(folder / "server.txt");
        if (port != "-1") return;
        while (url_.empty() && server_->runs())
            for (const auto& entry : std::filesystem::directory_iterator(folder))
                if (entry.path().extension() == ".ports")
                    if (const auto json = nlohmann::json::parse(text_of(entry.path()), nullptr, false);
                        json.is_object() && json.contains("nats"))
                        url_ = json["nats"][0];
    }
    std::string port() const { return url_.substr(url_.rfind(':') + 1); }
    std::unique_ptr<Process> worker(const std::string& name, const std::string& more = "") const {
        return std::make_unique<Process>(
            folder, MOTIONRACK_PROGRAM " sweep-worker --nats " + url_ + " --jobs 1 " + more, name + ".txt");
    }
    std::unique_ptr<Process> gatherer(const std::string& more = "") const {
        return std::make_unique<Process>(
            folder, MOTIONRACK_PROGRAM " sweep sweep.toml -o out.csv --nats " + url_ + " " + more, "gatherer.txt");
    }
    std::size_t rows() const {
        const std::string text = text_of(folder / "out.csv.part");
        const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
        return lines == 0 ? 0 : lines - 1;
    }
    std::string local_table() const {
        const Ran ran = motionrack("sweep sweep.toml -o local.csv");
        EXPECT_EQ(ran.code, 0) << ran.out;
        return text_of(folder / "local.csv");
    }
    std::string said(const std::string& name) const { return text_of(folder / (name + ".txt")); }

    std::unique_ptr<Process> server_;
    std::string url_;
};

TEST_F(NatsSweep, IsTheSameTableThoughAWorkerIsKilledInTheMiddle) {
    // Points that take long, so that a worker is killed in the middle of one.
    write("part.ngc",
          "G21 G90 G64 P{TOLERANCE}\no100 repeat [40]\nG1 X40 Y20 F3000\nX80 Y0\nX120 Y40\nG0 X0 Y0\no100 endrepeat\n");
    write("sweep.toml",
          "[sweep]\nprogram = \"part.ngc\"\n[vary]\naxis.X.max_accel_mm_s2 = { from = 500, to = 4000, steps = 5 "
          "}\ntext.TOLERANCE = [0.01, 0.1]\n");
    auto gather = gatherer();
    auto one = worker("one"), two = worker("two"), three = worker("three");
    while (gather->runs() && rows() < 3) {
    }
    EXPECT_EQ(two->end(SIGKILL), -SIGKILL) << said("two");
    EXPECT_EQ(gather->wait(), 0) << said("gatherer");
    EXPECT_THAT(said("gatherer"), HasSubstr("10 points: "));
    EXPECT_EQ(text_of(folder / "out.csv"), local_table());
    // On request a worker returns its points.
    EXPECT_EQ(one->end(SIGINT), 130) << said("one");
    EXPECT_EQ(three->end(SIGTERM), 130) << said("three");
    EXPECT_THAT(said("one"), HasSubstr(" points done"));
}

TEST_F(NatsSweep, AStoppedWorkerIsReplacedAndItsLateRowChangesNothing) {
    auto gather = gatherer();
    auto one = worker("one"), two = worker("two");
    while (gather->runs() && rows() < 10) {
    }
    two->signal(SIGSTOP);
    EXPECT_EQ(gather->wait(), 0) << said("gatherer");
    const std::string whole = local_table();
    EXPECT_EQ(text_of(folder / "out.csv"), whole);
    two->signal(SIGCONT);
    EXPECT_EQ(motionrack("sweep sweep.toml -o out.csv --restart --nats " + url_).code, 0);
    EXPECT_EQ(text_of(folder / "out.csv"), whole);
    EXPECT_EQ(two->end(SIGINT), 130) << said("two");
}

TEST_F(NatsSweep, CoordinatorAndServerMayBeKilled) {
    auto gather = gatherer();
    auto one = worker("one"), two = worker("two");
    while (gather->runs() && rows() < 10) {
    }
    EXPECT_EQ(gather->end(SIGKILL), -SIGKILL) << said("gatherer");
    server_->end(SIGKILL);
    start_server(port());
    gather = gatherer();
    EXPECT_EQ(gather->wait(), 0) << said("gatherer");
    EXPECT_THAT(said("gatherer"), HasSubstr("of 96 points were finished before"));
    EXPECT_EQ(text_of(folder / "out.csv"), local_table());
}

TEST_F(NatsSweep, AcceptsRowsThatCameWithoutACoordinator) {
    auto gather = gatherer();
    auto one = worker("one");
    while (gather->runs() && rows() < 3) {
    }
    EXPECT_EQ(gather->end(SIGINT), 130);
    EXPECT_THAT(said("gatherer"), HasSubstr("the same command continues"));
    one.reset();
    // Without a coordinator the worker ends when the queue is empty.
    auto two = worker("two", "--idle 8");
    EXPECT_EQ(two->wait(), 0) << said("two");
    EXPECT_EQ(motionrack("sweep sweep.toml -o out.csv --nats " + url_).code, 0);
    EXPECT_EQ(text_of(folder / "out.csv"), local_table());
}

TEST_F(NatsSweep, RunsAllPointsAgainWithFresh) {
    auto one = worker("one");
    EXPECT_EQ(motionrack("sweep sweep.toml -o out.csv --nats " + url_).code, 0);
    const std::string whole = text_of(folder / "out.csv");
    const Ran again = motionrack("sweep sweep.toml -o out.csv --restart --nats " + url_);
    EXPECT_EQ(again.code, 0) << again.out;
    EXPECT_EQ(text_of(folder / "out.csv"), whole);
    EXPECT_EQ(one->end(SIGINT), 130);
    EXPECT_THAT(said("one"), HasSubstr("192 points done"));
}

TEST_F(NatsSweep, ReportsAMissingServer) {
    const Ran ran = motionrack("sweep sweep.toml -o out.csv --nats nats://user:secret@127.0.0.1:1");
    EXPECT_EQ(ran.code, 5);
    EXPECT_THAT(ran.out, HasSubstr("nats://127.0.0.1:1"));
    EXPECT_THAT(ran.out, testing::Not(HasSubstr("secret")));
    EXPECT_EQ(motionrack("sweep-worker --nats nats://127.0.0.1:1").code, 5);
}

}  // namespace
}  // namespace motionrack
