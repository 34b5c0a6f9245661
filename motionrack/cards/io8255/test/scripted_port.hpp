// A port that records the traffic and answers from a script.
#pragma once

#include <fmt/format.h>

#include <deque>
#include <motionrack/base/port.hpp>
#include <motionrack/cards/io8255/map.hpp>
#include <string>
#include <vector>

namespace motionrack::io8255 {

class ScriptedPort final : public BytePort, public Interrupt {
  public:
    void out(std::uint8_t port, std::uint8_t value) override {
        traffic.push_back(fmt::format("W {}={:02X}", port, value));
    }
    /// The next answer of the script; after the last one 0.
    std::uint8_t in(std::uint8_t port) override {
        traffic.push_back(fmt::format("R {}", port));
        if (answers.empty()) return 0;
        const std::uint8_t out = answers.front();
        answers.pop_front();
        return out;
    }
    bool wait(Duration timeout) override { return pass(timeout), false; }
    void pass(Duration duration) override { time += duration; }
    Instant now() const override { return time; }
    bool stop_requested() const override { return stop; }

    std::deque<std::uint8_t> answers;
    std::vector<std::string> traffic;
    Instant time{};
    bool stop = false;
};

}  // namespace motionrack::io8255
