// The event trace does not depend on how time is divided into calls: stories of random racks, and the comparison of two
// racks.
//
//   seed ──► story: commands and time steps ───┬──► rack that passes each step's time in one call ──┐ hash, conditions,
//                                              └──► in pieces, read and copied in between ─────────┴ recordings: equal
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <motionrack/rack/test/drawn.hpp>
#include <string>
#include <string_view>
#include <tests/environment.hpp>
#include <utility>
#include <vector>

namespace motionrack::rack::cut {

inline std::uint64_t below(Random& random, std::uint64_t end) {
    return random() % end;
}

/// Draws from `min` to `max`, each order of magnitude with the same probability.
inline std::uint64_t spread(Random& random, double min, double max) {
    const double part = static_cast<double>(below(random, 1'000'001)) * 1e-6;
    return static_cast<std::uint64_t>(min * std::pow(max / min, part));
}

/// One event that both compared racks receive: a host access, the level of a wire, or a fault.
struct Order {
    enum Kind { write, read, wire, fault } kind = write;
    std::string on;         ///< a card, a wire, or the target of a fault
    std::string what = {};  ///< the fault
    int bits = 16;
    std::uint32_t address = 0, value = 0;
    double level = 0;  ///< NaN releases the wire
};
using Orders = std::vector<Order>;

inline Order bus(const char* card, int bits, std::uint32_t address, std::uint64_t value) {
    return {Order::write, card, {}, bits, address, static_cast<std::uint32_t>(value), 0};
}
inline Order peek(const char* card, int bits, std::uint32_t address) {
    return {Order::read, card, {}, bits, address, 0, 0};
}
inline Order level(std::string wire, double value) {
    return {Order::wire, std::move(wire), {}, 0, 0, 0, value};
}
inline Order fault(std::string what, std::string of) {
    return {Order::fault, std::move(of), std::move(what), 0, 0, 0, 0};
}

struct Step {
    Orders orders;
    std::uint64_t ns = 0;  ///< time that passes after the commands, ns
};

/// A rack file, and the commands of a host and its surroundings.
struct Story {
    std::string text;
    std::vector<Step> steps;
};

/// A kind of rack: creates the story of a seed.
struct Bench {
    const char* name;
    Story (*story)(std::uint64_t seed);
};

inline void PrintTo(const Bench& bench, std::ostream* out) {
    *out << bench.name;
}

/// Returns racks with all kinds of card, alone and together.
std::vector<Bench> benches();
std::vector<Bench> mcx314_benches();

/// Returns the text of a rack with an MCX314, c1, and its axes X and B; `settings`: lines of the card.
std::string mcx314_machine(std::string_view settings = "");
/// Returns a random operation of an MCX314, c1, with the axes X and B; it may consist of several accesses.
Orders anything_to_pulse_chip(Random& random);

/// Returns `count` steps with commands from `orders`, each with its own random duration of 50 ns to `max_ns`.
std::vector<Step> steps_of(Random& random, int count, const std::function<Orders(Random&)>& orders,
                           double max_ns = 3e7);

/// Fails if the two racks of a story differ. Every fifth seed is recorded.
void expect_the_same_however_it_is_cut(const Bench& bench, std::uint64_t seed);

}  // namespace motionrack::rack::cut
