// One axis of the card in mm (degrees) and s.
//
//   RealAxis x(driver, 0, {200});                      // 200 pulses per mm
//   auto set = x.set({100, 2, 500});                   // mm/s, mm/s, mm/s2: *set contains the rounded values
//   auto plan = x.plan(50);                            // duration, acceleration distance, ..: no motion
//   auto moved = x.move(50);                           // 50 mm; *moved contains the rounding
#pragma once

#include <motionrack/cards/mcx314/driver/driver.hpp>
#include <motionrack/cards/mcx314/driver/units.hpp>

namespace motionrack::mcx314 {

class RealAxis {
  public:
    /// `axis`: channel 0 X .. 3 U; `encoder`: counts per unit, if present. The driver must outlive this object.
    RealAxis(Driver& driver, int axis, Scale scale, Scale encoder = {0})
        : driver_(driver), axis_(axis), scale_(scale), encoder_(encoder) {}

    /// Selects R and writes R, SV, V, A, D, K for the next moves. Refused while the axis drives.
    Result<RealSetting> set(const RealDrive& drive);
    const RealSetting& setting() const { return setting_; }

    /// Returns the plan of a move. Errors: refused if set() has not succeeded before.
    Result<RealPlan> plan(double distance) const;
    /// Starts a move by a distance, or to a position. S-curve if a jerk is set; the point of an asymmetric deceleration
    /// is computed. Returns the rounded distance.
    Result<Rounded> move(double distance);
    Result<Rounded> move_to(double position);
    /// Starts a continuous drive, until stopped.
    Result<void> run(bool negative);
    /// Changes the speed of the present drive, at most to the reach of R; see Driver::change_speed.
    Result<Rounded> change_speed(double speed);
    /// Changes the end of the present move: a distance from its start; see Driver::change_pulses.
    Result<Rounded> change_distance(double distance);

    double position() { return static_cast<double>(driver_.ReadLPS(axis_)) / scale_.pulses_per_unit; }
    /// Returns the position by the encoder; 0 without one.
    double encoder_position() {
        return encoder_.pulses_per_unit > 0 ? static_cast<double>(driver_.ReadEPS(axis_)) / encoder_.pulses_per_unit
                                            : 0;
    }
    /// Sets the counter LP to `position`, to the nearest pulse.
    Result<Rounded> set_position(double position);
    /// Returns the velocity, units/s, signed; also in an interpolation.
    Result<double> speed();

  private:
    Result<void> check_set(const char* who) const;
    Result<CurveData> curve(std::int64_t pulses) const;

    Driver& driver_;
    int axis_;
    Scale scale_, encoder_;
    RealSetting setting_;
    bool set_ = false;
};

}  // namespace motionrack::mcx314
