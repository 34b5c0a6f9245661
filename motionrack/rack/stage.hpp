// The linear stages of a rack: motor and scale of each, and what runs on the processors of the motion cards that close
// their loops.
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

/// Where a stage is to be, as its servo's keys say.
class StageSetup {
  public:
    StageSetup() = default;
    /// The servo must be sound (see stage_flaw).
    explicit StageSetup(const RackStage& stage);
    grating_bus::Setpoint at(double seconds) const;
    /// Where it is before it begins.
    double start_nm() const { return at(-1).position_nm; }
    /// In which it may be slowed to standstill along its own way: twice as long as a ramp from its greatest speed, for
    /// it may be in one.
    double braking_s() const { return 2 * limits_.speed_nm_s / limits_.accel_nm_s2; }

  private:
    grating_bus::MotionLimits limits_;
    std::variant<grating_bus::HoldProfile, grating_bus::ScanProfile, grating_bus::StepProfile> profile_;
    double delay_s_ = 0;
};

/// What a processor reports; a: number of the output, b: the following error in nm.
enum class LoopCondition : std::uint16_t { stale = 1, too_far = 2 };

/// The loops of one card: at each frame the voltages for its outputs, some time later; two periods without a frame: 0
/// V. Its time is the frames' sequence, for a card knows no clock but the pulses that it counts.
///
/// A stop slows the plans' time down to standstill, so that every stage brakes on its own way, and none jumps when the
/// time goes on:
///
///   rate of the plans' time   1 ‾‾‾\          /‾‾‾
///                             0     \________/          stop()      go_on()
class CardProcessor final : public sim::Device, private grating_bus::FrameListener {
  public:
    CardProcessor(sim::Kernel& kernel, const std::string& name, grating_bus::Card& card);

    /// Before the kernel starts. `count`: of the scale, now. The loop is closed from the first frame on.
    void add(int output, const StageSetup& plan, const grating_bus::ServoSettings& settings, Duration compute,
             std::int64_t count);
    grating_bus::ServoLoop& loop(int output) { return state_.loops[static_cast<std::size_t>(output)]; }
    sim::DeviceId id() const { return id_; }
    const StageSetup& plan(int output) const { return plans_[static_cast<std::size_t>(output)]; }

    // ---- between runs
    /// Brings its stages to rest; `power_off`: their loops are opened then, 0 V.
    void stop(bool power_off);
    /// Loops that stop() has opened are closed again, at `count` of the output's scale; all go on from there.
    void go_on(const std::array<std::int64_t, grating_bus::output_count>& count);
    /// All stand, or are at least not driven.
    bool stopped() const { return state_.rate == 0; }

    void on_scheduled(Instant now) override;
    std::span<std::byte> state() override { return sim::bytes_of(state_); }

  private:
    struct State {
        std::array<grating_bus::ServoLoop, grating_bus::output_count> loops;
        std::array<Instant, grating_bus::output_count> put_out{never, never, never, never};
        Instant stale_at{};
        double rate = 1;      ///< of the plans' time, 0 .. 1
        double behind_s = 0;  ///< the plans' time, of the frames'
        std::int32_t stopping = 0, power_off = 0;
        std::int64_t sequence = -1;  ///< of the last frame
    };

    double advance(const grating_bus::Frame& frame, double period);
    void published(const grating_bus::Card& card, const grating_bus::Frame& frame, Instant now) override;
    /// Output `n` has no longer a closed loop.
    void report_open(std::size_t n);
    void schedule();

    sim::Kernel& kernel_;
    grating_bus::Card& card_;
    sim::DeviceId id_{};
    std::array<StageSetup, grating_bus::output_count> plans_{};
    std::array<Duration, grating_bus::output_count> compute_{};
    std::array<bool, grating_bus::output_count> used_{};
    double braking_s_ = 0;  ///< of its slowest stage
    State state_{};
};

/// One stage of the running machine.
struct RunningStage {
    RackStage config;
    std::unique_ptr<parts::LinearStage> motor;
    std::unique_ptr<parts::LinearScale> scale;
    CardProcessor* processor = nullptr;  ///< nullptr: nobody closes its loop

    /// nullptr if nobody closes it.
    grating_bus::ServoLoop* loop() const {
        return processor ? &processor->loop(static_cast<int>(config.output)) : nullptr;
    }
    /// Where it is to be; nothing sensible without a loop.
    grating_bus::Setpoint wanted(double seconds) const {
        return processor->plan(static_cast<int>(config.output)).at(seconds);
    }
};

parts::LinearStageSettings motor_settings(const RackStage& stage);
parts::LinearScaleSettings scale_settings(const RackStage& stage);
/// Of a card whose first scale is `first`.
grating_bus::ServoSettings loop_settings(const RackStage& stage);
/// "stage step_x: at 0.1 s its loop was opened ..." `stage`: the one at the output.
std::string describe_loop(const sim::Condition& condition, const RackStage& stage);
/// What of a stage's profile cannot be; empty if it can.
std::string profile_flaw(const RackStage& stage);

}  // namespace motionrack::rack
