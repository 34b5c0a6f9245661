// However time is cut into calls, the same history: of each card that is driven at random, with its machine.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <motionrack/rack/session.hpp>
#include <random>
#include <string>
#include <tests/environment.hpp>
#include <tests/text_of.hpp>
#include <vector>

namespace motionrack::rack {
namespace {

namespace fs = std::filesystem;
using Random = std::mt19937_64;

std::uint64_t below(Random& random, std::uint64_t end) {
    return random() % end;
}

/// From `least` to `most`, each order of magnitude as often as another.
std::uint64_t spread(Random& random, double least, double most) {
    const double part = static_cast<double>(below(random, 1'000'001)) * 1e-6;
    return static_cast<std::uint64_t>(least * std::pow(most / least, part));
}

/// The same for each of the sessions: one access of the host, or a switch.
struct Order {
    enum Kind { write, read, wire } kind = write;
    std::string on;  ///< a card, or a wire
    int bits = 16;
    std::uint32_t address = 0, value = 0;
    double level = 0;
};

/// A rack with one kind of card, and what a host and the world do to it.
struct Bench {
    const char* name;
    std::string text;
    std::vector<Order> (*orders)(Random&);  ///< one thing that is done, perhaps by several accesses
};

Order bus(const char* card, int bits, std::uint32_t address, std::uint64_t value) {
    return {Order::write, card, bits, address, static_cast<std::uint32_t>(value), 0};
}

Order look(const char* card, int bits, std::uint32_t address) {
    return {Order::read, card, bits, address, 0, 0};
}

Order level(std::string wire, std::uint64_t value) {
    return {Order::wire, std::move(wire), 0, 0, 0, static_cast<double>(value)};
}

// ---- databoard4002

std::vector<Order> positioner(Random& random) {
    std::vector<Order> out;
    const auto send = [&](char letter, std::initializer_list<std::uint64_t> bytes) {
        out.push_back(bus("c1", 8, 3, static_cast<unsigned char>(letter)));
        for (const std::uint64_t one : bytes) out.push_back(bus("c1", 8, 0, one & 0xFF));
    };
    out.push_back(bus("c1", 8, 1, 13));
    switch (below(random, 8)) {
        case 0: {
            const std::uint64_t rate = 16'383 - below(random, 4'000);
            send('R', {rate, rate >> 8});
            break;
        }
        case 1:
        case 2: {
            const std::uint64_t way = below(random, 4'000) - 2'000;
            send('N', {way, way >> 8, way >> 16});
            send('G', {});
            break;
        }
        case 3:
            send("QALMO" [below(random, 5)], {});
            break;
        case 4:
            out.push_back(
                level(std::array{"c1.esl", "c1.esr", "c1.ems", "c1.ref"}[below(random, 4)], below(random, 2)));
            break;
        case 5:
            out.push_back(look("c1", 8, static_cast<std::uint32_t>(below(random, 2))));
            break;
        case 6:
            out.push_back(bus("c1", 8, 5, random() & 0xFF));
            break;
        default:
            out.push_back(bus("c1", 8, static_cast<std::uint32_t>(below(random, 8)), random() & 0xFF));
    }
    return out;
}

// ---- ioflex02

std::vector<Order> counter(Random& random) {
    switch (below(random, 5)) {
        case 0:
            return {look("p1", 16, 0x2300 + 2 * static_cast<std::uint32_t>(below(random, 40)))};
        case 1:
            return {bus("p1", 16, 0x2300 + 2 * static_cast<std::uint32_t>(below(random, 40)), below(random, 16))};
        case 2:  // both lines at once: no step of an encoder
            return {level("p1.a0", below(random, 2)), level("p1.b0", below(random, 2))};
        default:
            return {level(fmt::format("p1.{}{}", std::array{"a", "b", "z", "cal"}[below(random, 4)], below(random, 4)),
                          below(random, 2))};
    }
}

// ---- rtc5

std::vector<Order> scanner(Random& random) {
    if (below(random, 3) == 0) return {look("s", 32, 4 * static_cast<std::uint32_t>(below(random, 16)))};
    return {level(std::array{"s.start_n", "s.mcbsp", "s.stop_n"}[below(random, 3)], below(random, 2))};
}

std::vector<Bench> benches() {
    return {
        {"databoard4002", "[card.c1]\ntype = \"databoard4002\"\nselect = 13\n", positioner},
        {"ioflex02", "card.p1 = \"ioflex02\"", counter},
        {"rtc5",
         "[card.s]\ntype = \"rtc5\"\nlist_memory = 2000\n[belt.line]\ncard = \"s\"\nspeed_mm_s = 100\n"
         "counts_per_mm = 100\n[scanner.head]\ncard = \"s\"\n",
         scanner},
    };
}

void carry_out(Session& session, const Order& order) {
    switch (order.kind) {
        case Order::write:
            static_cast<void>(session.write(order.on, order.bits, order.address, order.value));
            return;
        case Order::read:
            static_cast<void>(session.read(order.on, order.bits, order.address));
            return;
        case Order::wire:
            static_cast<void>(session.set_wire(order.on, order.level));
            return;
    }
}

/// In up to six pieces, some of no length.
void pass_in_pieces(Session& session, std::uint64_t ns, Random& random) {
    std::vector<std::uint64_t> ends{0, ns};
    for (std::uint64_t i = below(random, 6); i-- > 0;) ends.push_back(below(random, ns + 1));
    std::sort(ends.begin(), ends.end());
    for (std::size_t i = 1; i < ends.size(); ++i) ASSERT_TRUE(session.advance(ends[i] - ends[i - 1]));
}

std::vector<std::string> told(Session& session) {
    std::vector<std::string> out;
    for (const sim::Condition& one : session.rack().kernel().conditions())
        out.push_back(
            fmt::format("{} {} {} {} {}", one.at.count(), static_cast<int>(one.device), one.code, one.a, one.b));
    return out;
}

/// Which devices are not in the same state, and from which byte on.
std::string difference(Session& one, Session& other) {
    std::string out;
    sim::Kernel &a = one.rack().kernel(), &b = other.rack().kernel();
    for (std::size_t i = 0; i < a.device_count(); ++i) {
        const auto id = static_cast<sim::DeviceId>(i);
        const std::span<std::byte> left = a.device(id).hashed_state(), right = b.device(id).hashed_state();
        const auto at = std::mismatch(left.begin(), left.end(), right.begin(), right.end()).first;
        if (at != left.end()) out += fmt::format(" {} at byte {};", a.device_name(id), at - left.begin());
    }
    return out.empty() ? " the kernel" : out;
}

struct World {
    World(const Bench& bench, const char* end, bool records)
        : session(std::move(*Session::open(bench.text))),
          path((fs::temp_directory_path() / fmt::format("motionrack_cut_{}_{}.csv", ::getpid(), end)).string()) {
        EXPECT_TRUE(!records || session->start_trace(path, "*"));
    }
    ~World() { fs::remove(path); }
    std::string recorded() { return session->stop_trace() ? text_of(path) : std::string(); }
    std::unique_ptr<Session> session;
    std::string path;
};

void expect_the_same_however_it_is_cut(const Bench& bench, std::uint64_t seed) {
    SCOPED_TRACE(fmt::format("{}, seed {}", bench.name, seed));
    Random random(seed), knife(seed + 1);
    const bool records = seed % 4 == 0;
    World whole(bench, "whole", records), cut(bench, "cut", records);
    for (int step = 0; step < 60; ++step) {
        for (const Order& order : bench.orders(random)) {
            carry_out(*whole.session, order);
            carry_out(*cut.session, order);
        }
        const std::uint64_t ns = spread(random, 50, 3e7);
        ASSERT_TRUE(whole.session->advance(ns));
        pass_in_pieces(*cut.session, ns, knife);
        ASSERT_EQ(told(*whole.session), told(*cut.session)) << "step " << step;
        ASSERT_EQ(whole.session->rack().kernel().trace_hash(), cut.session->rack().kernel().trace_hash())
            << "step " << step;
        ASSERT_EQ(whole.session->state_hash(), cut.session->state_hash())
            << "step " << step << ":" << difference(*whole.session, *cut.session);
    }
    ASSERT_TRUE(!records || whole.recorded() == cut.recorded()) << "the recordings differ";
}

TEST(ACut, ThroughTimeChangesNothing) {
    const std::uint64_t first = seed_from_environment(), count = trials("MOTIONRACK_CUTS", 30, 1000);
    for (const Bench& bench : benches())
        for (std::uint64_t i = 0; i < count && !HasFatalFailure(); ++i)
            expect_the_same_however_it_is_cut(bench, first + i);
}

}  // namespace
}  // namespace motionrack::rack
