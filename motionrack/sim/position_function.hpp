// A position as a function of time, in whole counts: the pulses of a card or the lines of an encoder.
//
// No component is clocked; the owner computes its position on request. It notifies a listener when the count leaves a
// watched range, and generates single edges, in batches, only for a listener:
//
//     owner --count(t), rate(t)--> any caller
//           --crossed(now)-------> the listener whose range was left (at the very instant of the edge)
//           --rate_changed(now)--> listeners, when the motion's law changes (a velocity step, a new segment, a stop)
//           --edges(batch)-------> edge listener, in order, before the law changes and at Kernel sync
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <motionrack/base/time.hpp>

namespace motionrack::sim {

/// Consecutive edges of one direction: edge i is at origin + at[i] * tick.
struct EdgeBatch {
    static constexpr std::size_t capacity = 2048;
    Instant origin{};
    Duration tick{};
    std::int64_t first_count = 0;  ///< the count after edge 0
    int step = 1;                  ///< +1 or -1: change of the count per edge
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
    /// The count left the range given to PositionFunction::watch; the listener must set a new one.
    virtual void crossed(Instant now) = 0;
    /// The law of motion changed: the rate was `before` just before this instant (along a curve it also changes between
    /// laws) and is `rate` from now on; counts/s, signed.
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
    /// Mean rate of the present law at `t`, counts/s, signed.
    virtual double rate(Instant t) const = 0;
    /// Calls listener `slot` (crossed) as soon as count <= below or count >= above; if that is already true, at the
    /// next instant.
    virtual void watch(int slot, std::int64_t below, std::int64_t above) = 0;
    /// Adds a listener before the kernel starts; returns its slot (at most max_listeners).
    virtual int add_listener(PositionListener& listener) = 0;
    /// Before the start: also calls rate_changed when |rate| passes `rate` (counts/s, >= 0) along a curve; at most
    /// max_listeners rates. Not needed for rates that change in steps.
    virtual void watch_rate(double rate) { (void)rate; }
    /// Generates and delivers edges from the owner's present instant on; nullptr: none.
    virtual void set_edge_listener(EdgeListener* listener) = 0;
    /// Delivers the edges up to the kernel's present instant now, if there is a listener.
    virtual void deliver_edges() = 0;

    static constexpr int max_listeners = 6;
};

}  // namespace motionrack::sim
