// Any byte to any port at any time: the card never hangs, never moves without G, and its values stay in their ranges.
//
// MOTIONRACK_SEED and MOTIONRACK_ACCESSES in the environment choose another and a longer run.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <motionrack/cards/databoard4002/test/host.hpp>
#include <random>

namespace motionrack::databoard4002 {
namespace {

std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
    const char* text = std::getenv(name);
    return text && *text ? std::strtoull(text, nullptr, 0) : otherwise;
}

struct Fuzz {
    explicit Fuzz(std::uint64_t seed) : random(seed) {
        host.start();
        host.kernel.want(host.kernel.find_wire("c1.fout"), host.card.id(), false);
    }
    std::uint64_t below(std::uint64_t n) { return random() % n; }

    std::uint8_t byte() {
        constexpr char letters[] = "ADGILMNOPQRSVWGGGP";
        return static_cast<std::uint8_t>(below(3) ? letters[below(sizeof letters - 1)] : below(256));
    }

    void access() {
        if (below(4) == 0) host.run(Duration{static_cast<std::int64_t>(below(5'000'000))});
        const auto port = static_cast<std::uint8_t>(below(10) ? below(8) : below(256));
        if (port == ports::CS && below(20)) return;  // mostly the card stays chosen
        if (below(3) == 0) {
            if (port == ports::RST && below(50)) return;
            host.port.in(port);
            return note_reset(port == ports::RST);
        }
        if (port == ports::C3 && below(50)) return;
        const std::uint8_t value = byte();
        // The firmware may see this G; what it sees as G is what is written to C2 while it is Ready.
        if (port == ports::C2 && value == 'G' && (host.card.peek(ports::STAT) & stat::READY)) went = true;
        host.port.out(port, value);
        if (port == ports::CS) {
            host.port.out(ports::CS, select);
        } else {
            note_reset(port == ports::C3);
        }
    }
    void note_reset(bool is) {
        if (!is) return;
        went = false;
        EXPECT_EQ(host.level("vout"), 0);
        EXPECT_EQ(host.level("relay"), 0);
        EXPECT_TRUE(host.status() & stat::READY);
    }
    void disturb() {
        constexpr const char* pins[] = {"zero", "ref", "ems", "esr", "esl"};
        const char* pin = pins[below(5)];
        host.set(pin, below(3) == 0);
        if (below(300) == 0) host.card.fault("watchdog.hang", 1, host.kernel.now());
    }
    void look() {
        const int volts = host.level("vout");
        ASSERT_LE(std::abs(volts), 10'000'000);
        if (host.level("ems")) {
            ASSERT_EQ(volts, 0);
        }
        if (host.level("esr")) {
            ASSERT_LE(volts, 0);
        }
        if (host.level("esl")) {
            ASSERT_GE(volts, 0);
        }
        if (!went) {
            ASSERT_FALSE(host.card.moving());
            ASSERT_EQ(volts, 0);
        }
        if (!host.card.hung() && below(50) == 0) {
            host.run(microseconds(105));
            ASSERT_TRUE(host.status() & stat::READY);
        }
    }

    Host host;
    std::mt19937_64 random;
    bool went = false;
};

TEST(Databoard4002Fuzz, AnyAccessAtAnyTimeLeavesTheCardAlive) {
    const std::uint64_t seed = from_environment("MOTIONRACK_SEED", 1), count = from_environment("MOTIONRACK_ACCESSES", 1'000'000);
    std::cout << "MOTIONRACK_SEED=" << seed << ", " << count << " accesses" << std::endl;
    Fuzz fuzz(seed);
    for (std::uint64_t i = 0; i < count; ++i) {
        fuzz.access();
        if (fuzz.below(20) == 0) fuzz.disturb();
        fuzz.look();
        if (HasFatalFailure()) FAIL() << "after access " << i;
    }
    // Whatever has been: the watchdog is over after a second, and the card takes orders.
    Host& host = fuzz.host;
    host.run(milliseconds(1'010));
    for (const char* pin : {"zero", "ref", "ems", "esr", "esl"}) host.set(pin, 0);
    host.port.out(ports::C3, 0);
    host.command('R', 16'344, 2);
    host.command('N', 100, 3);
    host.command('G');
    host.run(milliseconds(20));
    EXPECT_EQ(host.card.position(), 100);
    std::cout << to_seconds(host.kernel.now()) << " s, " << host.kernel.dropped_conditions() << " conditions" << std::endl;
}

}  // namespace
}  // namespace motionrack::databoard4002
