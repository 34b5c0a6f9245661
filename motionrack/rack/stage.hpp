// Linear stages of a rack: motor and scale of each, and the processors of the motion cards that close their loops.
//
//   card ──frames──► CardProcessor: loops, one an output ──NAME.voutN──► stage ──► scale ──► decoder
#pragma once

#include <array>
#include <memory>
#include <motionrack/cards/grating_bus/model/card.hpp>
#include <motionrack/cards/grating_bus/processor/profile.hpp>
#include <motionrack/cards/grating_bus/processor/servo_loop.hpp>
#include <motionrack/rack/config.hpp>
#include <motionrack/sim/parts/linear_scale.hpp>
#include <motionrack/sim/parts/linear_stage.hpp>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace motionrack::rack {

/// Set point of a stage as a function of time, from its servo's keys.
class StageSetup {
  public:
    StageSetup() = default;
    /// The servo must be valid (see stage_flaw).
    explicit StageSetup(const RackStage& stage);
    grating_bus::Setpoint at(double seconds) const;
    /// Position before the profile begins.
    double start_nm() const { return at(-1).position_nm; }
    /// Time allowed for decelerating to standstill along the profile. It is twice the duration of a ramp from maximum
    /// velocity, since the profile may be on a ramp already.
    double braking_s() const { return 2 * limits_.speed_nm_s / limits_.accel_nm_s2; }

  private:
    grating_bus::MotionLimits limits_;
    std::variant<grating_bus::HoldProfile, grating_bus::ScanProfile, grating_bus::StepProfile> profile_;
    double delay_s_ = 0;
};

/// Conditions reported by a processor; a: output number, b: following error in nm.
enum class LoopCondition : std::uint16_t { stale = 1, too_far = 2 };

/// Control loops of one card. Each frame yields the voltages of its outputs, after a delay; without a frame for two
/// periods: 0 V. Time follows the frames' sequence, since a card has no clock other than the pulses that it counts.
///
/// A stop slows profile time down to standstill. Every stage decelerates along its own profile, and none jumps when
/// profile time continues:
///
///   rate of profile time      1 ‾‾‾\          /‾‾‾
///                             0     \________/          stop()      go_on()
class CardProcessor final : public sim::Device, private grating_bus::FrameListener {
  public:
    CardProcessor(sim::Kernel& kernel, const std::string& name, grating_bus::Card& card);

    /// Call before the kernel starts. `count`: present count of the scale. The loop is closed from the first frame.
    void add(int output, const StageSetup& plan, const grating_bus::ServoSettings& settings, Duration compute,
             std::int64_t count);
    grating_bus::ServoLoop& loop(int output) { return state_.loops[static_cast<std::size_t>(output)]; }
    sim::DeviceId id() const { return id_; }
    const StageSetup& plan(int output) const { return plans_[static_cast<std::size_t>(output)]; }

    // ---- between runs
    /// Stops its stages; `power_off`: opens their loops afterwards, 0 V.
    void stop(bool power_off);
    /// Resumes all stages. Closes loops opened by stop() again, at `count` of the output's scale.
    void go_on(const std::array<std::int64_t, grating_bus::output_count>& count);
    /// Returns true if all stages are at standstill or not driven.
    bool stopped() const { return state_.rate == 0; }

    void on_scheduled(Instant now) override;
    std::span<std::byte> state() override { return sim::bytes_of(state_); }

  private:
    struct State {
        std::array<grating_bus::ServoLoop, grating_bus::output_count> loops;
        std::array<Instant, grating_bus::output_count> put_out{never, never, never, never};
        Instant stale_at{};
        double rate = 1;      ///< rate of profile time, 0 .. 1
        double behind_s = 0;  ///< delay of profile time behind frame time
        std::int32_t stopping = 0, power_off = 0;
        std::int64_t sequence = -1;  ///< sequence of the last frame
    };

    double advance(const grating_bus::Frame& frame, double period);
    void published(const grating_bus::Card& card, const grating_bus::Frame& frame, Instant now) override;
    /// Reports that output `n` no longer has a closed loop.
    void report_open(std::size_t n);
    void schedule();

    sim::Kernel& kernel_;
    grating_bus::Card& card_;
    sim::DeviceId id_{};
    std::array<StageSetup, grating_bus::output_count> plans_{};
    std::array<Duration, grating_bus::output_count> compute_{};
    std::array<bool, grating_bus::output_count> used_{};
    double braking_s_ = 0;  ///< longest braking time of the stages
    State state_{};
};

/// One stage of the running machine.
struct RunningStage {
    RackStage config;
    std::unique_ptr<parts::LinearStage> motor;
    std::unique_ptr<parts::LinearScale> scale;
    CardProcessor* processor = nullptr;  ///< nullptr: no closed loop

    /// Returns nullptr if the loop is not closed by a processor.
    grating_bus::ServoLoop* loop() const {
        return processor ? &processor->loop(static_cast<int>(config.output)) : nullptr;
    }
    /// Returns the set point; meaningless without a loop.
    grating_bus::Setpoint wanted(double seconds) const {
        return processor->plan(static_cast<int>(config.output)).at(seconds);
    }
};

parts::LinearStageSettings motor_settings(const RackStage& stage);
parts::LinearScaleSettings scale_settings(const RackStage& stage);
/// Returns the loop settings of a driven stage; gains missing in the rack file follow from the bandwidth.
grating_bus::ServoSettings loop_settings(const RackStage& stage);
/// Resumes the stage and all others of its card after a stop. `all`: the stages of the rack.
void go_on(const RunningStage& stage, std::span<const RunningStage> all, Instant now);
/// Returns "stage step_x: at 0.1 s its loop was opened ...". `stage`: the stage at the output.
std::string describe_loop(const sim::Condition& condition, const RackStage& stage);
/// Returns a sentence on why a stage's profile is infeasible; empty if feasible.
std::string profile_flaw(const RackStage& stage);

}  // namespace motionrack::rack
