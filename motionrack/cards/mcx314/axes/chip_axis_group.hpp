// The chip's axes as the controller sees them: executes planned moves by continuous interpolation, and rewrites the
// speed at each junction.
//
//   chip  |== segment 1 ==|== segment 2 ==|== segment 3 ==|
//   host   ^start 1, queue 2 ^INT: V of 2, queue 3 ^INT: V of 3, queue 4
//
// If the next segment is late, the chip stops at once and starts it from standstill; the delay is reported.
//
// An auxiliary axis that moves with three others runs on its own generator. At each junction the host reads its counter
// and writes the speed that brings it to its position at the segment's end. The chip counts its last pulse, so its end
// is exact.
#pragma once

#include <motionrack/cards/mcx314/axes/path_rule.hpp>
#include <motionrack/cards/mcx314/axes/segmenter.hpp>
#include <motionrack/cards/mcx314/driver/driver.hpp>
#include <motionrack/control/axis_group.hpp>
#include <optional>

namespace motionrack::mcx314 {

class ChipAxisGroup final : public control::AxisGroup {
  public:
    /// Fraction of each axis' acceleration that the planner must reserve, because the chip's speeds and accelerations
    /// are whole numbers.
    static constexpr double accel_reserve = 0.03;

    /// The driver must outlive this object.
    ChipAxisGroup(Driver& driver, const AxisMap& map, const HostTimes& host);

    /// Resets and initialises the chip: pulse and direction, limit switches active low with decelerating stop, software
    /// limits at the travel, encoders x4, positions as given (mm, degrees).
    Result<void> set_up(const control::Point& position);

    Result<void> begin() override;
    Result<void> follow(const control::PlannedMove& move) override;
    Result<void> finish() override;
    const control::DriveConstraints* drive_constraints() const override { return &rule_; }
    /// Sets the channels (one bit each) with a touch probe at IN3, which is High while it touches; MCX314As only.
    /// Initially 0: no probe.
    void set_probe(unsigned channels) { probe_channels_ = channels; }
    Result<control::ProbeResult> probe(const control::PlannedMove& move, bool release) override;
    void stop(bool immediate) override;
    control::Point commanded_position() override;
    std::vector<control::PathWarning> take_path_warnings() override;
    std::vector<control::MoveStart> take_move_starts() override { return std::exchange(starts_, {}); }

    /// Returns the number of segments written to the chip since begin().
    std::int64_t segments() const { return segments_; }

  private:
    Result<void> check_probe(bool release);
    Result<void> arm_probe(bool release);
    Result<void> disarm_probe();
    void go_on_from_here();
    bool probe_hit();
    bool stopped_by_other();
    Result<void> play_ready(std::size_t keep);
    Result<void> play(const Segment& segment);
    Result<void> play_pause(const Segment& segment);
    Result<void> start_chain(const Segment& segment);
    Result<void> queue(const Segment& segment);
    Result<void> restart_late(const Segment& segment);
    Result<void> accelerate_late(const Segment& segment);
    Result<void> wait_for_junction(const Segment& queued);
    Result<void> decelerate();
    Result<void> wait_for_standstill();
    Result<void> write_speed(const Segment& segment);
    Result<void> write_acceleration(std::int32_t acceleration);
    Result<void> command(const Segment& segment);
    Result<void> begin_segment(const Segment& segment);
    Result<void> wait_until_all_stand();
    Result<void> take_auxiliary(int channel, std::int64_t at);
    Result<void> update_auxiliary_velocity(const Segment& segment);
    Result<void> steer_evenly(const Segment& segment, bool driving, std::int64_t at);
    std::int32_t auxiliary_speed(double v) const;
    Result<void> drive_auxiliary(std::int64_t from, std::int64_t to, std::int32_t v, bool brakes = true);
    Result<void> finish_auxiliary();
    std::int64_t auxiliary_fall_from(std::int64_t pulses, std::int32_t v) const;
    tl::unexpected<Error> stopped_by_machine();
    tl::unexpected<Error> stopped_by_user();
    void clear_interrupts();

    Driver& driver_;
    AxisMap map_;
    HostTimes host_;
    PathRule rule_;
    std::int32_t range_;
    std::optional<Segmenter> segmenter_;
    std::vector<control::MoveStart> starts_;
    std::vector<control::PathWarning> notes_;
    Pulses4 expected_ = {};  ///< counters after all segments written so far
    std::int32_t last_block_ = -2;
    std::int32_t current_line_ = 0;
    std::int32_t written_speed_ = 0;
    std::int32_t written_acceleration_ = 0;
    std::int32_t braking_acceleration_ = 1;  ///< A of the running segment for a requested stop
    int generator_ = 0;
    unsigned prepared_ = 0;        ///< channels that may drive the running chain; see prepare_to_drive
    unsigned chain_axes_ = 0;      ///< channels of the running chain's segments so far
    std::int32_t rest_speed_ = 1;  ///< V from which the running segment may stop at once
    bool s_curve_ = false;         ///< the running chain is an S-curve
    bool even_ = false;            ///< the running chain changes its speed linearly
    bool braking_ = false;         ///< stop requested
    bool catches_up_ = false;      ///< began from standstill in the middle of a path: slower than planned
    bool chain_running_ = false;
    std::int64_t segments_ = 0;
    bool ran_alone_ = false;    ///< the queued segment ended before the host saw its start
    Instant runs_until_{};      ///< estimated end of the running segment
    double running_speed_ = 1;  ///< V at the end of the running segment
    unsigned probe_channels_ = 0;
    bool probing_ = false;
    std::array<std::int32_t, channel_count> saved_before_ = {};  ///< BR when the probe was armed
    // The auxiliary's present drive.
    int auxiliary_ = -1;
    std::int32_t auxiliary_start_speed_ = 1;  ///< SV, A and the maximum V of its drive
    std::int32_t auxiliary_acceleration_ = 1;
    std::int32_t auxiliary_top_speed_ = 1;
    bool auxiliary_negative_ = false;
    std::int64_t auxiliary_from_ = 0;       ///< its counter at the start of the drive
    std::int64_t auxiliary_target_ = 0;     ///< its target at the end of the present segment
    std::int64_t auxiliary_brakes_at_ = 0;  ///< pulse of the drive at which deceleration begins
};

}  // namespace motionrack::mcx314
