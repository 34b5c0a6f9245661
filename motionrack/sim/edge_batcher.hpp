// Collects single edges into batches: for position functions without even pulses.
#pragma once

#include <cstdint>
#include <limits>
#include <motionrack/sim/position_function.hpp>

namespace motionrack::sim {

class EdgeBatcher {
  public:
    /// Adds an edge at `at`, not before the last one, with `count` after it; `step` +1 or -1. Delivers the batch first
    /// if the edge does not fit into it.
    void add(EdgeListener& listener, Instant at, std::int64_t count, int step) {
        const bool fits =
            batch_.size < EdgeBatch::capacity && step == batch_.step && (at - batch_.origin).count() <= max_batch_ticks;
        if (!fits) hand_over(listener);
        if (batch_.size == 0) {
            batch_.origin = at;
            batch_.tick = Duration{1};
            batch_.first_count = count;
            batch_.step = step;
        }
        batch_.at[batch_.size++] = static_cast<std::uint32_t>((at - batch_.origin).count());
    }
    /// Delivers the collected edges.
    void hand_over(EdgeListener& listener) {
        if (batch_.size > 0) listener.edges(batch_);
        batch_.size = 0;
    }

  private:
    /// Ticks from the first to the last edge of a batch.
    static constexpr std::int64_t max_batch_ticks = std::numeric_limits<decltype(EdgeBatch::at)::value_type>::max();
    EdgeBatch batch_{};
};

}  // namespace motionrack::sim
