// The transition table, and vectorised decoding of sixteen samples at a time.
#include <algorithm>
#include <cstring>
#include <motionrack/sim/blocks/quadrature_counter.hpp>

namespace motionrack::sim {

// ---- Closed form

void ClosedFormCounter::watch(PositionFunction& motion, int slot, std::int64_t below, std::int64_t above) const {
    const bool no_below = below == unwatched_below;
    const bool no_above = above == unwatched_above;
    // In divided counts of the position function.
    std::int64_t low = no_below ? unwatched_below : below - offset_;
    std::int64_t high = no_above ? unwatched_above : above - offset_;
    if (reversed_) {
        const std::int64_t turned_low = no_above ? unwatched_below : -high;
        high = no_below ? unwatched_above : -low;
        low = turned_low;
    }
    // divided(c) = (c + k) >> s;  >= high  <=>  c >= (high << s) - k;  <= low  <=>  c <= ((low + 1) << s) - k - 1
    const int shift = edges_ == Edges::all ? 0 : edges_ == Edges::both_of_a ? 1 : 2;
    const std::int64_t k = (std::int64_t{1} << shift) - 1;
    if (low != unwatched_below) low = (low + 1) * (std::int64_t{1} << shift) - k - 1;
    if (high != unwatched_above) high = high * (std::int64_t{1} << shift) - k;
    if (low != unwatched_below) low += first_;
    if (high != unwatched_above) high += first_;
    motion.watch(slot, low, high);
}

// ---- Edge by edge

namespace {

constexpr int bad = 2;

// [before * 4 + after], lines B A: counts of all edges.
constexpr int all_edges[16] = {
    /* from 00 */ 0,   +1,  -1,  bad,
    /* from 01 */ -1,  0,   bad, +1,
    /* from 10 */ +1,  bad, 0,   -1,
    /* from 11 */ bad, -1,  +1,  0};

}  // namespace

int QuadratureDecoder::lines(std::uint8_t lines) {
    const std::uint8_t before = lines_;
    lines_ = lines & 3;
    int change = all_edges[before * 4 + lines_];
    if (change == bad) {
        ++illegal_;
        return 0;
    }
    if (edges_ != Edges::all) {
        // Index of the edge in the period, from the lower of its two phases.
        const int lower = change > 0 ? before : lines_;
        const int number = (lower ^ (lower >> 1)) - first_;
        if ((number & (edges_ == Edges::both_of_a ? 1 : 3)) != 0) change = 0;
    }
    count_ += change;
    return change;
}

void QuadratureDecoder::index(int level, bool clear) {
    const bool rises = level != 0 && index_ == 0;
    index_ = level != 0;
    if (!rises) return;
    latched_ = count_;
    ++indices_;
    if (clear) count_ = 0;
}

// ---- In bulk

namespace {

// Portable vectors of the compiler: SSE2 on every x86-64, scalar code without vector support.
using Bytes = std::uint8_t __attribute__((vector_size(16)));
constexpr std::size_t width = sizeof(Bytes);

Bytes load(const std::uint8_t* from) {
    Bytes out;
    std::memcpy(&out, from, width);
    return out;
}

// The phase 0 .. 3 of lines in Gray code; bytes hold two bits, so a shift of wider lanes is safe too.
Bytes phase(Bytes lines) {
    return lines ^ ((lines & 2) != 0 ? Bytes{} + 1 : Bytes{});
}

int phase(std::uint8_t lines) {
    return (lines ^ (lines >> 1)) & 3;
}

std::uint64_t sum(Bytes v) {
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < width; ++i) total += v[i];
    return total;
}

}  // namespace

void BatchDecoder::decode(const std::uint8_t* lines, std::size_t size) {
    if (size == 0) return;
    auto one = [this](std::uint8_t before, std::uint8_t after) {
        const int turn = (phase(after) - phase(before)) & 3;
        count_ += turn == 1 ? 1 : turn == 3 ? -1 : 0;
        illegal_ += turn == 2;
    };
    one(lines_, lines[0]);
    lines_ = lines[size - 1];
    // Sample i with sample i - 1, from i = 1 on. A byte lane sums at most 255 ones.
    std::size_t i = 1;
    while (i + width <= size) {
        const std::size_t blocks = std::min<std::size_t>((size - i) / width, 255);
        Bytes ups{}, downs{}, illegals{};
        for (std::size_t k = 0; k < blocks; ++k, i += width) {
            const Bytes turn = (phase(load(lines + i)) - phase(load(lines + i - 1))) & 3;
            ups -= reinterpret_cast<Bytes>(turn == 1);
            downs -= reinterpret_cast<Bytes>(turn == 3);
            illegals -= reinterpret_cast<Bytes>(turn == 2);
        }
        count_ += static_cast<std::int64_t>(sum(ups)) - static_cast<std::int64_t>(sum(downs));
        illegal_ += sum(illegals);
    }
    for (; i < size; ++i) one(lines[i - 1], lines[i]);
}

void lines_of_batch(const EdgeBatch& batch, std::uint8_t* lines) {
    // Phases repeat every four edges, so the lines are the same sixteen edges later.
    Bytes row;
    for (std::size_t i = 0; i < width; ++i)
        row[i] = lines_of(batch.first_count + batch.step * static_cast<std::int64_t>(i));
    std::size_t i = 0;
    for (; i + width <= batch.size; i += width) std::memcpy(lines + i, &row, width);
    std::memcpy(lines + i, &row, batch.size - i);
}

void BatchDecoder::edges(const EdgeBatch& batch) {
    lines_of_batch(batch, samples_.data());
    decode(samples_.data(), batch.size);
}

}  // namespace motionrack::sim
