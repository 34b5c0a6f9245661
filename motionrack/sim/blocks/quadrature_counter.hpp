// Quadrature counters of two lines A and B, in three equivalent forms.
//
//   lines B A (bit 0: A)  00 -> 01 -> 11 -> 10 -> 00   up (A leads B); in reverse down; both at once: illegal
//
//   ClosedFormCounter   a count at any instant, no work per edge    positions, compare registers
//   QuadratureDecoder   edge by edge, a table of 16 transitions     wires driven from outside
//   BatchDecoder        lines in bulk                               edge listeners
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <motionrack/sim/position_function.hpp>

namespace motionrack::sim {

/// Lines of a count.
constexpr std::uint8_t lines_of(std::int64_t count) {
    const auto phase = static_cast<std::uint8_t>(count & 3);
    return static_cast<std::uint8_t>(phase ^ (phase >> 1));  // Gray code: 0, 1, 3, 2
}

/// Edges of a line pair that are counted per period.
enum class Edges : std::int32_t { all = 4, both_of_a = 2, rising_a = 1 };

/// Value of a counter with fewer edges if a counter of all edges shows `count`; both are 0 at lines 00.
constexpr std::int64_t divided(std::int64_t count, Edges edges) {
    if (edges == Edges::all) return count;
    if (edges == Edges::both_of_a) return (count + 1) >> 1;  // A changes at 0|1 and 2|3 (modulo 4)
    return (count + 3) >> 2;                                 // A rises (B low) at 0|1
}

// ---- Closed form

/// A settable counter of a PositionFunction: counter(t) = divided(position) + offset. Its only state is the offset.
class ClosedFormCounter {
  public:
    ClosedFormCounter() = default;
    /// `first`: the first counted edge of the period's four (0: from lines 00 upwards), if not all are counted.
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
    /// Watches for a counter at or below `below`, or at or above `above`.
    void watch(PositionFunction& motion, int slot, std::int64_t below, std::int64_t above) const;

  private:
    std::int64_t offset_ = 0;
    Edges edges_ = Edges::all;
    std::int32_t reversed_ = 0;
    std::int64_t first_ = 0;
};

// ---- Edge by edge

/// Plain state; trivially copyable.
class QuadratureDecoder {
  public:
    QuadratureDecoder() = default;
    /// `first`: as for ClosedFormCounter.
    explicit QuadratureDecoder(Edges edges, std::uint8_t lines = 0, int first = 0)
        : edges_(edges), lines_(lines), first_(static_cast<std::uint8_t>(first)) {}

    /// Sets the lines to `lines` (bit 0: A, bit 1: B). Returns the count: -1, 0 or +1.
    int lines(std::uint8_t lines);
    /// Sets the index line. A rising edge latches the count, and clears it if `clear`.
    void index(int level, bool clear = false);

    std::int64_t count() const { return count_; }
    void set_count(std::int64_t count) { count_ = count; }
    /// Simultaneous changes of both lines: not counted; the count is then uncertain.
    std::uint64_t illegal() const { return illegal_; }
    /// The count at the last rising edge of the index, and the number of such edges.
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

/// Decodes arrays of line states, one byte per sample. Gives the same count and illegal transitions as
/// QuadratureDecoder with Edges::all.
class BatchDecoder final : public EdgeListener {
  public:
    explicit BatchDecoder(std::int64_t count = 0) : count_(count), lines_(lines_of(count)) {}

    /// `size` samples of the lines (bit 0: A, bit 1: B; other bits 0), in order.
    void decode(const std::uint8_t* lines, std::size_t size);
    /// Applies the edges of a batch to the two lines and decodes them.
    void edges(const EdgeBatch& batch) override;

    std::int64_t count() const { return count_; }
    std::uint64_t illegal() const { return illegal_; }

  private:
    std::int64_t count_ = 0;
    std::uint64_t illegal_ = 0;
    std::uint8_t lines_ = 0;  // the last sample
    std::array<std::uint8_t, EdgeBatch::capacity> samples_;
};

/// Writes the lines after each edge of `batch` to `lines` (batch.size bytes).
void lines_of_batch(const EdgeBatch& batch, std::uint8_t* lines);

}  // namespace motionrack::sim
