// Opens connections as fast as possible while a test sends STOP.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <list>
#include <string>
#include <tests/answer_delay.hpp>
#include <thread>
#include <utility>

namespace motionrack::server {

/// Connects, sends a request or nothing, then closes or stays open, at the maximum rate.
class Flood {
  public:
    enum class Address : std::uint8_t { the_same, another };  ///< 127.0.0.1, as WebClient; 127.0.0.2
    Flood(std::uint16_t port, std::size_t held, Address from, std::string says = "")
        : port_(port), held_(held), from_(from), says_(std::move(says)), thread_([this] { work(); }) {}
    ~Flood() {
        quit_ = true;
        thread_.join();
    }
    Flood(const Flood&) = delete;
    Flood& operator=(const Flood&) = delete;
    std::int64_t count() const { return count_; }

  private:
    void work() {
        std::list<int> open;
        while (!quit_) {
            open.push_back(connect());
            ++count_;
            while (open.size() > held_) {
                ::close(open.front());
                open.pop_front();
            }
        }
        for (const int one : open) ::close(one);
    }
    int connect() const {
        const int out = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
        sockaddr_in from{}, to{};
        from.sin_family = to.sin_family = AF_INET;
        from.sin_addr.s_addr = htonl(INADDR_LOOPBACK + (from_ == Address::another ? 1 : 0));
        to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        to.sin_port = htons(port_);
        const int on = 1;
        ::setsockopt(out, SOL_IP, IP_BIND_ADDRESS_NO_PORT, &on, sizeof on);
        ::bind(out, reinterpret_cast<const sockaddr*>(&from), sizeof from);
        const linger at_once{1, 0};
        ::setsockopt(out, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
        (void)::connect(out, reinterpret_cast<const sockaddr*>(&to), sizeof to);
        if (!says_.empty()) (void)::send(out, says_.data(), says_.size(), MSG_NOSIGNAL);
        return out;
    }
    const std::uint16_t port_;
    const std::size_t held_;
    const Address from_;
    const std::string says_;
    std::atomic<bool> quit_{false};
    std::atomic<std::int64_t> count_{0};
    std::thread thread_;
};

/// Expects at least half of 30 STOPs to be answered in time. `stop` sends a STOP and returns its HTTP status.
template <class Stop>
void expect_stops_heard(const Flood& flood, const std::string& name, const Stop& stop) {
    while (flood.count() < 500) std::this_thread::yield();
    test::AnswerDelays delays;
    for (int i = 0; i < 30; ++i) delays.measure([&] { EXPECT_EQ(stop(), 200) << name << ", STOP " << i; });
    delays.expect_in_time(0.5, name + ", beside " + std::to_string(flood.count()) + " connections", 2);
}

}  // namespace motionrack::server
