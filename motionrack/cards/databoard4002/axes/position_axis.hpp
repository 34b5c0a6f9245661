// The card's axis as the controller sees it: orders in mm (degrees) and seconds become commands of the card.
//
//   move_to ─► O, R, P, G ─► slope of the table ─► "position reached" ─► comes to rest ─► D, L where it is to be held
//   stop    ─► R, R, R .. Q      the rate is lowered by the axis' acceleration, then the output is 0
//
// The card counts what the encoder says, so its position stays trusted whatever stops the axis; it is lost with the
// card's memory (a reset, its watchdog), and where the counts do not go on as the card drives: then motor or encoder do
// not do what they should, and the card, which has no watch for that, would drive on for ever.
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
    control::AxisLimits limits;    ///< max_accel is that of both ramps, start_speed the creep speed at their ends
    double counts_per_unit = 100;  ///< of the card's counter, > 0
    SpeedScale scale;              ///< counts a second at a rate
    double lag_s = 0;              ///< the motor's time constant, with its load
    std::optional<double>
        hold_window;  ///< mm or degrees: after a move the card keeps the axis within; absent: it lets go
    Duration settle = milliseconds(20);  ///< without a count: the axis stands
    Duration hold = milliseconds(250);   ///< of a jog that is not renewed
};

class PositionAxis final : public control::Axis {
  public:
    PositionAxis(Driver& driver, Interrupt& host, const PositionAxisSettings& settings);

    /// Looks for the card and gives it the slope table of the axis' limits. Errors: those of Driver::connect, of
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
    bool position_valid() const override { return trusted_; }
    double position() override;
    double measured_position() override { return position(); }
    /// The position where the card's counter is 0.
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
    bool trusted_ = false;
    bool unanswered_ = false;  // the card may have been reset since set_up()
    Instant set_up_at_{};
    bool forward_ = true;
    bool hold_after_ = false;  // a move, not a stop: it is to be held
    Doing doing_ = Doing::nothing;
    double speed_ = 0;     // counts/s that a jog or a ramp has now
    double wanted_ = 0;    // and is to have
    double next_jog_ = 0;  // after the stop, with its sign
    Instant at_{};         // of the last change of the rate
    Instant renewed_{};    // of the jog
    Instant still_since_{};
    Instant stop_seen_ = never;       // when the contacts of a stop are at rest
    Instant progress_due_ = never;    // when the counts must have gone on
    Duration progress_time_{};        // from look to look
    std::int64_t progress_from_ = 0;  // the counts at the last one
    std::optional<Error> error_;
};

}  // namespace motionrack::databoard4002
