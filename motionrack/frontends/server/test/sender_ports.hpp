// Senders at the TCP port and at the pseudo-terminal of an unthrottled machine.
#pragma once

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <future>
#include <memory>
#include <motionrack/frontends/server/grbl_ports.hpp>
#include <motionrack/frontends/server/pseudo_terminal.hpp>
#include <motionrack/rack/config.hpp>
#include <mutex>
#include <optional>
#include <string>
#include <tests/invariants/watch.hpp>
#include <thread>
#include <utility>

namespace motionrack::server {

inline const std::string banner = "\r\nGrbl 1.1h ['$' for help]\r\n";

/// Client end: sends text and reads until an expected text arrives (10 s at most).
class SenderClient {
  public:
    static SenderClient tcp(std::uint16_t port) {
        SenderClient out(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
        sockaddr_in place{};
        place.sin_family = AF_INET;
        place.sin_port = htons(port);
        place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        EXPECT_EQ(::connect(out.file_.number(), reinterpret_cast<const sockaddr*>(&place), sizeof place), 0);
        return out;
    }
    static SenderClient terminal(const std::string& path) {
        return SenderClient(::open(path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC));
    }

    void say(const std::string& text) {
        ASSERT_EQ(::write(file_.number(), text.data(), text.size()), static_cast<ssize_t>(text.size()));
    }
    /// Reads up to and including `end`; keeps the rest.
    std::string receive(const std::string& end) {
        const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(10);
        while (heard_.find(end) == std::string::npos) {
            pollfd ready{file_.number(), POLLIN, 0};
            std::array<char, 4096> in{};
            if (std::chrono::steady_clock::now() > until) return std::exchange(heard_, {}) + "(nothing more)";
            if (::poll(&ready, 1, 1000) <= 0) continue;
            const ssize_t got = ::read(file_.number(), in.data(), in.size());
            if (got <= 0) return std::exchange(heard_, {}) + "(closed)";
            heard_.append(in.data(), static_cast<std::size_t>(got));
        }
        const std::size_t at = heard_.find(end) + end.size();
        std::string out = heard_.substr(0, at);
        heard_.erase(0, at);
        return out;
    }
    std::string ask(const std::string& text, const std::string& end = "ok\r\n") {
        say(text);
        return receive(end);
    }
    /// Queries the status until it contains `state`.
    std::string until(const std::string& state) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
        std::string report;
        while (report.find("<" + state) == std::string::npos && std::chrono::steady_clock::now() < end)
            report = ask("?", ">\r\n");
        return report;
    }
    int file() const { return file_.number(); }

  private:
    explicit SenderClient(int file) : file_(file) { EXPECT_GE(file, 0); }
    OpenFile file_;
    std::string heard_;
};

class SenderPorts : public testing::Test {
  protected:
    void SetUp() override {
        if (OpenFile(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)).number() < 0)
            GTEST_SKIP() << "There are no pseudo-terminals here: /dev/pts is not mounted.";
        const std::string axes =
            "[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\n[axis.Y]\ncard = \"m\"\nchannel = "
            "\"y\"\n";
        machine_ = *operate::Machine::make(*rack::read_rack_text(axes).config, {});
        watch_.emplace(*machine_);
        settings_.port = 0;
        settings_.link = (folder_ / "grbl").string();
        settings_.on_setting = [this](const std::string& sender, const std::string& text) {
            const std::lock_guard lock(reported_mutex_);
            reported_ = sender + ": " + text;
        };
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override {
        if (machine_ == nullptr) return;
        machine_->quit();
        if (thread_.joinable()) thread_.join();
        ports_.reset();
        std::filesystem::remove_all(folder_);
    }
    void start() {
        auto opened = GrblPorts::open(settings_, *machine_, lease_);
        ASSERT_TRUE(opened) << opened.error().message;
        ports_ = std::move(*opened);
        thread_ = std::thread([this] { machine_->run(); });
    }
    /// Last setting changed by a sender; the ports report it on their own thread.
    std::string reported() {
        const std::lock_guard lock(reported_mutex_);
        return reported_;
    }
    operate::MachineState state() {
        std::promise<operate::MachineState> out;
        machine_->post([&] { out.set_value(machine_->state()); });
        return out.get_future().get();
    }
    SenderClient tcp() { return SenderClient::tcp(ports_->port()); }
    SenderClient terminal() { return SenderClient::terminal(settings_.link); }

    const std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() / ("motionrack-ports-" + std::to_string(::getpid()));
    GrblPortSettings settings_;
    auth::ControlLease lease_;
    std::optional<test::MachineWatch> watch_;  ///< checks the invariants of every run until the machine's last slice
    std::unique_ptr<operate::Machine> machine_;
    std::unique_ptr<GrblPorts> ports_;
    std::thread thread_;
    std::mutex reported_mutex_;
    std::string reported_;
};

}  // namespace motionrack::server
