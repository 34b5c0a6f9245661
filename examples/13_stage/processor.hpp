// What runs on one motion card's processor: the loops of its axes, once a frame.
//
//   card ──published──► loops ──compute──► voltages on the drive wires          two periods without a frame: 0 V
//
// Its time is the frame's sequence: a card knows no clock but the pulses that it counts.
#pragma once

#include <cmath>
#include <functional>
#include <motionrack/cards/grating_bus/model/card.hpp>
#include <motionrack/cards/grating_bus/processor/servo_loop.hpp>
#include <motionrack/sim/kernel.hpp>
#include <string>
#include <utility>
#include <vector>

namespace stage {

using namespace motionrack;

/// Where an axis is to be at `seconds`.
using Plan = std::function<grating_bus::Setpoint(double seconds)>;

struct Axis {
    grating_bus::ServoLoop loop;
    Plan plan;
    sim::WireId drive;
};

class Processor final : public sim::Device, private grating_bus::FrameListener {
  public:
    /// `compute`: from the frame to the voltages, less than a period.
    Processor(sim::Kernel& kernel, const std::string& name, grating_bus::Card& card, std::vector<Axis> axes, Duration compute)
        : kernel_(kernel),
          period_(card.settings().period),
          compute_(compute),
          axes_(std::move(axes)),
          id_(kernel.add(*this, sim::Phase::cards, name)),
          stale_at_(card.settings().offset + 2 * period_) {
        card.add_listener(*this);
        kernel.schedule(id_, stale_at_);
    }

    std::vector<Axis>& axes() { return axes_; }

    void act(Instant now) override {
        if (now >= stale_at_) {
            for (Axis& axis : axes_) axis.loop.on_stale();
            stale_at_ = never;
        }
        for (const Axis& axis : axes_) kernel_.set_wire(axis.drive, static_cast<int>(std::floor(axis.loop.volts() * 1e6 + 0.5)));
        kernel_.schedule(id_, stale_at_);
    }

  private:
    void published(const grating_bus::Card&, const grating_bus::Frame& frame, Instant now) override {
        const double period = to_seconds(period_), seconds = frame.sequence * period;
        for (Axis& axis : axes_) {
            grating_bus::Setpoint wanted = axis.plan(seconds);
            wanted.accel_nm_s2 = axis.plan(seconds + period / 2).accel_nm_s2;
            axis.loop.on_frame(frame, wanted);
        }
        stale_at_ = now + 2 * period_;
        kernel_.schedule(id_, now + compute_);
    }

    sim::Kernel& kernel_;
    Duration period_;
    Duration compute_;
    std::vector<Axis> axes_;
    sim::DeviceId id_;
    Instant stale_at_;
};

}  // namespace stage
