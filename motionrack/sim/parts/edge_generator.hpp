// Turns batches of pulse edges into edges of the rotor and of the encoder's count.
//
// If a microstep moves the encoder by several counts, their edges come shortly before the microstep's own instant, in
// order, the last one exactly at it.
#pragma once

#include <array>
#include <motionrack/sim/parts/encoder.hpp>
#include <motionrack/sim/parts/mechanics_faces.hpp>
#include <motionrack/sim/position_function.hpp>

namespace motionrack::parts {

class EdgeGenerator {
  public:
    using Listeners = std::array<sim::EdgeListener*, MechanicsFaces::face_count>;

    /// `last`: instant of the last delivered edge; part of the axis' state, which must outlive this.
    explicit EdgeGenerator(Instant& last) : last_(last) {}

    /// Delivers the first `size` edges of `batch` as rotor edges; the count after the first is `first`.
    void pass(const Encoder& encoder, const Listeners& listeners, const sim::EdgeBatch& batch, std::int64_t first,
              std::uint32_t size);
    /// The rotor jumps from `from` to `to`.
    void jump(const Encoder& encoder, const Listeners& listeners, Instant now, std::int64_t from, std::int64_t to);
    /// The encoder's count jumps from `from` to `to`.
    void count_jump(sim::EdgeListener& listener, Instant now, std::int64_t from, std::int64_t to);

  private:
    static constexpr std::int64_t spacing = 8;  // ticks between the edges of one microstep, if they fit

    void turn(sim::EdgeListener& listener, const Encoder& encoder, const sim::EdgeBatch& batch, std::int64_t first,
              std::uint32_t size);
    void add(sim::EdgeListener& listener, std::int64_t at, std::int64_t count);
    void flush(sim::EdgeListener& listener);

    Instant& last_;
    sim::EdgeBatch out_{};    // edges of the encoder
    sim::EdgeBatch copy_{};   // edges of the rotor
    std::int64_t base_ = 0;   // ticks of the batch at the start of out_
    Instant origin_{};        // origin of the present batch
    std::int64_t count_ = 0;  // count after the last edge of out_
};

}  // namespace motionrack::parts
