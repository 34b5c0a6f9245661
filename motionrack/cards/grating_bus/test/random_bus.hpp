// Random programs for the bus: cards, decoders, timings, and external actions.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <motionrack/cards/grating_bus/test/twin.hpp>
#include <random>
#include <string>
#include <tests/oracle/harness.hpp>
#include <vector>

namespace motionrack::grating_bus::twin {

/// One external action. `who`: number of the card or decoder; `a`: parameter of the kind.
struct Op {
    enum Kind { poll, off, reset, late, miss_edges, jitter, no_latch, force, release, claim, give_back, clear };
    Ticks at = 0;
    Kind kind = poll;
    int who = 0;
    /// Off, no_latch: 0 or 1; reset: 0 by the register, else as a fault; late, jitter: ticks; miss_edges: number of
    /// edges; force: level; poll: not 0 if the watcher subscribes to all wires from now on (Watch::now_and_then).
    std::int64_t a = 0;
    Line line = clk;
    int bit = -1;  ///< bit of addr or data; -1: the whole line
};

/// A scale that starts at the count `start` and moves by `step` counts in each `every` ticks.
struct Course {
    std::uint32_t start = 0;
    std::int64_t step = 1, every = 500;
    std::uint32_t at(Ticks t) const { return start + static_cast<std::uint32_t>(step * (t / every)); }
};

struct Program {
    std::vector<CardSettings> cards;
    std::vector<std::uint32_t> seeds;  ///< seeds of the cards' jitter
    DecoderSettings decoder;
    std::vector<Course> scales;
    std::vector<Op> ops;
    Ticks end = 0;
    std::size_t snapshot_at = oracle::never;  ///< after this op the cards are saved, disturbed and restored
};

class Maker {
  public:
    explicit Maker(std::uint64_t seed) : random_(seed) {}
    Program make();

  private:
    std::int64_t below(std::int64_t n) { return static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(n)); }
    bool one_in(std::int64_t n) { return below(n) == 0; }
    Ticks time(Ticks min, Ticks max) { return (min + below(max - min + 1)) * grain_; }
    BusTiming timing();
    void set(CardSettings& card, const BusTiming& timing);
    void add_cards();
    std::vector<int> list(int words);
    void add_decoder();
    Ticks instant();
    Op op();

    std::mt19937_64 random_;
    Program program_;
    Ticks grain_ = 1, period_ = 0;
    bool healthy_ = false;  // one host, equal cards, a matching decoder: a typical crate
};

/// Makes the twin of a program, before its first instant.
Twin twin_of(const Program& program, bool every_tick = false);
/// Runs the twin to the operation's instant and executes it.
void carry_out(Twin& twin, const Op& op);

// For messages of failed tests.
std::string listing_of(const Program& program);
void PrintTo(const Op& op, std::ostream* out);

}  // namespace motionrack::grating_bus::twin
