// Additional functions: chips, time, status, manual operation, interrupts, contours, bit patterns, the virtual card.
#include <fmt/format.h>
#include <mcx314lib.h>

#include <algorithm>
#include <motionrack/frontends/mcx314lib/calls.hpp>

namespace {

using namespace motionrack::mcx314lib;
using motionrack::Duration;
using motionrack::ErrorKind;
using motionrack::fail;
using motionrack::Instant;
using motionrack::Result;
using motionrack::mcx314::channels_of;
using motionrack::mcx314::FourAxes;
using motionrack::mcx314::StopKind;

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): C functions keep it for each thread
thread_local std::string report_text;

Result<Duration> time_of(int milliseconds) {
    if (milliseconds >= 0) return motionrack::milliseconds(milliseconds);
    return fail(ErrorKind::refused,
                fmt::format("the time is {} ms; it must be 0 to 2147483647 ms. Nothing was run.", milliseconds));
}

/// Converts 0 or 1 to a bool; refuses other values.
Result<bool> bit_of(int value, const char* what) {
    if (value == 0 || value == 1) return value == 1;
    return fail(ErrorKind::refused, fmt::format("the {} is {}; it must be 0 or 1. Nothing was written.", what, value));
}

/// Returns the mask of those axes for which `fits` is true.
template <class Fits>
int those_of(const char* who, int axis, Fits fits) {
    return with_chip(who, -1, [&](OpenChip& chip) -> Result<int> {
        MOTIONRACK_TRY(const unsigned axes, mask_of(axis));
        int out = 0;
        for (const int i : channels_of(axes))
            if (fits(chip, i)) out |= 1 << i;
        return out;
    });
}

/// Stops manual operations by themselves and other drives by the library.
int stop(const char* who, int axis, StopKind kind) {
    return on_axes(who, axis, [&](OpenChip& chip, unsigned axes) -> Result<void> {
        for (const int i : channels_of(axes)) {
            if (chip.manual(i).state() == motionrack::mcx314::ManualState::standing) continue;
            kind == StopKind::quick ? chip.manual(i).stop_now() : chip.manual(i).stop();
            axes &= ~(1u << i);
        }
        return axes == 0 ? Result<void>{} : chip.driver.stop(axes, kind);
    });
}

/// Runs `call` with the manual operation of an axis, which applies these settings at standstill.
template <class Call>
int manually(const char* who, int axis, int sv, int a, Call call) {
    return done(who, [&](OpenChip& chip) -> Result<void> {
        MOTIONRACK_TRY(const int channel, channel_of(axis));
        motionrack::mcx314::Manual& manual = chip.manual(channel);
        if (manual.state() == motionrack::mcx314::ManualState::standing && !chip.driver.moving(1u << channel)) {
            motionrack::mcx314::ManualSettings settings;
            settings.sv = sv;
            settings.a = a;
            MOTIONRACK_CHECK(manual.set(settings));
        }
        return call(manual, chip.now());
    });
}

FourAxes four(const int* values) {
    FourAxes out{};
    std::copy(values, values + 4, out.begin());
    return out;
}

int change_interrupts(const char* who, int axis, int causes,
                      Result<void> (motionrack::mcx314::Driver::*function)(unsigned, std::uint16_t)) {
    return on_axes(who, axis, [&](OpenChip& chip, unsigned axes) -> Result<void> {
        if (causes < 1 || causes > motionrack::mcx314::cause::all)
            return fail(ErrorKind::refused,
                        fmt::format("the causes are {}; they must be 1 to 255, bits of enum mcx314_cause. "
                                    "Nothing was written.",
                                    causes));
        return (chip.driver.*function)(axes, static_cast<std::uint16_t>(causes));
    });
}

}  // namespace

// ---- chips

int mcx314_open(const char* rack, const char* card) {
    return with_bench(__func__, -1, [&](ChipTable& bench) { return bench.open(rack, card); });
}

int mcx314_select(int handle) {
    return with_bench(__func__, -1, [&](ChipTable& bench) -> Result<int> {
        MOTIONRACK_CHECK(bench.select(handle));
        return 0;
    });
}

int mcx314_close(int handle) {
    return with_bench(__func__, -1, [&](ChipTable& bench) -> Result<int> {
        MOTIONRACK_CHECK(bench.close(handle));
        return 0;
    });
}

// ---- time

int mcx314_wait(int axis, int milliseconds) {
    return with_bench(__func__, -1, [&](ChipTable& bench) -> Result<int> {
        MOTIONRACK_TRY(OpenChip * chip, bench.selected());
        MOTIONRACK_TRY(const unsigned axes, mask_of(axis));
        MOTIONRACK_TRY(const Duration time, time_of(milliseconds));
        MOTIONRACK_CHECK(bench.pass(*chip, Duration{0}));
        const Instant end = chip->now() + time;
        const auto manual = [&] {
            for (const int i : channels_of(axes))
                if (chip->manual(i).state() != motionrack::mcx314::ManualState::standing) return true;
            return false;
        };
        while (manual() && chip->now() < end)
            MOTIONRACK_CHECK(bench.pass(*chip, std::min(motionrack::milliseconds(1), end - chip->now())));
        MOTIONRACK_CHECK(chip->driver.wait_until_done(axes, std::max(end - chip->now(), Duration{0})));
        return 0;
    });
}

int mcx314_advance_ms(int milliseconds) {
    return with_bench(__func__, -1, [&](ChipTable& bench) -> Result<int> {
        MOTIONRACK_TRY(OpenChip * chip, bench.selected());
        MOTIONRACK_TRY(const Duration time, time_of(milliseconds));
        MOTIONRACK_CHECK(bench.pass(*chip, time));
        return 0;
    });
}

int64_t mcx314_now_us(void) {
    return with_bench(__func__, std::int64_t{-1}, [](ChipTable& bench) -> Result<std::int64_t> {
        MOTIONRACK_TRY(OpenChip * chip, bench.selected());
        return chip->now() / motionrack::microseconds(1);
    });
}

// ---- status

int mcx314_moving(int axis) {
    return those_of(__func__, axis, [](OpenChip& chip, int channel) { return chip.driver.moving(1u << channel); });
}

int mcx314_at_limit(int axis) {
    return those_of(__func__, axis,
                    [](OpenChip& chip, int channel) { return chip.driver.axis_status(channel).at_limit(); });
}

const char* mcx314_report(int axis) {
    report_text.clear();
    on_axes(__func__, axis, [](OpenChip& chip, unsigned axes) -> Result<void> {
        for (const int i : channels_of(axes)) {
            if (!report_text.empty()) report_text += '\n';
            report_text += chip.driver.report(i).text();
        }
        return {};
    });
    return report_text.c_str();
}

// ---- stops, ramps, outputs

int mcx314_stop(int axis) {
    return stop(__func__, axis, StopKind::slow);
}
int mcx314_stop_now(int axis) {
    return stop(__func__, axis, StopKind::quick);
}

int mcx314_asymmetric(int axis, int on) {
    return on_axes(__func__, axis, [&](OpenChip& chip, unsigned axes) -> Result<void> {
        MOTIONRACK_TRY(const bool wanted, bit_of(on, "switch"));
        return chip.driver.SetAsymmetric(axes, wanted);
    });
}

int mcx314_set_output(int axis, int output, int level) {
    return on_axes(__func__, axis, [&](OpenChip& chip, unsigned axes) -> Result<void> {
        MOTIONRACK_TRY(const bool high, bit_of(level, "level"));
        return chip.driver.SetOutput(axes, output, high);
    });
}

// ---- plans

int mcx314_plan(int axis, int SV, int V, int A, int K, int pulses, MCX314_PLAN* plan) {
    return done(__func__, [&](OpenChip& chip) -> Result<void> {
        MOTIONRACK_TRY(const int channel, channel_of(axis));
        MOTIONRACK_CHECK(check_pointer(plan, "The plan"));
        MOTIONRACK_TRY(const motionrack::mcx314::CurvePlan made, chip.driver.plan(channel, SV, V, A, K, pulses));
        *plan = {motionrack::to_seconds(made.time()), made.top_hz(), made.hz(made.end_v),
                 static_cast<int>(made.data.dec_point.value_or(made.rise.pulses + made.cruise.pulses)),
                 static_cast<int>(made.data.AO)};
        return {};
    });
}

// ---- manual operation, homing's axes

int mcx314_jog(int axis, int SV, int V, int A) {
    return manually(__func__, axis, SV, A, [&](auto& manual, Instant now) { return manual.jog(V, now); });
}

int mcx314_jog_step(int axis, int SV, int V, int A, int pulses) {
    return manually(__func__, axis, SV, A, [&](auto& manual, Instant) { return manual.step_jog(pulses, V); });
}

int mcx314_jog_home(int axis, int type, int WR1Reg, int SV, int V, int A) {
    return done(__func__, [&](OpenChip& chip) -> Result<void> {
        MOTIONRACK_TRY(const int channel, channel_of(axis));
        MOTIONRACK_TRY(const unsigned word, mode_word(WR1Reg));
        MOTIONRACK_TRY(const auto settings, motionrack::mcx314::home_settings(type, word, SV, V, A));
        return chip.manual(channel).home(settings, chip.now());
    });
}

int mcx314_home_axes(int axis) {
    return on_axes(__func__, axis, [](OpenChip& chip, unsigned axes) -> Result<void> {
        chip.home_axes = axes;
        return {};
    });
}

// ---- interrupts

int mcx314_enable_interrupt(int axis, int causes) {
    return change_interrupts(__func__, axis, causes, &motionrack::mcx314::Driver::EnableInterrupt);
}
int mcx314_disable_interrupt(int axis, int causes) {
    return change_interrupts(__func__, axis, causes, &motionrack::mcx314::Driver::DisableInterrupt);
}
int mcx314_read_interrupt(int axis) {
    return with_chip(__func__, -1, [&](OpenChip& chip) -> Result<int> {
        MOTIONRACK_TRY(const int channel, channel_of(axis));
        return chip.driver.read_interrupts(channel);
    });
}

// ---- contours

int mcx314_contour_begin(const MCX314_CONTOUR* data) {
    return done(__func__, [&](OpenChip& chip) -> Result<void> {
        MOTIONRACK_CHECK(check_pointer(data, "The contour"));
        return chip.driver.ContStart({data->SV, data->V, data->A, data->D});
    });
}

int mcx314_contour_line(int axis, const int P[4], int V) {
    return on_axes(__func__, axis, [&](OpenChip& chip, unsigned axes) -> Result<void> {
        MOTIONRACK_CHECK(check_pointer(P, "The finish point"));
        return chip.driver.ContLine(axes, four(P), V);
    });
}

int mcx314_contour_arc(int axis, const int P[4], const int C[4], int clockwise, int V) {
    return on_axes(__func__, axis, [&](OpenChip& chip, unsigned axes) -> Result<void> {
        MOTIONRACK_CHECK(check_pointer(P, "The finish point"));
        MOTIONRACK_CHECK(check_pointer(C, "The centre"));
        MOTIONRACK_TRY(const bool cw, bit_of(clockwise, "direction"));
        return chip.driver.ContArc(axes, four(P), four(C), cw, V);
    });
}

int mcx314_contour_end(void) {
    return done(__func__, [](OpenChip& chip) -> Result<void> {
        const auto outcome = chip.driver.ContEnd();
        return outcome ? Result<void>{} : tl::unexpected<motionrack::Error>(outcome.error());
    });
}

// ---- bit patterns

int mcx314_pattern_begin(const MCX314_PATTERN* data, int axis) {
    return on_axes(__func__, axis, [&](OpenChip& chip, unsigned axes) -> Result<void> {
        MOTIONRACK_CHECK(check_pointer(data, "The pattern"));
        const motionrack::mcx314::BPDATA speeds{data->SV, data->V, data->A, data->DecPoint};
        return motionrack::mcx314::channels_of(axes).count == 3 ? chip.driver.BP3D(speeds, axes)
                                                                : chip.driver.BP2D(speeds, axes);
    });
}

int mcx314_pattern_steps(const MCX314_STEPS* steps) {
    return done(__func__, [&](OpenChip& chip) -> Result<void> {
        MOTIONRACK_CHECK(check_pointer(steps, "The steps"));
        motionrack::mcx314::BPWORD word;
        for (std::size_t i = 0; i < 3; ++i) {
            if (steps->plus[i] > 0xFFFF || steps->minus[i] > 0xFFFF)
                return fail(ErrorKind::refused,
                            fmt::format("the words of the axis number {} are {} and {}; they must be 0 to 65535. "
                                        "Nothing was written.",
                                        i + 1, steps->plus[i], steps->minus[i]));
            word.plus[i] = static_cast<std::uint16_t>(steps->plus[i]);
            word.minus[i] = static_cast<std::uint16_t>(steps->minus[i]);
        }
        return chip.driver.BPStack(word);
    });
}

int mcx314_pattern_start(void) {
    return done(__func__, [](OpenChip& chip) { return chip.driver.BPStart(); });
}
int mcx314_pattern_end(void) {
    return done(__func__, [](OpenChip& chip) { return chip.driver.BPEnd(); });
}

// ---- the virtual card

int mcx314_peek(const char* name, int64_t* value) {
    return done(__func__, [&](OpenChip& chip) -> Result<void> {
        MOTIONRACK_CHECK(check_pointer(name, "The name"));
        MOTIONRACK_CHECK(check_pointer(value, "The address of the value"));
        MOTIONRACK_TRY(const VirtualCard* card, chip.virtual_card("registers that are visible without access"));
        MOTIONRACK_TRY(*value, card->inspect(name));
        return {};
    });
}

int mcx314_set_wire(const char* wire, double value) {
    return done(__func__, [&](OpenChip& chip) -> Result<void> {
        MOTIONRACK_CHECK(check_pointer(wire, "The wire"));
        MOTIONRACK_CHECK(chip.virtual_card("wires that a program could set"));
        return chip.rack->set_wire(wire, value);
    });
}
