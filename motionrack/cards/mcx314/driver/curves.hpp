// Plan of a drive without motion: times, distances and peaks of acceleration, cruise and deceleration, exact to the
// tick by the chip's own integer rule (RULES.md).
//
//   speed   V |        ________________                  rise    SV to the top speed
//             |       /                \                 cruise  at the top speed
//             |      /                  \                fall    to SV
//          SV |-----'                    '-----.         creep   at SV, until the last pulse
//             +-----|--|----------------|--|---|--> t
//              wait  rise    cruise      fall creep      wait: 250 ns from the command to the generator's first tick
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <motionrack/base/result.hpp>
#include <motionrack/base/time.hpp>
#include <motionrack/cards/mcx314/arithmetic.hpp>
#include <optional>

namespace motionrack::mcx314 {

/// A drive in register units; ranges as in the driver's functions.
struct CurveData {
    std::int64_t R = 8'000'000;
    std::int64_t SV = 1;
    std::int64_t V = 1;
    std::int64_t A = 1;
    std::int64_t D = 1;       ///< deceleration; used if `asymmetric`
    std::int64_t K = 65'535;  ///< jerk; used if `s_curve`
    std::int64_t AO = 0;      ///< pulses reserved at SV; used with automatic deceleration
    bool s_curve = false;
    bool asymmetric = false;
    std::optional<std::int64_t> dec_point = {};  ///< manual deceleration; absent: automatic
    /// Pulses of a fixed drive, >= 0; basic pulses of an interpolation. Absent: a continuous drive, planned as
    /// acceleration to V, no cruise, and the deceleration of a slow stop.
    std::optional<std::int64_t> pulses = {};
};

/// A part of a drive.
struct CurvePart {
    std::int64_t ticks = 0;  ///< ticks of 125 ns
    std::int64_t pulses = 0;
    std::int64_t from_v = 0, to_v = 0;  ///< V units at its ends
    std::int64_t peak_rate = 0;         ///< maximum acceleration, A units
    Duration time() const { return nanoseconds(125 * ticks); }
};

struct CurvePlan {
    CurveData data;
    CurvePart rise, cruise, fall, creep;
    std::int64_t ticks = 0;  ///< from the command's tick to the last pulse
    std::int64_t pulses = 0;
    std::int64_t top_v = 0;  ///< maximum speed reached, V units
    std::int64_t end_v = 0;  ///< speed at the last pulse; above SV if the deceleration began too late
    bool reaches_v = false;  ///< false: a triangle
    bool full_s = false;     ///< S-curve whose acceleration stayed below its limit (no straight middle)
    Duration time() const { return nanoseconds(125 * ticks); }
    /// Returns true if the drive ends at SV, or at V if that is not above SV.
    bool ends_slow() const { return end_v <= std::min(data.SV, data.V); }

    double hz(std::int64_t v) const { return static_cast<double>(v) * rules::clock_hz / static_cast<double>(data.R); }
    double top_hz() const { return hz(top_v); }
    /// Maximum acceleration of a part, pulses/s2.
    double peak_acceleration(const CurvePart& part) const { return 125.0 * hz(part.peak_rate); }
    /// Jerk, pulses/s3: 62.5e6 / K * M; 0 for a T-curve, whose acceleration changes at once.
    double jerk() const { return data.s_curve ? 62.5e6 / static_cast<double>(data.K) * hz(1) : 0; }
};

/// Ticks of constant speed between two changes of the speed. Pulses occur at the ticks at which the accumulator, `at`
/// before the span, passes a multiple of R. Ticks count from the command.
struct CurveSpan {
    std::int64_t tick = 0;  ///< last tick before the span
    std::int64_t ticks = 0;
    std::int64_t v = 0;
    std::int64_t at = 0;  ///< accumulator before the span's first tick
    int ramp = 0;         ///< -1, 0, +1 in the span's last tick, before its speed step
};

/// Plans a drive. Errors: ErrorKind::refused with the range of an invalid value. `spans`, if given, is called with
/// every span in order.
Result<CurvePlan> plan_drive(const CurveData& data, const std::function<void(const CurveSpan&)>& spans = {});

/// Returns the latest manual deceleration point with which the drive still reaches SV at its last pulse, or 0. Exact by
/// search: every later point ends faster.
Result<std::int64_t> best_dec_point(const CurveData& data);

/// Returns the smallest AO, 0 .. 65,535, with which the automatic deceleration reaches SV by the last pulse: a
/// deceleration takes slightly more pulses than the acceleration, most of all in S-curves. 65,535 if none does.
Result<std::int64_t> best_offset(const CurveData& data);

/// Returns the drive with the data that make it end at SV: the point of best_dec_point() if it decelerates with D, else
/// the AO of best_offset(). Returns a continuous drive unchanged.
Result<CurveData> with_slow_end(const CurveData& data);

/// Returns the pulses of the deceleration from `v` to SV, rounded up.
std::int64_t fall_pulses(const CurveData& data, std::int64_t v);
/// Returns the speed, V units, after `pulses` of a T-curve's deceleration from `v`: SV if they suffice.
std::int64_t speed_after_fall(const CurveData& data, std::int64_t v, std::int64_t pulses);

}  // namespace motionrack::mcx314
