// The lines A, B and Z at the end of the cable of an encoder or converter, edge by edge, with their faults.
//
//   position (counts) ──► single edges, limited by the count rate of the electronics ──► dirt
//       ──► polarity, noise, swap, break ──► wires
//
//   count  ...  0   1   2   3   4  ...     counting up: A leads B
//   A      ...  _/~~~~~~~\_______/~~
//   B      ...  _____/~~~~~~~\_____
//   Z      ...  ~~~\________ ... __/~~~    one count wide, at every index
//
// Pseudo-random values come from a generator in the state: equal seeds, equal histories.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/parts/range.hpp>
#include <string>
#include <string_view>
#include <type_traits>

namespace motionrack::parts {

/// Treatment of edges that are too fast for the electronics.
enum class TooQuick : std::uint8_t {
    loses_lines,     ///< whole lines are lost
    loses_by_fault,  ///< they are delayed; with the fault over-speed, whole lines are lost
    comes_later,     ///< they are delayed, also with the fault
};

struct LineOutputSettings {
    std::int64_t index_every = 0;  ///< counts from index to index, >= 0; 0: no index
    std::int64_t index_at = 0;     ///< count of one index
    std::int64_t dirt_at = 0;      ///< count at which the dirt of the fault "dirt" begins, within index_every
    Duration min_edge_interval = nanoseconds(200);  ///< 10 ns .. 1 s: minimum time between two edges
    TooQuick too_quick = TooQuick::loses_lines;
    std::uint64_t seed = 1;
};

struct LineOutputState {
    std::int64_t shown = 0;   ///< the count shown by the lines
    std::int64_t target = 0;  ///< the count to show
    std::int64_t lost = 0;    ///< total of counts never shown
    Instant step_at = never;  ///< the next edge
    Instant free_at{};        ///< earliest instant of the next edge
    Instant noise_at = never;
    std::uint64_t random = 1;
    std::int64_t noise_left = 0;    ///< pulses
    std::int64_t missing_left = 0;  ///< index pulses to be omitted
    std::int64_t second_index = 0;  ///< distance of the double index, counts; 0: none
    std::int64_t dirt_lines = 0;
    std::int64_t jitter = 0;               ///< maximum delay of an edge, ticks
    std::int64_t min_edge_interval = 0;    ///< ticks
    std::array<std::uint8_t, 3> broken{};  ///< 0: intact, 1: reads low, 2: reads high
    std::uint8_t inverted = 0;             ///< bit 0 A, 1 B, 2 Z
    std::uint8_t swapped = 0;
    std::uint8_t flipped = 0;   ///< by noise, bits as above
    std::uint8_t in_index = 0;  ///< Z is active (or omitted)
    std::uint8_t left_out = 0;  ///< this index pulse is omitted
};
static_assert(std::has_unique_object_representations_v<LineOutputState>, "padding would get into the state's hash");

class LineOutput {
  public:
    /// Adds the wires NAME.a, NAME.b, NAME.z before the kernel starts.
    LineOutput(sim::Kernel& kernel, const std::string& name, const LineOutputSettings& settings,
               LineOutputState& state);

    /// Starts at `count`, without edges.
    void begin(std::int64_t count);
    /// Sets the target of the lines to `count`.
    void show(std::int64_t count, Instant now);
    /// Renumbers the count by `counts` (a multiple of 4 and of index_every), without an edge.
    void rename(std::int64_t counts);
    /// Executes due events; call at next().
    void act(Instant now);
    Instant next() const { return std::min(state_.step_at, state_.noise_at); }

    /// Sets or clears a fault: broken_a, broken_b, broken_z (1: reads low, 2: reads high), inverted_a, inverted_b,
    /// inverted_z, swapped (not 0), noise (pulses of a burst on A and B that begins now, up to 1e6), missing_index
    /// (number to omit, up to 1e9), double_index (distance of a second one after each, counts, less than index_every),
    /// jitter (s, maximum delay of an edge, up to 1), dirt (invisible lines, less than index_every / 4), overspeed
    /// (maximum edges/s, 1 to 1e8; 0: as in the settings). Returns false for an unknown fault or a value out of range.
    bool fault(std::string_view name, double value, Instant now);

    std::int64_t shown() const { return state_.shown; }
    std::int64_t lost() const { return state_.lost; }
    const LineOutputSettings& settings() const { return settings_; }
    sim::WireId a() const { return wires_[0]; }
    sim::WireId b() const { return wires_[1]; }
    sim::WireId z() const { return wires_[2]; }

  private:
    std::uint64_t random(std::uint64_t below);
    void plan(Instant now);
    bool loses_lines() const;
    void step(Instant now);
    void noise(Instant now);
    void note_index();
    std::int64_t visible(std::int64_t count) const;
    bool index(std::int64_t count) const;
    void put_out();

    sim::Kernel& kernel_;
    LineOutputSettings settings_;
    LineOutputState& state_;
    std::array<sim::WireId, 3> wires_{};
};

}  // namespace motionrack::parts
