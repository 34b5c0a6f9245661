// Quadrature counters: what cards make of two lines A and B, in three forms that agree.
//
//   lines B A (bit 0: A)  00 -> 01 -> 11 -> 10 -> 00   up (A leads B); the other way down; both at once: illegal
//
//   ClosedFormCounter   a count at any instant from a Motion, nothing done for an edge    positions, compare registers
//   QuadratureDecoder   edge by edge, a table of 16 transitions                           wires driven from outside
//   BatchDecoder        lines in bulk                                                     edge listeners
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <motionrack/sim/position_function.hpp>

namespace motionrack::sim {

/// The lines that a count stands for.
constexpr std::uint8_t lines_of(std::int64_t count) {
    const auto phase = static_cast<std::uint8_t>(count & 3);
    return static_cast<std::uint8_t>(phase ^ (phase >> 1));  // Gray code: 0, 1, 3, 2
}

/// How many of the four edges of a line pair are counted.
enum class Edges : std::int32_t { all = 4, both_of_a = 2, rising_a = 1 };

/// What a counter of fewer edges shows when one of all edges shows `count`; both are 0 at lines 00.
constexpr std::int64_t divided(std::int64_t count, Edges edges) {
    if (edges == Edges::all) return count;
    if (edges == Edges::both_of_a) return (count + 1) >> 1;  // A changes at 0|1 and 2|3 (modulo 4)
    return (count + 3) >> 2;                                 // A rises (B low) at 0|1
}

// ---- Closed form

/// A settable counter over a Motion: counter(t) = divided(motion) + offset. Its whole state is the offset.
class ClosedFormCounter {
  public:
    ClosedFormCounter() = default;
    /// `first`: the first of the period's four edges (0: from lines 00 upwards) that is counted, where not all are.
    ClosedFormCounter(Edges edges, bool reversed, int first = 0) : edges_(edges), reversed_(reversed), first_(first) {}

    std::int64_t value(const PositionFunction& motion, Instant t) const { return from_motion(motion.count(t)); }
    std::int64_t from_motion(std::int64_t count) const {
        const std::int64_t n = divided(count - first_, edges_);
        return (reversed_ ? -n : n) + offset_;
    }
    /// Writes the counter.
    void set(std::int64_t value, const PositionFunction& motion, Instant t) {
        offset_ += value - this->value(motion, t);
    }
    /// Watches for the counter to be at or below `below`, or at or above `above`.
    void watch(PositionFunction& motion, int slot, std::int64_t below, std::int64_t above) const;

  private:
    std::int64_t offset_ = 0;
    Edges edges_ = Edges::all;
    std::int32_t reversed_ = 0;
    std::int64_t first_ = 0;
};

// ---- Edge by edge

/// State only; trivially copyable.
class QuadratureDecoder {
  public:
    QuadratureDecoder() = default;
    /// `first`: as for ClosedFormCounter.
    explicit QuadratureDecoder(Edges edges, std::uint8_t lines = 0, int first = 0)
        : edges_(edges), lines_(lines), first_(static_cast<std::uint8_t>(first)) {}

    /// The lines are now `lines` (bit 0: A, bit 1: B). Returns what that counted: -1, 0 or +1.
    int lines(std::uint8_t lines);
    /// The index line. A rising edge latches the count, and clears it if `clear`.
    void index(int level, bool clear = false);

    std::int64_t count() const { return count_; }
    void set_count(std::int64_t count) { count_ = count; }
    /// Transitions with both lines changed at once: not counted, the count is no longer sure.
    std::uint64_t illegal() const { return illegal_; }
    /// The count at the last rising edge of the index, and how many there were.
    std::int64_t latched() const { return latched_; }
    std::uint64_t indices() const { return indices_; }

  private:
    std::int64_t count_ = 0;
    std::int64_t latched_ = 0;
    std::uint64_t illegal_ = 0;
    std::uint64_t indices_ = 0;
    Edges edges_ = Edges::all;
    std::uint8_t lines_ = 0;
    std::uint8_t index_ = 0;
    std::uint8_t first_ = 0;
    [[maybe_unused]] std::uint8_t reserved_ = 0;
};

// ---- In bulk

/// Decodes rows of line states, one byte a sample. The same count and illegal transitions as QuadratureDecoder with
/// Edges::all.
class BatchDecoder final : public EdgeListener {
  public:
    explicit BatchDecoder(std::int64_t count = 0) : count_(count), lines_(lines_of(count)) {}

    /// `size` samples of the lines (bit 0: A, bit 1: B; other bits 0), in order.
    void decode(const std::uint8_t* lines, std::size_t size);
    /// Puts the edges of a batch on the two lines and decodes those.
    void edges(const EdgeBatch& batch) override;

    std::int64_t count() const { return count_; }
    std::uint64_t illegal() const { return illegal_; }

  private:
    std::int64_t count_ = 0;
    std::uint64_t illegal_ = 0;
    std::uint8_t lines_ = 0;  // the last sample
    std::array<std::uint8_t, EdgeBatch::capacity> samples_;
};

/// The lines after each edge of `batch`, into `lines` (batch.size bytes).
void lines_of_batch(const EdgeBatch& batch, std::uint8_t* lines);

}  // namespace motionrack::sim
