// A port that records the traffic and answers from a script.
#pragma once

#include <fmt/format.h>

#include <map>
#include <motionrack/base/port.hpp>
#include <motionrack/cards/ioflex02/map.hpp>
#include <string>
#include <vector>

namespace motionrack::ioflex02 {

class ScriptedPort final : public RegisterPort, public Interrupt {
  public:
    void write(std::uint32_t address, std::uint16_t value) override {
        traffic.push_back(fmt::format("W {}={:X}", name(address - base, true), value));
        if (address - base == offset("CONTROL") && value == 1) words[offset("STATUS")] = 1;
        if (address - base == offset("CONTROL") && value == 2) words[offset("STATUS")] = 4;
    }
    std::uint16_t read(std::uint32_t address) override {
        traffic.push_back("R " + name(address - base, false));
        return words.count(address - base) ? words[address - base] : std::uint16_t{0};
    }
    bool wait(Duration timeout) override { return pass(timeout), false; }
    void pass(Duration duration) override { time += duration; }
    Instant now() const override { return time; }
    bool stop_requested() const override { return stop; }

    static std::string name(std::uint32_t at, bool write) {
        for (const RegisterInfo& reg : map::registers)
            if (reg.offset == at && (reg.access == Access::write) == write) return std::string(reg.name);
        return fmt::format("{:X}h", at);
    }
    /// A card that is present and in order.
    void good_card() {
        words[offset("SIGNATURE")] = signature;
        words[offset("SERIAL")] = 0x1234;
        words[offset("SERIAL_N")] = 0xEDCB;
        words[offset("IDENT")] = 0x25;
    }

    std::uint32_t base = 0x2300;
    std::map<std::uint32_t, std::uint16_t> words;
    std::vector<std::string> traffic;
    Instant time{};
    bool stop = false;
};

}  // namespace motionrack::ioflex02
