// Stages from their settings, and the processors' frames.
#include <fmt/format.h>

#include <cmath>
#include <motionrack/rack/stage.hpp>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::rack {

namespace gb = grating_bus;

namespace {

constexpr double nm_per_mm = 1e6;

gb::MotionLimits limits_of(const RackStageServo& s) {
    return {s.speed_mm_s * nm_per_mm, s.accel_mm_s2 * nm_per_mm, s.jerk_mm_s3 * nm_per_mm};
}

}  // namespace

// ---- settings

std::string profile_flaw(const RackStage& stage) {
    if (!stage.servo) return {};
    const RackStageServo& s = *stage.servo;
    if (s.profile == StageProfile::scan && !(s.from_mm < s.to_mm))
        return fmt::format("from_mm is {} and to_mm is {}; a scan goes from the smaller to the greater.",
                           number_text(s.from_mm), number_text(s.to_mm));
    if (s.profile != StageProfile::steps) return {};
    if (s.step_mm == 0) return "step_mm is 0; a step goes somewhere.";
    const double way = std::fabs(s.step_mm) * nm_per_mm;
    const double move = gb::StepProfile(0, way, 1, 1e9, limits_of(s)).move_s();
    if (move > s.every_ms * 1e-3)
        return fmt::format("A step of {} mm takes {:.3f} ms with these limits, but every_ms is {}.",
                           number_text(s.step_mm), move * 1e3, number_text(s.every_ms));
    return {};
}

StagePlan::StagePlan(const RackStage& stage) : profile_(gb::HoldProfile{stage.start_mm.value_or(0) * nm_per_mm}) {
    if (!stage.servo) return;
    const RackStageServo& s = *stage.servo;
    delay_s_ = s.delay_ms * 1e-3;
    const gb::MotionLimits limits = limits_of(s);
    if (s.profile == StageProfile::scan) profile_ = gb::ScanProfile(s.from_mm * nm_per_mm, s.to_mm * nm_per_mm, limits);
    if (s.profile == StageProfile::steps)
        profile_ = gb::StepProfile(stage.start_mm.value_or(0) * nm_per_mm, s.step_mm * nm_per_mm,
                                   static_cast<int>(s.steps), s.every_ms * 1e-3, limits);
}

gb::Setpoint StagePlan::at(double seconds) const {
    return std::visit([t = seconds - delay_s_](const auto& profile) { return profile.at(t); }, profile_);
}

parts::LinearStageSettings motor_settings(const RackStage& stage) {
    parts::LinearStageSettings out;
    out.accel_per_volt = stage.accel_per_volt_m_s2;
    out.top_accel = stage.top_accel_m_s2;
    out.top_speed = stage.top_speed_m_s;
    out.viscous = stage.viscous_per_s;
    out.coulomb = stage.coulomb_m_s2;
    out.load = stage.load;
    out.start_nm = stage.start_mm ? *stage.start_mm * nm_per_mm : StagePlan(stage).start_nm();
    out.end_minus_nm = stage.end_minus_mm * nm_per_mm;
    out.end_plus_nm = stage.end_plus_mm * nm_per_mm;
    return out;
}

parts::LinearScaleSettings scale_settings(const RackStage& stage) {
    const RackScale& s = stage.scale;
    parts::LinearScaleSettings out;
    out.pitch_pm = static_cast<std::int64_t>(std::floor(s.pitch_um * 1e6 + 0.5));
    out.interpolation = s.interpolation;
    out.reversed = s.reversed;
    out.zero_nm = s.zero_mm * nm_per_mm;
    out.fastest = s.fastest_mhz * 1e6;
    if (s.index_mm) out.index_nm = *s.index_mm * nm_per_mm;
    out.dirt_at_nm = s.dirt_at_mm * nm_per_mm;
    return out;
}

gb::ServoSettings loop_settings(const RackStage& stage, std::int64_t first) {
    const RackStageServo& s = *stage.servo;
    const double um = 1e-3;  // a nm in um
    gb::ServoSettings out;
    out.word = static_cast<std::uint64_t>(stage.input - first);
    out.nm_per_count =
        stage.scale.pitch_um * 1e3 / static_cast<double>(stage.scale.interpolation) * (stage.scale.reversed ? -1 : 1);
    out.zero_nm = stage.scale.zero_mm * nm_per_mm;
    out.gains = gb::tuned(s.bandwidth_hz, stage.accel_per_volt_m_s2, stage.viscous_per_s);
    if (s.p_v_um) out.gains.p = *s.p_v_um * um;
    if (s.i_v_um_s) out.gains.i = *s.i_v_um_s * um;
    if (s.d_v_s_um) out.gains.d = *s.d_v_s_um * um;
    out.limit_nm = s.limit_um * 1e3;
    return out;
}

// ---- processor

CardProcessor::CardProcessor(sim::Kernel& kernel, const std::string& name, gb::Card& card)
    : kernel_(kernel), card_(card), id_(kernel.add(*this, sim::Phase::cards, name)) {
    static_assert(sizeof(State) == gb::output_count * (sizeof(gb::ServoLoop) + 8) + 8,
                  "padding would get into the state's hash");
    state_.stale_at = card.settings().offset + 2 * card.settings().period;
    card.add_listener(*this);
    schedule();
}

void CardProcessor::add(int output, const StagePlan& plan, const gb::ServoSettings& settings, Duration compute,
                        std::int64_t count) {
    const auto n = static_cast<std::size_t>(output);
    plans_[n] = plan;
    compute_[n] = compute;
    used_[n] = true;
    state_.loops[n] = gb::ServoLoop(settings);
    state_.loops[n].close(count);
}

void CardProcessor::published(const gb::Card&, const gb::Frame& frame, Instant now) {
    const double period = to_seconds(card_.settings().period), seconds = frame.sequence * period;
    for (std::size_t n = 0; n < plans_.size(); ++n) {
        if (!used_[n]) continue;
        const bool closed = state_.loops[n].closed();
        state_.loops[n].on_frame(frame, gb::wanted_at(plans_[n], seconds, period));
        if (closed && !state_.loops[n].closed()) report_open(n);
        state_.put_out[n] = now + compute_[n];
    }
    state_.stale_at = now + 2 * card_.settings().period;
    schedule();
}

void CardProcessor::act(Instant now) {
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
            "trusted",
            stage.name, at, stage.card);
    return fmt::format(
        "stage {}: at {:.6f} s it was {} nm from where it was to be, more than limit_um = {}; card {} opened its loop: "
        "0 V",
        stage.name, at, condition.b, number_text(stage.servo->limit_um), stage.card);
}

void CardProcessor::schedule() {
    Instant next = state_.stale_at;
    for (const Instant at : state_.put_out) next = std::min(next, at);
    kernel_.schedule(id_, next);
}

}  // namespace motionrack::rack
