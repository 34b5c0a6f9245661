// Builds stages from their settings, and processes frames.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/rack/stage.hpp>
#include <motionrack/rack/toml_reader.hpp>
#include <utility>

namespace motionrack::rack {

namespace gb = grating_bus;

namespace {

constexpr double nm_per_mm = 1e6;
/// Hold time after deceleration, before power is removed; without it the stage would drift with its remaining velocity.
constexpr Duration settles = milliseconds(50);

gb::MotionLimits limits_of(const RackStageServo& s) {
    return {s.max_velocity_mm_s * nm_per_mm, s.max_accel_mm_s2 * nm_per_mm, s.max_jerk_mm_s3 * nm_per_mm};
}

}  // namespace

// ---- settings

std::string profile_flaw(const RackStage& stage) {
    if (!stage.servo) return {};
    const RackStageServo& s = *stage.servo;
    if (s.profile == StageProfile::scan && !(s.from_mm < s.to_mm))
        return fmt::format("from_mm is {} and to_mm is {}; from_mm must be below to_mm.", number_text(s.from_mm),
                           number_text(s.to_mm));
    if (s.profile != StageProfile::steps) return {};
    if (s.step_mm == 0) return "step_mm is 0; it must be other than 0.";
    const double distance = std::fabs(s.step_mm) * nm_per_mm;
    const double move = gb::StepProfile(0, distance, 1, 1e9, limits_of(s)).move_s();
    if (move > s.step_period_ms * 1e-3)
        return fmt::format("A step of {} mm takes {:.3f} ms with these limits, but step_period_ms is {}.",
                           number_text(s.step_mm), move * 1e3, number_text(s.step_period_ms));
    return {};
}

StageSetup::StageSetup(const RackStage& stage) : profile_(gb::HoldProfile{stage.start_mm.value_or(0) * nm_per_mm}) {
    if (!stage.servo) return;
    const RackStageServo& s = *stage.servo;
    delay_s_ = s.delay_ms * 1e-3;
    limits_ = limits_of(s);
    if (s.profile == StageProfile::scan)
        profile_ = gb::ScanProfile(s.from_mm * nm_per_mm, s.to_mm * nm_per_mm, limits_);
    if (s.profile == StageProfile::steps)
        profile_ = gb::StepProfile(stage.start_mm.value_or(0) * nm_per_mm, s.step_mm * nm_per_mm,
                                   static_cast<int>(s.steps), s.step_period_ms * 1e-3, limits_);
}

gb::Setpoint StageSetup::at(double seconds) const {
    return std::visit([t = seconds - delay_s_](const auto& profile) { return profile.at(t); }, profile_);
}

parts::LinearStageSettings motor_settings(const RackStage& stage) {
    parts::LinearStageSettings out;
    out.accel_per_volt = stage.accel_per_volt_m_s2;
    out.current_limit_accel = stage.current_limit_accel_m_s2;
    out.saturation_velocity = stage.saturation_velocity_m_s;
    out.viscous_friction = stage.viscous_friction_per_s;
    out.coulomb_friction = stage.coulomb_friction_m_s2;
    out.load_mass_ratio = stage.load_mass_ratio;
    out.start_nm = stage.start_mm ? *stage.start_mm * nm_per_mm : StageSetup(stage).start_nm();
    out.hard_stop_minus_nm = stage.hard_stop_minus_mm * nm_per_mm;
    out.hard_stop_plus_nm = stage.hard_stop_plus_mm * nm_per_mm;
    return out;
}

parts::LinearScaleSettings scale_settings(const RackStage& stage) {
    const RackScale& s = stage.scale;
    parts::LinearScaleSettings out;
    out.pitch_pm = static_cast<std::int64_t>(std::floor(s.pitch_um * 1e6 + 0.5));
    out.interpolation = s.interpolation;
    out.reversed = s.reversed;
    out.zero_offset_nm = s.zero_offset_mm * nm_per_mm;
    out.max_count_rate = s.max_count_rate_mhz * 1e6;
    if (s.index_mm) out.index_nm = *s.index_mm * nm_per_mm;
    out.dirt_position_nm = s.dirt_position_mm * nm_per_mm;
    return out;
}

gb::ServoSettings loop_settings(const RackStage& stage) {
    const RackStageServo& s = *stage.servo;
    const double um = 1e-3;  // um per nm
    gb::ServoSettings out;
    out.scale = static_cast<std::uint64_t>(stage.input);
    out.nm_per_count =
        stage.scale.pitch_um * 1e3 / static_cast<double>(stage.scale.interpolation) * (stage.scale.reversed ? -1 : 1);
    out.zero_offset_nm = stage.scale.zero_offset_mm * nm_per_mm;
    out.gains = gb::tuned(s.bandwidth_hz, stage.accel_per_volt_m_s2, stage.viscous_friction_per_s);
    if (s.kp_v_um) out.gains.p = *s.kp_v_um * um;
    if (s.ki_v_um_s) out.gains.i = *s.ki_v_um_s * um;
    if (s.kd_v_s_um) out.gains.d = *s.kd_v_s_um * um;
    out.max_following_error_nm = s.max_following_error_um * 1e3;
    return out;
}

// ---- processor

CardProcessor::CardProcessor(sim::Kernel& kernel, const std::string& name, gb::Card& card)
    : kernel_(kernel), card_(card), id_(kernel.add(*this, sim::Phase::cards, name)) {
    static_assert(sizeof(State) == gb::output_count * (sizeof(gb::ServoLoop) + 8) + 40,
                  "padding would get into the state's hash");
    state_.stale_at = card.settings().offset + 2 * card.settings().period;
    card.add_listener(*this);
    schedule();
}

void CardProcessor::add(int output, const StageSetup& plan, const gb::ServoSettings& settings, Duration compute,
                        std::int64_t count) {
    const auto n = static_cast<std::size_t>(output);
    plans_[n] = plan;
    compute_[n] = compute;
    used_[n] = true;
    braking_s_ = std::max(braking_s_, plan.braking_s());
    state_.loops[n] = gb::ServoLoop(settings);
    state_.loops[n].close(count);
}

void CardProcessor::stop(bool power_off) {
    state_.stopping = 1;
    if (power_off && state_.power_off == 0)
        state_.power_off = 1 + static_cast<std::int32_t>(settles / card_.settings().period);
}

void CardProcessor::go_on(const std::array<std::int64_t, gb::output_count>& count) {
    for (std::size_t n = 0; n < plans_.size(); ++n)
        if (used_[n] && state_.loops[n].state() == gb::LoopState::stopped) state_.loops[n].close(count[n]);
    state_.stopping = state_.power_off = 0;
}

void go_on(const RunningStage& stage, std::span<const RunningStage> all, Instant now) {
    std::array<std::int64_t, gb::output_count> counts{};
    for (const RunningStage& one : all)
        if (one.processor == stage.processor)
            counts[static_cast<std::size_t>(one.config.output)] = one.scale->count(now);
    stage.processor->go_on(counts);
}

/// Advances profile time by a frame; returns the change of its rate, 1/s.
double CardProcessor::advance(const gb::Frame& frame, double period) {
    const auto sequence = static_cast<std::int64_t>(frame.sequence);
    const double passed = static_cast<double>(sequence - std::exchange(state_.sequence, sequence)) * period;
    const double wanted = state_.stopping != 0 ? 0 : 1;
    if (state_.rate == wanted) {
        state_.behind_s += (1 - state_.rate) * passed;
        return 0;
    }
    const double slope = (wanted - state_.rate > 0 ? 1 : -1) / braking_s_;
    state_.behind_s += (1 - state_.rate) * passed;
    state_.rate = std::clamp(state_.rate + slope * passed, 0.0, 1.0);
    return slope;
}

void CardProcessor::published(const gb::Card&, const gb::Frame& frame, Instant now) {
    const double period = to_seconds(card_.settings().period);
    const double slope = advance(frame, period), rate = state_.rate;
    const double seconds = frame.sequence * period - state_.behind_s;
    if (rate == 0 && state_.power_off > 1) --state_.power_off;
    for (std::size_t n = 0; n < plans_.size(); ++n) {
        if (!used_[n]) continue;
        const bool closed = state_.loops[n].closed();
        gb::Setpoint wanted = gb::wanted_at(plans_[n], seconds, period);
        wanted.accel_nm_s2 = wanted.accel_nm_s2 * rate * rate + wanted.speed_nm_s * slope;
        wanted.speed_nm_s *= rate;
        state_.loops[n].on_frame(frame, wanted);
        if (closed && !state_.loops[n].closed()) report_open(n);
        if (rate == 0 && state_.power_off == 1) state_.loops[n].stop();
        state_.put_out[n] = now + compute_[n];
    }
    state_.stale_at = now + 2 * card_.settings().period;
    schedule();
}

void CardProcessor::on_scheduled(Instant now) {
    if (now >= state_.stale_at) {
        for (std::size_t n = 0; n < plans_.size(); ++n) {
            const bool closed = state_.loops[n].closed();
            state_.loops[n].on_stale();
            if (closed) report_open(n);
        }
        state_.put_out.fill(now);
        state_.stale_at = never;
    }
    for (std::size_t n = 0; n < plans_.size(); ++n) {
        if (now < state_.put_out[n]) continue;
        state_.put_out[n] = never;
        if (used_[n])
            card_.put_out(static_cast<int>(n), static_cast<int>(std::floor(state_.loops[n].volts() * 1e6 + 0.5)));
    }
    schedule();
}

void CardProcessor::report_open(std::size_t n) {
    const gb::ServoLoop& loop = state_.loops[n];
    const LoopCondition code = loop.state() == gb::LoopState::stale ? LoopCondition::stale : LoopCondition::too_far;
    kernel_.report(id_, static_cast<std::uint16_t>(code), static_cast<std::int64_t>(n),
                   static_cast<std::int64_t>(loop.error().last_nm));
}

std::string describe_loop(const sim::Condition& condition, const RackStage& stage) {
    const double at = to_seconds(condition.at);
    if (static_cast<LoopCondition>(condition.code) == LoopCondition::stale)
        return fmt::format(
            "stage {}: at {:.6f} s card {} had no frame for two periods and opened its loop: 0 V, its position is not "
            "valid",
            stage.name, at, stage.card);
    return fmt::format(
        "stage {}: at {:.6f} s its following error was {} nm, more than max_following_error_um = {}; card {} opened "
        "its loop: 0 V",
        stage.name, at, condition.b, number_text(stage.servo->max_following_error_um), stage.card);
}

void CardProcessor::schedule() {
    Instant next = state_.stale_at;
    for (const Instant at : state_.put_out) next = std::min(next, at);
    kernel_.schedule(id_, next);
}

}  // namespace motionrack::rack
