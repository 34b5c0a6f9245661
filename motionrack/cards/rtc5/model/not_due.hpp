// Cache: the tick up to which a waiting external start is known not to be due, from inputs already evaluated.
#pragma once

#include <array>
#include <motionrack/cards/rtc5/model/kernels.hpp>
#include <motionrack/cards/rtc5/model/state.hpp>
#include <span>

namespace motionrack::rtc5 {

inline bool due(const Start& start, std::int64_t travel) {
    return start.delay > 0 ? travel >= start.target : travel <= start.target;
}

/// Cached result, not part of the card's state: after a rewind or a reset it may belong to another past. It therefore
/// stores the travel of each tick, and is valid only while the card's travel is equal; the same inputs then lead to
/// the same future.
class NotDue {
  public:
    bool holds(const Start& start, std::int64_t tick, std::int64_t travel) const {
        return start_.target == start.target && start_.delay == start.delay && start_.encoder == start.encoder &&
               from_ <= tick && tick < until_ && travel_[static_cast<std::size_t>(tick - from_)] == travel;
    }
    /// Returns the first tick in which the start may be due.
    std::int64_t until() const { return until_; }
    /// Discards the result because the inputs have changed.
    void forget() { until_ = from_; }
    /// Finds the tick from the encoder's `counts` at `tick`, `tick` + 1, .. (at most kernels::block). `travel`: travel
    /// at `tick`, where the start must not be due.
    void update(const Start& start, std::int64_t tick, std::int64_t travel, std::span<const std::int32_t> counts) {
        start_ = start;
        from_ = tick;
        travel_[0] = travel;
        std::size_t i = 1;
        for (; i < counts.size(); ++i) {
            travel_[i] = travel_[i - 1] + static_cast<std::int32_t>(static_cast<std::uint32_t>(counts[i]) -
                                                                    static_cast<std::uint32_t>(counts[i - 1]));
            if (due(start, travel_[i])) break;
        }
        until_ = tick + static_cast<std::int64_t>(i);
    }

  private:
    Start start_;
    std::int64_t from_ = 0, until_ = 0;
    std::array<std::int64_t, kernels::block> travel_{};
};

}  // namespace motionrack::rtc5
