// One axis of the card as the controller sees it, in mm (degrees) and seconds: moves, jog, homing.
//
//   control::Axis ──► SingleAxis ──► RealAxis (moves), Manual (jog), Home ──► Driver
#pragma once

#include <motionrack/cards/mcx314/driver/home.hpp>
#include <motionrack/cards/mcx314/driver/manual.hpp>
#include <motionrack/cards/mcx314/driver/real_axis.hpp>
#include <motionrack/control/axis.hpp>
#include <motionrack/control/limits.hpp>
#include <string>

namespace motionrack::mcx314 {

struct SingleAxisSettings {
    std::string name = "X";  ///< name in messages
    std::string unit = "mm";
    int channel = 0;  ///< 0 X .. 3 U
    control::AxisLimits limits;
    double counts_per_unit = 0;         ///< encoder; 0: not present
    std::int64_t pulses_per_turn = 0;   ///< pulses per motor revolution, for the index; 0: unknown
    Duration hold = milliseconds(250);  ///< a jog ends after this time without renewal
};

class SingleAxis final : public control::Axis {
  public:
    /// Initialises the whole chip: reset, pulse and direction, limit switches that act Low and decelerate.
    static Result<void> prepare(Driver& driver);
    /// The driver must be prepared, and must outlive this object.
    SingleAxis(Driver& driver, const SingleAxisSettings& settings);

    /// Sets the counters to 0 and disables the software limits: the position is invalid.
    Result<void> set_up();
    /// Restores the counters to their values before the chip was reset; call after set_up().
    Result<void> go_on(std::int64_t pulses, std::int64_t counts, bool valid);

    Result<void> move_to(double position, double speed) override;
    Result<void> move_by(double distance, double speed) override;
    Result<void> jog(double speed, Instant now) override;
    Result<void> home(const control::HomingRequest& order, Instant now) override;
    Result<void> set_position(double position) override;
    void stop() override;
    void stop_now() override;
    void step(Instant now) override;
    Result<void> wait(Duration timeout) override;
    control::AxisState state() override;
    bool position_valid() const override { return position_valid_; }
    double position() override { return real_.position(); }
    double measured_position() override { return real_.encoder_position(); }
    std::string_view home_state() const override { return home_.state(); }
    control::HomingResult home_outcome() const override;

    int channel() const { return settings_.channel; }
    /// Returns the register settings of a homing request. Errors: as home().
    Result<HomeSettings> home_settings(const control::HomingRequest& order) const;

  private:
    unsigned mask() const { return 1u << settings_.channel; }
    tl::unexpected<Error> refuse(const char* what, const std::string& why) const;
    Result<void> check_speed(const char* what, double speed) const;
    Result<void> check_free(const char* what);
    Result<void> check_into_limit(const char* what, bool negative);
    Result<void> begin_move(double distance, double speed);
    ManualTravel travel() const;
    Result<void> check_travel(double speed);
    void set_position_valid(bool on);
    void note_end();
    RealDrive drive_at(double speed, bool with_jerk) const;
    bool busy() { return driver_.moving(mask()) || home_.running() || manual_.state() != ManualState::standing; }

    Driver& driver_;
    SingleAxisSettings settings_;
    RealAxis real_;
    Home home_;
    Manual manual_;
    bool position_valid_ = false;
    bool moving_ = false;  ///< own move whose end has not been evaluated
    bool jogged_ = false;  ///< the last motion was a jog
    bool stopping_ = false;
};

}  // namespace motionrack::mcx314
