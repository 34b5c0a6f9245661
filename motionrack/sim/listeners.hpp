// Who listens to a motion, for those that are one.
//
//   watch(slot, below, above) ──► Watches, in the owner's state: a snapshot has them
//   the count moves           ──► notify_crossed: who watched a range that is left hears of it, once
//   the law changes           ──► notify_rate: all hear of it
#pragma once

#include <array>
#include <motionrack/base/result.hpp>
#include <motionrack/sim/position_function.hpp>
#include <motionrack/sim/range.hpp>

namespace motionrack::sim {

class Listeners {
  public:
    /// What each slot watches; open at both ends if nothing.
    using Watches = std::array<Range, PositionFunction::max_listeners>;

    /// Before the kernel starts; the listener's slot.
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
    /// Whose range `count` has left hears of it, and watches nothing until it says so anew.
    void notify_crossed(Watches& watches, std::int64_t count, Instant now) const {
        for (int i = 0; i < size_; ++i) {
            Range& watch = watches[static_cast<std::size_t>(i)];
            if (!watch.left(count)) continue;
            watch = {};
            (*this)[i].crossed(now);
        }
    }
    /// The range in which nobody has anything to hear.
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
