// A position as a function of time, in whole counts: what a card says of its pulses and an encoder of its lines.
//
// Nobody ticks. The owner answers "where at t?", tells when the count leaves a watched range, and, only while somebody
// listens, makes the single edges, in batches:
//
//     owner --count(t), rate(t)--> anyone
//           --crossed(now)-------> the listener whose range was left (at the very instant of the edge)
//           --rate_changed(now)--> listeners, when the motion's law changes (a speed step, a new segment, a stop)
//           --edges(batch)-------> edge listeners, in order, before the law changes and at Kernel sync
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <motionrack/base/time.hpp>

namespace motionrack::sim {

/// Some edges in order, all of one direction: edge i is at origin + at[i] * tick.
struct EdgeBatch {
    static constexpr std::size_t capacity = 2048;
    Instant origin{};
    Duration tick{};
    std::int64_t first_count = 0;  ///< the count after edge 0
    int step = 1;                  ///< +1 or -1: what each edge does to the count
    std::uint32_t size = 0;
    std::array<std::uint32_t, capacity> at;
};

class EdgeListener {
  public:
    virtual ~EdgeListener() = default;
    virtual void edges(const EdgeBatch& batch) = 0;
};

class PositionListener {
  public:
    virtual ~PositionListener() = default;
    /// The count left the range given to Motion::watch; the listener must set a new one.
    virtual void crossed(Instant now) = 0;
    /// The law of motion changed: the rate was `before` just before this instant (along a curve it changes between laws
    /// too) and is `rate` from now on; counts a second, signed.
    virtual void rate_changed(double before, double rate, Instant now) = 0;
};

/// No bound in that direction.
inline constexpr std::int64_t unwatched_below = std::numeric_limits<std::int64_t>::min();
inline constexpr std::int64_t unwatched_above = std::numeric_limits<std::int64_t>::max();

class PositionFunction {
  public:
    virtual ~PositionFunction() = default;
    /// The count at `t`: not before the last event of the owner, not after the present instant of the kernel.
    virtual std::int64_t count(Instant t) const = 0;
    /// Mean rate of the present law at `t`, counts a second, signed.
    virtual double rate(Instant t) const = 0;
    /// Calls listener `slot` (crossed) as soon as count <= below or count >= above; at once if that is so already (at
    /// the next instant).
    virtual void watch(int slot, std::int64_t below, std::int64_t above) = 0;
    /// Adds a listener before the kernel starts; returns its slot (at most max_listeners).
    virtual int add_listener(PositionListener& listener) = 0;
    /// Before the start: listeners are also to hear rate_changed when |rate| passes `rate` (counts a second, >= 0)
    /// along a curve; at most max_listeners marks. A motion whose rate changes in steps has nothing to do for it.
    virtual void watch_rate(double rate) { (void)rate; }
    /// From now on (the owner's present instant) edges are made and handed over; nullptr: nobody listens.
    virtual void set_edge_listener(EdgeListener* listener) = 0;
    /// Hands over the edges up to the kernel's present instant now, if somebody listens.
    virtual void deliver_edges() = 0;

    static constexpr int max_listeners = 6;
};

}  // namespace motionrack::sim
