// Computes the voltage of a servo loop.
#include <algorithm>
#include <cmath>
#include <motionrack/base/result.hpp>
#include <motionrack/base/trig.hpp>
#include <motionrack/cards/grating_bus/processor/servo_loop.hpp>
#include <type_traits>

namespace motionrack::grating_bus {

ServoGains tuned(double bandwidth_hz, double accel_per_volt, double viscous) {
    MOTIONRACK_ASSERT(bandwidth_hz > 0 && accel_per_volt > 0 && viscous >= 0);
    const double crossing = 2 * pi * bandwidth_hz, nm_s2 = accel_per_volt * 1e9;
    ServoGains out;
    out.d = crossing / nm_s2;
    out.p = out.d * crossing / 3;
    out.i = out.p * crossing / 15;
    out.speed_ff = viscous / nm_s2;
    out.accel_ff = 1 / nm_s2;
    return out;
}

double FollowingError::rms_nm() const {
    return frames == 0 ? 0 : std::sqrt(squares / static_cast<double>(frames));
}

ServoLoop::ServoLoop(const ServoSettings& settings) : settings_(settings) {
    static_assert(std::is_trivially_copyable_v<ServoLoop> &&
                      sizeof(ServoLoop) == sizeof(ServoSettings) + sizeof(FollowingError) + 8 * 7,
                  "padding would get into the hash of what holds it");
    MOTIONRACK_ASSERT(settings.scale < max_scales && settings.nm_per_count != 0);
    MOTIONRACK_ASSERT(settings.limit_v > 0 && settings.limit_i_v >= 0 && settings.max_following_error_nm >= 0);
}

void ServoLoop::close(std::int64_t count) {
    count_ = count;
    integral_ = volts_ = 0;
    state_ = LoopState::closed;
    begun_ = 0;
    without_ = 0;
}

std::optional<std::uint32_t> ServoLoop::usable(const Frame& frame) const {
    if (!sound(frame) || (begun_ != 0 && frame.instant() <= last_)) return std::nullopt;
    return word_of(frame, settings_.scale);
}

double ServoLoop::on_frame(const Frame& frame, const Setpoint& wanted) {
    if (!closed()) return volts_;
    const std::optional<std::uint32_t> word = usable(frame);
    if (!word) {
        ++unused_;
        if (sound(frame) && !word_of(frame, settings_.scale)) ++without_;
        return without_ < 2 ? volts_ : open(LoopState::stale);
    }
    without_ = 0;
    count_ = unwrapped(count_, frame.counts[*word]);
    const double error = wanted.position_nm - position_nm();
    const double seconds = begun_ != 0 ? to_seconds(frame.instant() - last_) : 0;
    const double slope = begun_ != 0 ? (error - before_) / seconds : 0;
    const ServoGains& g = settings_.gains;
    const double rest = g.p * error + g.d * slope + g.speed_ff * wanted.speed_nm_s + g.accel_ff * wanted.accel_nm_s2;
    // Anti-windup: does not integrate while the output is at its limit.
    if (std::fabs(rest + integral_) < settings_.limit_v)
        integral_ = std::clamp(integral_ + g.i * error * seconds, -settings_.limit_i_v, settings_.limit_i_v);
    const double volts = rest + integral_;
    volts_ = std::clamp(volts, -settings_.limit_v, settings_.limit_v);
    last_ = frame.instant();
    begun_ = 1;
    before_ = error;
    error_.last_nm = error;
    error_.peak_nm = std::max(error_.peak_nm, std::fabs(error));
    error_.squares += error * error;
    ++error_.frames;
    if (settings_.max_following_error_nm > 0 && std::fabs(error) > settings_.max_following_error_nm)
        return open(LoopState::too_far);
    return volts_;
}

double ServoLoop::open(LoopState why) {
    state_ = why;
    integral_ = 0;
    return volts_ = 0;
}

double ServoLoop::on_stale() {
    return closed() ? open(LoopState::stale) : volts_;
}

}  // namespace motionrack::grating_bus
