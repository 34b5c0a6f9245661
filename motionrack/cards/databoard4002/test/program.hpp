// Random programs of a host, a machine and manually operated switches. The card and its twin must agree on them.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/cards/databoard4002/test/twin.hpp>
#include <string>
#include <vector>

namespace motionrack::databoard4002::twin {

struct Op {
    enum Kind : std::uint8_t { out, in, wire, law, hang, broken } kind = out;
    std::int64_t slice = 0;  ///< instant in 0.5 us; never that of a pass
    std::int64_t a = 0;      ///< port; pin; period in 100 ps
    std::int64_t b = 0;      ///< value; level; direction
};

struct Program {
    std::uint64_t seed = 0, number = 0;
    Strapping strapping;
    std::vector<Op> ops;
};

/// State right after an op.
struct Sight {
    int value = 0, status = 0, latch = 0;
    std::int64_t position = 0, pulses = 0;
    friend bool operator==(const Sight&, const Sight&) = default;
};

/// A change of an output: wire and level; only the last one at an instant.
struct Change {
    std::int64_t slice = 0;
    int wire = 0;
    int level = 0;
    friend bool operator==(const Change&, const Change&) = default;
};

struct Outcome {
    std::vector<Sight> sights;
    std::vector<Change> changes;
    std::vector<Note> notes;
    std::uint64_t events = 0;  ///< events of the kernel
};

/// The last level of each wire at each instant of a change; by instant, then wire.
std::vector<Change> settled(std::vector<Change> raw);

Program make_program(std::uint64_t seed, std::uint64_t number);
Outcome run_on_twin(const Program& program);

/// Run modes of the card; all must give the same outcome.
struct Way {
    bool follow_fout = false;     ///< a listener follows the wire fout
    std::size_t snapshot_at = 0;  ///< after this op the state is saved, disturbed and restored; 0: never
};
Outcome run_on_card(const Program& program, const Way& way);

/// The first difference as text, "" if there is none.
std::string difference(const Program& program, const Outcome& twin, const Outcome& card);

}  // namespace motionrack::databoard4002::twin
