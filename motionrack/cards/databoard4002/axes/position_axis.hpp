// The card's axis as the controller sees it: commands in mm (degrees) and seconds become commands of the card.
//
//   move_to ─► O, R, P, G ─► slope of the table ─► "position reached" ─► standstill ─► D, L if it is to be locked
//   stop    ─► R, R, R .. Q      the rate is lowered by the axis' acceleration, then the output is 0
//
// The card counts the encoder, so its position stays valid whatever stops the axis. The position becomes invalid if the
// card loses its memory (a reset, its watchdog), or if the counts do not follow the drive. In that case the motor or
// the encoder has failed. The card does not supervise this and would drive on without end.
#pragma once

#include <motionrack/cards/databoard4002/axes/home_search.hpp>
#include <motionrack/cards/databoard4002/driver/driver.hpp>
#include <motionrack/cards/databoard4002/driver/slope.hpp>
#include <motionrack/control/axis.hpp>
#include <motionrack/control/limits.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace motionrack::databoard4002 {

struct PositionAxisSettings {
    std::string name = "X";
    std::string_view unit = "mm";
    control::AxisLimits
        limits;  ///< max_accel applies to both ramps, max_velocity_step is the creep velocity at their ends
    double counts_per_unit = 100;           ///< scale of the card's counter, > 0
    SpeedScale scale;                       ///< counts/s at a rate
    double lag_s = 0;                       ///< s, >= 0: time constant of the motor with its load
    std::optional<double> position_window;  ///< mm or degrees: in-position window of the card's position lock after a
                                            ///< move; absent: no lock
    Duration settle = milliseconds(20);     ///< the axis is at standstill after this time without a count
    Duration hold = milliseconds(250);      ///< a jog ends after this time without renewal
};

class PositionAxis final : public control::Axis {
  public:
    PositionAxis(Driver& driver, Interrupt& host, const PositionAxisSettings& settings);

    /// Connects to the card and loads the slope table for the axis limits. Errors: those of Driver::connect and of
    /// design_slope.
    Result<void> set_up();

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
    double position() override;
    double measured_position() override { return position(); }
    /// Returns the position at which the card's counter is 0, mm or degrees.
    double counter_origin() const { return offset_; }
    std::string_view home_state() const override { return search_.state_name(); }
    control::HomingResult home_outcome() const override { return search_.outcome(); }

    const SlopeTable& table() const { return table_; }

  private:
    enum class Doing : std::uint8_t { nothing, moving, jogging, stopping, settling };

    bool busy() const { return doing_ != Doing::nothing || search_.running(); }
    tl::unexpected<Error> refuse(const char* what, const std::string& why) const;
    Result<int> rate_of(const char* what, double speed) const;
    Result<void> check_free(const char* what, bool forward);
    Result<void> begin(const char* what, std::int64_t counts, int rate, bool forward);
    Result<void> begin_jog(double speed, Instant now);
    void jog_on(Instant now);
    bool stop_search();
    void ramp_down(Instant now);
    void look_at_events(Instant now);
    void look_at_stop();
    void look_at_progress(Instant now);
    void settle(Instant now);
    void rest(Instant now);
    void end_with(Error error, bool counted = false);
    Result<std::int64_t> counts();

    Driver& driver_;
    Interrupt& host_;
    PositionAxisSettings settings_;
    SlopeTable table_;
    HomeSearch search_;
    double offset_ = 0;  // the position where the counter is 0
    std::int64_t last_counts_ = 0;
    bool position_valid_ = false;
    bool unanswered_ = false;  // the card may have been reset since set_up()
    Instant set_up_at_{};
    bool forward_ = true;
    bool hold_after_ = false;  // a move (not a stop) that ends with the position lock
    Doing doing_ = Doing::nothing;
    double speed_ = 0;     // present velocity of a jog or a ramp, counts/s
    double wanted_ = 0;    // target velocity, counts/s
    double next_jog_ = 0;  // velocity after the stop, with its sign
    Instant at_{};         // instant of the last rate change
    Instant renewed_{};    // instant of the last jog renewal
    Instant still_since_{};
    Instant stop_seen_ = never;       // instant at which the contacts of a stop have settled
    Instant progress_due_ = never;    // deadline by which the counts must have advanced
    Duration progress_time_{};        // between two progress checks
    std::int64_t progress_from_ = 0;  // the counts at the last check
    std::optional<Error> error_;
};

}  // namespace motionrack::databoard4002
