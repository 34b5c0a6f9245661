// A card on a bus with an 8-bit host, as in the maker's demonstration programs.
#pragma once

#include <cstdint>
#include <motionrack/cards/databoard4002/map.hpp>
#include <motionrack/cards/databoard4002/model/bus.hpp>
#include <motionrack/sim/virtual_port.hpp>
#include <string>
#include <vector>

namespace motionrack::databoard4002 {

inline constexpr std::uint8_t select = 13;

/// The demonstration program's slope tables: 24 pairs of speed and position (in units of 256 counts) for each half.
inline constexpr int demo_deceleration[24][2] = {
    {14000, 1},   {14500, 6},   {15002, 8},   {15216, 15},  {15678, 30},  {16016, 35},  {16144, 40},  {16262, 45},
    {16278, 50},  {16288, 60},  {16298, 70},  {16304, 85},  {16312, 100}, {16317, 115}, {16322, 130}, {16326, 145},
    {16330, 160}, {16332, 180}, {16334, 200}, {16336, 225}, {16338, 250}, {16340, 285}, {16342, 320}, {16344, 370}};
inline constexpr int demo_acceleration[24][2] = {
    {14000, 1},   {14500, 12},  {15402, 16},  {15682, 22},  {15778, 30},  {15900, 35},  {16000, 40},  {16262, 50},
    {16284, 60},  {16292, 70},  {16298, 80},  {16304, 105}, {16312, 130}, {16316, 150}, {16322, 180}, {16326, 215},
    {16330, 250}, {16332, 290}, {16334, 330}, {16336, 365}, {16338, 400}, {16340, 450}, {16342, 500}, {16344, 600}};

struct Host {
    explicit Host(const Settings& settings = {}, bool own_plant = true, sim::PositionFunction* encoder = nullptr,
                  sim::Kernel* shared = nullptr)
        : kernel(shared ? *shared : own_kernel),
          card(kernel, "c1", settings),
          bus(kernel, "c1"),
          port(kernel, bus, bus.id(), bus.interrupt_wire(), Duration{0}) {
        if (encoder)
            card.connect_encoder(*encoder);
        else if (own_plant)
            card.connect_encoder(card.pulses());
        bus.plug(card, select);
    }
    /// Ends the construction: no more cards and parts.
    void start() {
        kernel.start();
        port.out(ports::CS, select);
    }

    bool wait_ready(Duration timeout = milliseconds(127)) {
        const Instant until = kernel.now() + timeout;
        while (!(port.in(ports::STAT)&stat::READY)) {
            if (kernel.now() >= until) return false;
            port.pass(microseconds(10));
        }
        return true;
    }
    void out(std::uint8_t to, int value) {
        wait_ready();
        port.out(to, static_cast<std::uint8_t>(value));
    }
    std::uint8_t in(std::uint8_t from) {
        wait_ready();
        return port.in(from);
    }
    void number(std::int64_t value, int bytes) {
        for (int i = 0; i < bytes; ++i) out(ports::DATA, static_cast<int>(value >> (8 * i) & 0xFF));
    }
    void command(char code) { out(ports::C2, code); }
    void command(char code, std::int64_t value, int bytes) {
        command(code);
        number(value, bytes);
    }
    std::int64_t ask(char code, int bytes) {
        command(code);
        std::int64_t value = 0;
        for (int i = 0; i < bytes; ++i) value |= std::int64_t{in(ports::DATA)} << (8 * i);
        const int unused = 64 - 8 * bytes;
        return static_cast<std::int64_t>(static_cast<std::uint64_t>(value) << unused) >> unused;
    }
    std::uint8_t status() { return port.in(ports::STAT); }
    /// Reads the EVENT word, which frees it.
    std::uint8_t events(int enables) {
        out(ports::C4, enables);
        return in(ports::DATA);
    }
    bool wait_event(Duration timeout) {
        const Instant until = kernel.now() + timeout;
        while (!(status() & stat::EVENT)) {
            if (kernel.now() >= until) return false;
            port.pass(microseconds(100));
        }
        return true;
    }
    void demo_table(int stretch) {
        command('S');
        for (const auto* half : {&demo_deceleration, &demo_acceleration})
            for (const auto& row : *half) {
                number(row[0], 2);
                number(256 * row[1] * stretch, 3);
            }
        command('O');
    }
    void run(Duration time) { port.pass(time); }
    void set(const char* pin, int level) {
        kernel.set_wire(kernel.find_wire("c1." + std::string(pin)), level);
        kernel.settle();
    }
    int level(const char* pin) { return kernel.level(kernel.find_wire("c1." + std::string(pin))); }
    std::vector<CardCondition> conditions() {
        std::vector<CardCondition> out;
        for (const sim::Condition& c : kernel.conditions())
            if (c.device == card.id()) out.push_back(static_cast<CardCondition>(c.code));
        return out;
    }

    sim::Kernel own_kernel;
    sim::Kernel& kernel;
    Card card;
    Bus bus;
    sim::VirtualBytePort port;
};

}  // namespace motionrack::databoard4002
