// Random programs of a host, a machine and manually operated switches. The card and its twin must agree on them.
#pragma once

#include <array>
#include <cstdint>
#include <iosfwd>
#include <motionrack/cards/databoard4002/test/twin.hpp>
#include <string>
#include <tests/oracle/changes.hpp>
#include <tests/oracle/harness.hpp>
#include <vector>

namespace motionrack::databoard4002::twin {

struct Op {
    enum Kind : std::uint8_t { out, in, wire, law, hang, broken } kind = out;
    std::int64_t slice = 0;  ///< instant in 0.5 us; never that of a pass
    std::int64_t a = 0;      ///< the port, the pin, or the period in 100 ps
    std::int64_t b = 0;      ///< the value, the level, or the direction
};

struct Program {
    Strapping strapping;
    std::vector<Op> ops;
    bool follow_fout = false;                 ///< a listener follows the card's wire fout, without effect
    std::size_t snapshot_at = oracle::never;  ///< after this op the card is saved, disturbed and restored
};

/// State that the host sees right after an operation.
struct Sight {
    int value = 0, status = 0, latch = 0;
    std::int64_t position = 0, pulses = 0;
    friend bool operator==(const Sight&, const Sight&) = default;
};

struct Outcome {
    std::vector<Sight> sights;
    std::vector<oracle::Change> changes;  ///< output changes; each level is that at the end of its instant
    std::vector<Note> notes;
};

/// Returns the levels of the outputs at power-up.
inline std::vector<std::int64_t> first_outputs() {
    return {0, 1, 0, 0, 0};
}

Program make_program(std::uint64_t seed, std::uint64_t number);
Outcome run_on_twin(const Program& program);
Outcome run_on_card(const Program& program);
void run_both(const Program& program, oracle::Comparison& both);

std::string listing_of(const Program& program);
void PrintTo(const Op& op, std::ostream* out);
void PrintTo(const Sight& sight, std::ostream* out);
void PrintTo(const Note& note, std::ostream* out);

}  // namespace motionrack::databoard4002::twin
