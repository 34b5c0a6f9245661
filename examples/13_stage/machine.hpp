// The machine behind the cards of the rack file: six linear stages with their scales, and the two processors.
//
//   decoder ◄── scales ◄── stages ◄──volts── processor of card "scan" (scan.x .y .r), of card "step" (step.x .y .r) ◄── frames
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <motionrack/rack/grating_card.hpp>
#include <motionrack/sim/parts/linear_scale.hpp>
#include <motionrack/sim/parts/linear_stage.hpp>
#include <string>
#include <vector>

#include "processor.hpp"

namespace stage {

namespace gb = grating_bus;

enum { scan_x, scan_y, scan_r, step_x, step_y, step_r, axis_count };
inline constexpr std::array<const char*, axis_count> axis_names = {"scan.x", "scan.y", "scan.r", "step.x", "step.y", "step.r"};
inline constexpr double ratio = 4;  ///< the mask's picture is four times as large as the wafer's
inline constexpr Duration period = microseconds(200);

/// What is different from the rack file, and what happens.
struct Trial {
    std::string name;
    bool hosts = false;               ///< all three cards are hosts, without checks
    std::array<double, 3> offset_us{};  ///< of their clocks
    double drift_ppm = 0;             ///< of the clock of "step"
    Duration compute = microseconds(20);
    double late_ns = 0;               ///< of card "step", from `late_at` on
    Instant late_at = milliseconds(250);
};

/// What was seen: at each pulse, and in all.
struct Record {
    std::vector<double> seconds;
    std::vector<float> scan_mm, apart_nm, seen_nm;
    double peak_apart_nm = 0, squares = 0;
    int scanning = 0;
    std::array<double, axis_count> seen_peak_nm{};
    std::array<gb::LoopState, axis_count> states{};
    std::array<Instant, axis_count> opened{};
    std::uint64_t conflicts = 0;
    std::uint32_t bad_frames = 0;
    double rms_apart_nm() const { return scanning == 0 ? 0 : std::sqrt(squares / scanning); }
};

class Machine {
  public:
    Machine(const rack::RackConfig& config, const Trial& trial) : trial_(trial), rack_(with(config, trial)) {
        sim::Kernel& kernel = rack_.kernel();
        gb::Decoder& decoder = *rack::grating_bus_of(rack_)->decoders()[0];
        for (int n = 0; n < axis_count; ++n) {
            parts::LinearStageSettings motor;  // 5 m/s2 for a volt
            motor.viscous = 2;
            motor.start_nm = wanted(n, 0).position_nm;
            motor.end_minus_nm = -2e7;
            motor.end_plus_nm = 4e7;
            stages_.push_back(std::make_unique<parts::LinearStage>(kernel, axis_names[n], motor));
            parts::LinearScaleSettings grating;
            grating.pitch_pm = n < step_x ? 20'000'000 : 5'000'000;  // 4.88 and 1.22 nm a count: both go up to 20 MHz
            scales_.push_back(std::make_unique<parts::LinearScale>(kernel, fmt::format("{}.scale", axis_names[n]), *stages_.back(), grating));
            decoder.connect(n, scales_.back().get());
        }
        for (const int first : {+scan_x, +step_x}) processors_.push_back(processor(first));
        rack_.start();
    }

    Record run(Duration time) {
        Record out;
        bool late = false;
        for (Instant t{}; t < time; t += period) {
            if (trial_.late_ns != 0 && t >= trial_.late_at && !late) late = card("step").fault("late", trial_.late_ns, t);
            rack_.kernel().run_until(t);
            look(t, out);
        }
        for (int n = 0; n < axis_count; ++n) out.seen_peak_nm[n] = axis(n).loop.error().peak_nm, out.states[n] = axis(n).loop.state();
        out.conflicts = rack::grating_bus_of(rack_)->lines().all_conflicts();
        out.bad_frames = card("step").counter(gb::Card::broken);
        return out;
    }
    const gb::ScanProfile& scan() const { return scan_; }

  private:
    static rack::RackConfig with(rack::RackConfig config, const Trial& trial) {
        for (std::size_t i = 0, host = 0; i < config.cards.size(); ++i) {
            rack::GratingBusSettings& card = config.cards[i].grating_bus;
            if (config.cards[i].type != "grating_bus" || !trial.hosts) continue;
            card.role = rack::GratingRole::host;
            card.checks = false;
            card.offset_ns = 1e3 * trial.offset_us[host++];
            if (config.cards[i].name == "step") card.period_us *= 1 + 1e-6 * trial.drift_ppm;
        }
        return config;
    }
    gb::Card& card(const char* name) { return *rack::grating_card_of(rack_, name); }
    Axis& axis(int n) { return processors_[n < step_x ? 0 : 1]->axes()[static_cast<std::size_t>(n % step_x)]; }

    /// Mask and wafer scan to and fro, 4 to 1; at each turn the wafer goes on by a row; the rest stands.
    gb::Setpoint wanted(int n, double seconds) const {
        if (n == scan_x) return scan_.at(seconds);
        if (n == step_x) return gb::geared(scan_.at(seconds), 1 / ratio);
        if (n == step_y) return rows_.at(seconds - scan_.lead_s() - line_s);
        return {};
    }
    std::unique_ptr<Processor> processor(int first) {
        std::vector<Axis> axes;
        for (int n = first; n < first + step_x; ++n) {
            const std::size_t i = static_cast<std::size_t>(n);
            gb::ServoSettings s;
            s.word = static_cast<std::uint32_t>(n);
            s.nm_per_count = scales_[i]->nm_per_count();
            s.gains = gb::tuned(250, stages_[i]->settings().accel_per_volt, stages_[i]->settings().viscous);
            s.limit_nm = 100'000;
            axes.push_back({gb::ServoLoop(s), [this, n](double seconds) { return wanted(n, seconds); }, stages_[i]->drive_wire()});
            axes.back().loop.close(scales_[i]->count(Instant{0}));
        }
        const char* name = first == scan_x ? "scan" : "step";
        return std::make_unique<Processor>(rack_.kernel(), fmt::format("{}.processor", name), card(name), std::move(axes), trial_.compute);
    }
    /// The truth at the instant of a pulse, which no card knows.
    void look(Instant t, Record& out) {
        const double mask = stages_[scan_x]->position_nm(t), wafer = stages_[step_x]->position_nm(t), apart = mask - ratio * wafer;
        for (int n = 0; n < axis_count; ++n)
            if (!axis(n).loop.closed() && out.opened[n] == Instant{}) out.opened[n] = t;
        out.seconds.push_back(to_seconds(t));
        out.scan_mm.push_back(static_cast<float>(mask * 1e-6));
        out.apart_nm.push_back(static_cast<float>(apart));
        out.seen_nm.push_back(static_cast<float>(axis(scan_x).loop.error().last_nm));
        if (!scan_.scanning(to_seconds(t))) return;
        out.peak_apart_nm = std::max(out.peak_apart_nm, std::fabs(apart));
        out.squares += apart * apart;
        ++out.scanning;
    }

    static constexpr double line_s = 0.25;
    static constexpr gb::MotionLimits limits{8e7, 8e9, 1e12};  // 80 mm/s, 8 m/s2, 1000 m/s3
    Trial trial_;
    gb::ScanProfile scan_{0, line_s * limits.speed_nm_s, limits};
    gb::StepProfile rows_{0, 2e5, 4, scan_.period_s() / 2, limits};
    rack::Rack rack_;
    std::vector<std::unique_ptr<parts::LinearStage>> stages_;
    std::vector<std::unique_ptr<parts::LinearScale>> scales_;
    std::vector<std::unique_ptr<Processor>> processors_;
};

}  // namespace stage
