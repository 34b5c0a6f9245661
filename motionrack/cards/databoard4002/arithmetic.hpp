// Integer arithmetic shared by the card's model and its function library: 24-bit positions, rate to frequency and
// voltage.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace motionrack::databoard4002 {

// ---- Positions

/// Returns the lowest 24 bits of `x` as a number in two's complement, -8,388,608 .. 8,388,607.
constexpr std::int64_t signed24(std::int64_t x) {
    return ((x + 0x80'0000) & 0xFF'FFFF) - 0x80'0000;
}
/// The longest move, counts.
inline constexpr std::int64_t max_move_counts = 0x7F'FFFF;

// ---- Rate and frequency

inline constexpr std::int64_t clock_hz = 400'000;
inline constexpr int max_rate = 0x3FFF;
inline constexpr int rate_mask = max_rate;

/// Returns the number by which the card divides its 400 kHz clock at a rate of 0 .. 16383.
constexpr std::int64_t divisor_of(int rate) {
    return 16'384 - rate;
}
/// Returns the frequency of the output FOUT at a rate of 0 .. 16383, Hz; 0 at rate 0 (standstill).
constexpr double hz_of(int rate) {
    return rate == 0 ? 0.0 : static_cast<double>(clock_hz) / static_cast<double>(divisor_of(rate));
}

// ---- Voltage

/// Output of the frequency/voltage converter at a rate.
struct TrimRow {
    std::int32_t microvolts = 0;
    std::int32_t rate = 0;
};

/// Trim table of a card: at most 64 rows, voltages and rates ascending.
struct Trim {
    std::array<TrimRow, 64> rows{};
    int size = 0;
};

/// Trim table from the maker's description. Two misprints are corrected to fit the neighbouring rows: the voltage of
/// row 1 (0.01 V) and the rate of row 5 (14745, printed as 15745).
inline constexpr Trim default_trim = {
    {{{10'000, 13'799},    {25'000, 14'051},    {50'000, 14'339},    {75'000, 14'565},    {100'000, 14'745},
      {150'000, 15'014},   {200'000, 15'207},   {250'000, 15'351},   {300'000, 15'463},   {350'000, 15'547},
      {400'000, 15'628},   {500'000, 15'750},   {750'000, 15'921},   {1'000'000, 16'021}, {1'500'000, 16'130},
      {2'000'000, 16'189}, {2'500'000, 16'225}, {3'000'000, 16'250}, {3'500'000, 16'269}, {4'000'000, 16'282},
      {4'500'000, 16'293}, {5'000'000, 16'302}, {5'500'000, 16'310}, {6'000'000, 16'316}, {6'500'000, 16'321},
      {7'000'000, 16'325}, {7'500'000, 16'330}, {8'000'000, 16'333}, {8'500'000, 16'335}, {9'000'000, 16'338},
      {9'500'000, 16'341}, {10'000'000, 16'345}}},
    32};

/// Returns true if the table has 1 to 64 rows, and if voltages (1 uV .. 10 V) and rates (1 .. 16383) ascend from row to
/// row.
constexpr bool sound(const Trim& trim) {
    if (trim.size < 1 || trim.size > static_cast<int>(trim.rows.size())) return false;
    TrimRow before{0, 0};
    for (int i = 0; i < trim.size; ++i) {
        const TrimRow& row = trim.rows[static_cast<std::size_t>(i)];
        if (row.microvolts <= before.microvolts || row.rate <= before.rate) return false;
        if (row.microvolts > 10'000'000 || row.rate > max_rate) return false;
        before = row;
    }
    return true;
}
static_assert(sound(default_trim));

/// Returns the voltage of the converter at a rate of 0 .. 16383, uV: linear in the frequency between rows and below the
/// first, constant above the last. Halves are rounded up.
constexpr std::int32_t microvolts_of(int rate, const Trim& trim) {
    if (rate <= 0) return 0;
    const std::int64_t n = divisor_of(rate);
    const TrimRow* row = trim.rows.data();
    auto scaled = [](std::int64_t volts, std::int64_t num, std::int64_t den) {
        return (2 * volts * num + den) / (2 * den);
    };
    if (rate <= row->rate) return static_cast<std::int32_t>(scaled(row->microvolts, divisor_of(row->rate), n));
    for (int i = 1; i < trim.size; ++i, ++row) {
        if (rate > row[1].rate) continue;
        const std::int64_t n0 = divisor_of(row[0].rate), n1 = divisor_of(row[1].rate);
        const std::int64_t rise = row[1].microvolts - row[0].microvolts;
        return row->microvolts + static_cast<std::int32_t>(scaled(rise, (n0 - n) * n1, (n0 - n1) * n));
    }
    return row->microvolts;
}

}  // namespace motionrack::databoard4002
