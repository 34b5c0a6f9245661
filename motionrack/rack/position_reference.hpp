// Position reference of a rack's axes, between programs and homings. An axis has a reference position, and its pulses
// since then give its present position. For a servo, the rotation of its motor replaces the pulses.
//
//   rack file ──start──┐
//   home ──position────┴─► reference ──pulses since──► start of a program
//                              ▲
//   step loss, homing failed ──┴─► lost: no program starts until the axis is homed
//
// Hosts may write any value into the counters of a card; the reference does not use them.
#pragma once

#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/base/time.hpp>
#include <motionrack/control/move.hpp>
#include <motionrack/rack/validity_watch.hpp>
#include <string>
#include <vector>

namespace motionrack::rack {

class PositionReference {
  public:
    /// Sets every axis to the rack file's initial position. The rack must outlive this.
    explicit PositionReference(Rack& rack) : rack_(rack), axes_(rack.axes().size()) {}

    /// Positions in mm or degrees by index 0 .. 5; on whole pulses after the first pulse.
    control::Point position() const;
    /// Position of count 0 of an axis, mm or degrees: of its pulses, and of its rotor. `axis`: index in Rack::axes().
    double commanded_origin(std::size_t axis) const;
    double real_origin(std::size_t axis) const;
    /// Step loss of an axis up to its reference, in pulses; already accounted for.
    std::int64_t lost_before(std::size_t axis) const { return axes_[axis].lost_pulses; }

    /// Sets the reference of a homed axis; `from`: its step loss up to then.
    void set(std::size_t axis, double position, const ValidityWatch::Mark& from);
    /// Invalidates the position. `why`: reason without a full stop; the first one is kept.
    void lose(std::size_t axis, std::string why);
    /// Limits a watch that begins now to events after the references.
    void begin(ValidityWatch& watch) const;
    /// Errors: refused if an axis moves or its position is not valid; nothing may start then.
    Result<void> check() const;
    /// Copies the references of the same rack in another simulation.
    void copy_from(const PositionReference& other) { axes_ = other.axes_; }

  private:
    struct Reference {
        bool homed = false;   ///< false: position from the file, both counts 0
        double position = 0;  ///< position of the commanded count
        std::int64_t commanded = 0;
        std::int64_t lost_pulses = 0;
        Instant at{};
        std::string lost;  ///< reason for the loss; empty: valid
        Instant lost_at{};
    };
    std::int64_t commanded(std::size_t axis) const;
    double reference_position(std::size_t axis) const;

    Rack& rack_;
    std::vector<Reference> axes_;
};

}  // namespace motionrack::rack
