// A quadrature encoder on the rotor: counts as an exact ratio of microsteps, lines A, B and Z, and wiring faults.
//
//   count  ...  0   1   2   3   4  ...     counting up: A leads B
//   A      ...  _/~~~~~~~\_______/~~       A high in phases 1 and 2
//   B      ...  _____/~~~~~~~\_____        B high in phases 2 and 3
//   Z      ...  ~~~\________ ... __/~~~    one count wide, at multiples of counts_per_rev
//
// A broken line reads low: with only the other line a decoder's count alternates by one. Swapped lines count backwards.
// Both are closed forms of the true count, so no edges need to be counted.
#pragma once

#include <cstdint>
#include <motionrack/sim/parts/range.hpp>

namespace motionrack::parts {

struct EncoderSettings {
    std::int64_t counts_per_rev = 4000;  ///< quadrature counts (4 per line) of one revolution; 0: no encoder
};

enum class LineFault : std::int32_t { none, broken_a, broken_b, swapped };

struct EncoderState {
    std::int64_t shift = 0;  ///< change of the count by faults so far; a multiple of 4
    LineFault fault = LineFault::none;
    std::int32_t reserved = 0;
};

/// Levels of the two lines.
struct QuadratureLevels {
    int a = 0;
    int b = 0;
    friend constexpr bool operator==(const QuadratureLevels&, const QuadratureLevels&) = default;
};

class Encoder {
  public:
    Encoder(const EncoderSettings& settings, std::int64_t pulses_per_rev, EncoderState& state);

    bool present() const { return settings_.counts_per_rev > 0; }
    /// Count of the disc: floor(rotor * counts_per_rev / pulses_per_rev).
    std::int64_t disc(std::int64_t rotor) const { return num_ == den_ ? rotor : floor_div(Wide{rotor} * num_, den_); }
    /// Count of a quadrature decoder at the end of the lines.
    std::int64_t count(std::int64_t rotor) const { return seen(disc(rotor)); }
    /// Rate of the count, counts/s, at `rotor_rate` microsteps/s.
    double rate(double rotor_rate) const;
    QuadratureLevels lines(std::int64_t rotor) const;
    /// The index line: not affected by faults of A and B.
    int index(std::int64_t rotor) const { return floor_mod(disc(rotor), settings_.counts_per_rev) == 0; }

    /// The rotor range around `rotor` within which the count stays in `counts`; empty if it is left already.
    Range rotor_range(const Range& counts, std::int64_t rotor) const;
    /// The rotor range around `rotor` in which the index line does not change.
    Range index_range(std::int64_t rotor) const;

    void set_fault(LineFault fault, std::int64_t rotor);
    LineFault fault() const { return state_.fault; }

    /// Count for the disc count `disc`.
    std::int64_t seen(std::int64_t disc) const;
    /// True if counts equal microsteps, without faults: batches of edges can be passed through.
    bool transparent() const { return num_ == den_ && state_.fault == LineFault::none && state_.shift == 0; }
    /// Counts per microstep as a ratio in lowest terms.
    std::int64_t ratio_num() const { return num_; }
    std::int64_t ratio_den() const { return den_; }

    const EncoderSettings& settings() const { return settings_; }

  private:
    Range disc_to_rotor(const Range& disc) const;

    EncoderSettings settings_;
    EncoderState& state_;
    std::int64_t num_ = 1;
    std::int64_t den_ = 1;
};

}  // namespace motionrack::parts
