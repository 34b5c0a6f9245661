// Random register programs for the oracle test: valid and invalid actions of a host on the chip, with their times.
#pragma once

#include <cstdint>
#include <motionrack/cards/mcx314/test/twin.hpp>
#include <string>
#include <tests/oracle/harness.hpp>
#include <vector>

namespace motionrack::mcx314::twin {

/// One action on the chip. An access with `between` = false is at the very instant of `tick` (and so comes after it),
/// otherwise half a tick later. A wire that changes at the very instant belongs to that tick.
struct Op {
    enum class Kind : std::uint8_t { write, read, write_byte, read_byte, input, emergency, step, encoder };
    std::int64_t tick = 0;
    bool between = false;
    Kind kind = Kind::read;
    std::uint8_t offset = 0;  ///< register or port, for accesses; encoder line, 0 A, 1 B
    std::uint16_t value = 0;  ///< the value written, or the level of the input
    std::int8_t axis = 0;     ///< axis of the input
    Pin pin = Pin::in0;

    /// Returns the order of the action: two halves per tick, wires first.
    std::int64_t order() const { return tick * 4 + (between ? 2 : 0) + (is_wire() ? 0 : 1); }
    bool is_wire() const {
        return kind == Kind::input || kind == Kind::emergency || kind == Kind::step || kind == Kind::encoder;
    }
    bool is_read() const { return kind == Kind::read || kind == Kind::read_byte; }
};

/// Run modes of a program; all must give the same outcome.
struct Way {
    bool listen = true;        ///< with an edge listener
    bool watch = false;        ///< with watches of the counts
    bool follow = false;       ///< with followers of the output pins
    std::uint64_t slices = 0;  ///< seed of random divisions of the run between ops; 0: none
};

struct Program {
    std::uint64_t seed = 0;
    std::uint64_t number = 0;
    ChipOptions options;     ///< options of its chip
    std::int64_t ticks = 0;  ///< runs to this tick after the last op
    std::vector<Op> ops;
    Way way;
    std::size_t snapshot_at = oracle::never;  ///< after this op, or soon, the chip is saved, disturbed and restored
    bool extended() const { return options.variant == Variant::mcx314as; }
};

/// Makes program `number` of `seed`; the same numbers always give the same program.
Program make_program(std::uint64_t seed, std::uint64_t number, const ChipOptions& options = {});

/// Returns the register traffic as text, one line per op.
std::string listing_of(const Program& program);

/// Random numbers by splitmix64: small, and the same on every machine.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    std::uint64_t next();
    /// Returns a number low .. high, both included.
    std::int64_t between(std::int64_t low, std::int64_t high);
    bool one_in(int n) { return between(1, n) == 1; }
    template <class T, std::size_t N>
    T of(const T (&list)[N]) {
        return list[static_cast<std::size_t>(between(0, static_cast<std::int64_t>(N) - 1))];
    }

  private:
    std::uint64_t state_;
};

}  // namespace motionrack::mcx314::twin
