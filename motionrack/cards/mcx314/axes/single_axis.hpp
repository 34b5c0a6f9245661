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
    std::string name = "X";  ///< for sentences
    std::string unit = "mm";
    int channel = 0;  ///< 0 X .. 3 U
    control::AxisLimits limits;
    double counts_per_unit = 0;         ///< encoder; 0: none
    std::int64_t pulses_per_turn = 0;   ///< of the motor, for the index; 0: not known
    Duration hold = milliseconds(250);  ///< of a jog that is not renewed
};

class SingleAxis final : public control::Axis {
  public:
    /// The whole chip, once: reset, pulse and direction, limit switches that act Low and slow down.
    static Result<void> prepare(Driver& driver);
    /// The driver must outlive this and be prepared.
    SingleAxis(Driver& driver, const SingleAxisSettings& settings);

    /// Counters 0, software limits off: the position is not trusted.
    Result<void> set_up();
    /// After set_up(): the counters go on from what they were before the chip was reset.
    Result<void> go_on(std::int64_t pulses, std::int64_t counts, bool trusted);

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
    bool position_valid() const override { return trusted_; }
    double position() override { return real_.position(); }
    double measured_position() override { return real_.encoder_position(); }
    std::string_view home_state() const override { return home_.state(); }
    control::HomingResult home_outcome() const override;

    int channel() const { return settings_.channel; }
    /// What an order becomes in registers. Errors: as home().
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
    void trust(bool on);
    void note_end();
    RealDrive drive_at(double speed, bool with_jerk) const;
    bool busy() { return driver_.moving(mask()) || home_.running() || manual_.state() != ManualState::standing; }

    Driver& driver_;
    SingleAxisSettings settings_;
    RealAxis real_;
    Home home_;
    Manual manual_;
    bool trusted_ = false;
    bool moving_ = false;  ///< a move of ours, until its end was looked at
    bool jogged_ = false;  ///< last, and nothing since
    bool stopping_ = false;
};

}  // namespace motionrack::mcx314
