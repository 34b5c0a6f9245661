// Measures the time in which a stop is answered, also under a flood of requests, and compares it with a reference: a
// connection to a thread that only answers. A busy computer delays both; requests queued before a STOP delay it alone.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace motionrack::test {

/// Answers each connection to its loopback port with a byte, and does nothing else.
class ReferenceServer {
  public:
    ReferenceServer() : listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
        address_.sin_family = AF_INET;
        address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address_;
        EXPECT_EQ(::bind(listener_, reinterpret_cast<const sockaddr*>(&address_), size), 0);
        EXPECT_EQ(::listen(listener_, 16), 0);
        EXPECT_EQ(::getsockname(listener_, reinterpret_cast<sockaddr*>(&address_), &size), 0);
        thread_ = std::thread([this] { serve(); });
    }
    ~ReferenceServer() {
        ::shutdown(listener_, SHUT_RDWR);
        thread_.join();
        ::close(listener_);
    }
    ReferenceServer(const ReferenceServer&) = delete;
    ReferenceServer& operator=(const ReferenceServer&) = delete;

    /// Connects, sends a request and waits for the answer.
    void ask() const {
        const int client = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
        std::array<char, 64> bytes = {};
        EXPECT_EQ(::connect(client, reinterpret_cast<const sockaddr*>(&address_), sizeof address_), 0);
        EXPECT_EQ(::send(client, bytes.data(), bytes.size(), MSG_NOSIGNAL), static_cast<ssize_t>(bytes.size()));
        EXPECT_EQ(::recv(client, bytes.data(), 1, 0), 1);
        ::close(client);
    }

  private:
    void serve() const {
        for (int client = 0; (client = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC)) >= 0; ::close(client)) {
            std::array<char, 64> bytes = {};
            if (::recv(client, bytes.data(), bytes.size(), MSG_WAITALL) > 0)
                (void)::send(client, bytes.data(), 1, MSG_NOSIGNAL);
        }
    }
    const int listener_;
    sockaddr_in address_ = {};
    std::thread thread_;
};

/// Seconds for which the threads of a process have run and have waited for a processor, as the kernel counts them.
struct ProcessorTime {
    double ran = 0, waited = 0;  ///< s

    static ProcessorTime of(pid_t process) {
        ProcessorTime out;
        std::error_code none;
        for (const auto& task :
             std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/task", none)) {
            double ran = 0, waited = 0;  // ns
            if (std::ifstream(task.path() / "schedstat") >> ran >> waited)
                out.ran += ran / 1e9, out.waited += waited / 1e9;
        }
        return out;
    }
};

class AnswerDelays {
  public:
    using Milliseconds = std::chrono::duration<double, std::milli>;
    static constexpr Milliseconds promised{50};
    /// `server`: the process that answers, if it is not this one. If its threads get only a part of the processor time
    /// that they need, the 50 ms are divided by that part (at least a quarter).
    explicit AnswerDelays(pid_t server = 0) : server_(server) {}
    /// Number of steps of several threads in a stop; the computer may delay each by the time of the whole reference.
    static constexpr double steps = 20;

    /// Measures `stop`, and the reference right afterwards.
    template <class Stop>
    void measure(const Stop& stop) {
        const std::clock_t cpu_before = std::clock();
        const ProcessorTime before = server_ == 0 ? ProcessorTime{} : ProcessorTime::of(server_);
        stops_.push_back(time_of(stop));
        if (server_ != 0) {
            const ProcessorTime now = ProcessorTime::of(server_);
            used_.ran += now.ran - before.ran, used_.waited += now.waited - before.waited;
        }
        cpu_ += static_cast<double>(std::clock() - cpu_before) / CLOCKS_PER_SEC;
        wall_ += std::chrono::duration<double>(stops_.back()).count();
        references_.push_back(time_of([this] { reference_.ask(); }));
    }
    std::size_t count() const { return stops_.size(); }

    /// Expects this part of the stops to be answered within 50 ms, or within `steps` times the reference if longer.
    /// `busy_threads`: threads of this program that always have work, such as a flood and the server of its
    /// connections. If they get only a part of a processor each, the 50 ms are divided by it (at least a quarter).
    void expect_in_time(double part, const std::string& name, int busy_threads = 0) const {
        const Milliseconds stop = within(stops_, part), reference = within(references_, part);
        const double wanted = server_ == 0 ? wall_ * busy_threads : used_.ran + used_.waited,
                     had = server_ == 0 ? cpu_ : used_.ran, got = wanted > 0 ? std::clamp(had / wanted, 0.25, 1.0) : 1;
        std::printf(
            "%s: %.0f %% of %zu stops were answered within %.1f ms, all within %.1f ms; the reference: %.1f ms; %.2f "
            "of a processor a thread\n",
            name.c_str(), 100 * part, stops_.size(), stop.count(), within(stops_, 1).count(), reference.count(), got);
        EXPECT_LE(stop.count(), std::max(promised / got, steps * reference).count())
            << name << ": ms within which " << 100 * part << " % of the stops were answered; the reference took "
            << reference.count();
    }

  private:
    template <class Work>
    static Milliseconds time_of(const Work& work) {
        const auto begun = std::chrono::steady_clock::now();
        work();
        return std::chrono::steady_clock::now() - begun;
    }
    static Milliseconds within(std::vector<Milliseconds> all, double part) {
        std::sort(all.begin(), all.end());
        return all.empty() ? Milliseconds{0}
                           : all[static_cast<std::size_t>(part * static_cast<double>(all.size() - 1))];
    }
    ReferenceServer reference_;
    const pid_t server_;
    ProcessorTime used_;
    double cpu_ = 0, wall_ = 0;  ///< s: processor time of this program, and duration of the stops
    std::vector<Milliseconds> stops_, references_;
};

}  // namespace motionrack::test
