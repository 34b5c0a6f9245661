#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/operate/clock_pacer.hpp>

namespace motionrack::operate {

namespace {

constexpr Duration max_wait = milliseconds(5);

constexpr std::array<std::string_view, 3> mode_names = {"real", "unthrottled", "paused"};
static_assert(mode_names[static_cast<std::size_t>(ClockMode::paused)] == "paused");

}  // namespace

std::string_view name_of(ClockMode mode) {
    return mode_names[static_cast<std::size_t>(mode)];
}

void Lateness::add(Duration late) {
    late = std::max(late, Duration{0});
    const auto bucket = static_cast<std::size_t>((late.count() + width.count() - 1) / width.count());
    ++counts_[std::min(bucket, counts_.size() - 1)];
    ++count_;
    max_ = std::max(max_, late);
}

Duration Lateness::within(double part) const {
    std::int64_t left = count_ - static_cast<std::int64_t>(std::ceil(part * static_cast<double>(count_)));
    for (std::size_t i = counts_.size(); i-- > 0;) {
        left -= counts_[i];
        if (left < 0) return i + 1 == counts_.size() ? max_ : std::min(max_, static_cast<std::int64_t>(i) * width);
    }
    return Duration{0};
}

ClockPacer::ClockPacer(live::Clock& clock, ClockMode mode, double factor)
    : clock_(clock), mode_(mode), factor_(factor) {}

Result<void> ClockPacer::set(ClockMode mode, double factor) {
    if (!(factor >= min_factor && factor <= max_factor))
        return fail(ErrorKind::invalid_input,
                    fmt::format("The clock's factor is {}; it must be {} to {}. Nothing was changed.", factor,
                                min_factor, max_factor));
    mode_ = mode;
    factor_ = factor;
    step_end_ = last_;
    begun_ = false;
    return {};
}

Result<void> ClockPacer::step(Duration duration) {
    if (mode_ != ClockMode::paused)
        return fail(ErrorKind::refused,
                    fmt::format("Time steps need a paused clock; its mode is '{}'. Pause it first.", name_of(mode_)));
    if (duration <= Duration{0} || duration > whole_seconds(3600))
        return fail(ErrorKind::invalid_input,
                    fmt::format("The time step is {} s; it must be 100 ps to 3600 s. Nothing was changed.",
                                to_seconds(duration)));
    step_end_ = std::max(step_end_, last_) + duration;
    return {};
}

Instant ClockPacer::due(Instant now) const {
    return real_base_ + Duration{static_cast<std::int64_t>(static_cast<double>((now - rack_base_).count()) / factor_)};
}

void ClockPacer::begin_here(Instant now) {
    rack_base_ = now;
    real_base_ = clock_.now();
    begun_ = true;
}

bool ClockPacer::pace(Instant now) {
    last_ = now;
    if (mode_ == ClockMode::unthrottled) return true;
    if (mode_ == ClockMode::paused) {
        if (now < step_end_) return true;
        clock_.sleep(max_wait);
        return false;
    }
    if (!begun_) begin_here(now);
    const Duration early = due(now) - clock_.now();
    if (early > Duration{0}) clock_.sleep(std::min(early, max_wait));
    if (early > max_wait) return false;
    const Duration late = clock_.now() - due(now);
    lateness_.add(late);
    if (late > given_up) {
        lost_ += late;
        begin_here(now);
    }
    return true;
}

}  // namespace motionrack::operate
