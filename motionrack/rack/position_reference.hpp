// Where a rack's controller has its axes, between programs and homings: an axis was at its reference, and its pulses
// lead on from there, by whatever order. Of a servo it is what its motor turns.
//
//   rack file ──start──┐
//   home ──position────┴─► reference ──pulses since──► where a program begins
//                              ▲
//   steps lost, home not found ┴─► lost: no program begins until the axis is homed
//
// Hosts may write what they like into the counters of a card: nothing here goes by them.
#pragma once

#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/base/time.hpp>
#include <motionrack/control/move.hpp>
#include <motionrack/rack/trust.hpp>
#include <string>
#include <vector>

namespace motionrack::rack {

class PositionReference {
  public:
    /// Every axis stands where the rack's file says. The rack must outlive this.
    explicit PositionReference(Rack& rack) : rack_(rack), axes_(rack.axes().size()) {}

    /// Where they stand, mm or degrees by their index 0 .. 5: on whole pulses once there were some.
    control::Point position() const;
    /// mm or degrees where the counts of an axis are 0: that of its pulses, and that of its rotor. `axis`: of
    /// Rack::axes().
    double commanded_origin(std::size_t axis) const;
    double real_origin(std::size_t axis) const;
    /// Pulses that an axis had lost when it got its reference; they do not matter any more.
    std::int64_t lost_before(std::size_t axis) const { return axes_[axis].lost_pulses; }

    /// It was homed; `from`: what was lost until then.
    void set(std::size_t axis, double position, const TrustWatch::Mark& from);
    /// Its position means no place any more. `why`: without a full stop; the first one stays.
    void lose(std::size_t axis, std::string why);
    /// A watch that was begun now looks no farther back than the references.
    void begin(TrustWatch& watch) const;
    /// Errors: refused, an axis moves, or does not know where it is; nothing may be begun.
    Result<void> check() const;
    /// Those of the same rack in another world.
    void copy_from(const PositionReference& other) { axes_ = other.axes_; }

  private:
    struct Reference {
        bool homed = false;   ///< else: where the file says, both counts 0
        double position = 0;  ///< of the commanded count
        std::int64_t commanded = 0;
        std::int64_t lost_pulses = 0;
        Instant at{};
        std::string lost;  ///< why; empty: it is not
        Instant lost_at{};
    };
    std::int64_t commanded(std::size_t axis) const;
    double reference_position(std::size_t axis) const;

    Rack& rack_;
    std::vector<Reference> axes_;
};

}  // namespace motionrack::rack
