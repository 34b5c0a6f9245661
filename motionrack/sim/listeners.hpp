// Listeners of a PositionFunction, for its implementations.
//
//   watch(slot, below, above) ──► Watches, in the owner's state: a snapshot contains them
//   the count changes         ──► notify_crossed: once to each listener whose range is left
//   the law changes           ──► notify_rate: to all listeners
#pragma once

#include <array>
#include <motionrack/base/result.hpp>
#include <motionrack/sim/position_function.hpp>
#include <motionrack/sim/range.hpp>

namespace motionrack::sim {

class Listeners {
  public:
    /// Watched range of each slot; open at both ends if unused.
    using Watches = std::array<Range, PositionFunction::max_listeners>;

    /// Adds a listener before the kernel starts; returns its slot.
    int add(PositionListener& listener) {
        MOTIONRACK_ASSERT(size_ < PositionFunction::max_listeners);
        all_[static_cast<std::size_t>(size_)] = &listener;
        return size_++;
    }
    int size() const { return size_; }
    PositionListener& operator[](int slot) const { return *all_[static_cast<std::size_t>(slot)]; }

    void notify_rate(double before, double after, Instant now) const {
        for (int i = 0; i < size_; ++i) (*this)[i].rate_changed(before, after, now);
    }
    /// Notifies, and disarms, every listener whose range no longer contains `count`.
    void notify_crossed(Watches& watches, std::int64_t count, Instant now) const {
        for (int i = 0; i < size_; ++i) {
            Range& watch = watches[static_cast<std::size_t>(i)];
            if (!watch.left(count)) continue;
            watch = {};
            (*this)[i].crossed(now);
        }
    }
    /// The range in which no listener needs a notification.
    static Range unwatched_range(const Watches& watches) {
        Range all;
        for (const Range& watch : watches) all = all.within(watch);
        return all;
    }

  private:
    std::array<PositionListener*, PositionFunction::max_listeners> all_{};
    int size_ = 0;
};

}  // namespace motionrack::sim
