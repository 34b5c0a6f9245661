// Turns batches of pulse edges into edges of the rotor and of the encoder's count.
//
// Where a microstep turns the encoder by several counts, its edges come shortly before the microstep's own instant, in
// order, the last one exactly then.
#pragma once

#include <array>
#include <motionrack/sim/parts/axis_mechanics.hpp>
#include <motionrack/sim/position_function.hpp>

namespace motionrack::parts {

class AxisMechanics::EdgeMaker {
  public:
    using Listeners = std::array<sim::EdgeListener*, face_count>;

    /// `last`: the instant of the last edge handed over before, part of the machine's state.
    explicit EdgeMaker(Instant& last) : last_(last) {}

    /// Hands the first `size` edges of `batch` over as rotor edges, the first of which leads to `first`.
    void pass(const Encoder& encoder, const Listeners& listeners, const sim::EdgeBatch& batch, std::int64_t first,
              std::uint32_t size);
    /// The rotor goes from `from` to `to` at once.
    void jump(const Encoder& encoder, const Listeners& listeners, Instant now, std::int64_t from, std::int64_t to);
    /// The encoder's count goes from `from` to `to` at once.
    void count_jump(sim::EdgeListener& listener, Instant now, std::int64_t from, std::int64_t to);

  private:
    static constexpr std::int64_t spacing = 8;  // ticks between the edges of one microstep, if there is room

    void turn(sim::EdgeListener& listener, const Encoder& encoder, const sim::EdgeBatch& batch, std::int64_t first,
              std::uint32_t size);
    void add(sim::EdgeListener& listener, std::int64_t at, std::int64_t count);
    void flush(sim::EdgeListener& listener);

    Instant& last_;
    sim::EdgeBatch out_{};    // of the encoder
    sim::EdgeBatch copy_{};   // of the rotor
    std::int64_t base_ = 0;   // ticks of the batch at which out_ begins
    Instant origin_{};        // of the batch being turned
    std::int64_t count_ = 0;  // after the last edge of out_
};

}  // namespace motionrack::parts
