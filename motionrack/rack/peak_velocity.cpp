#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <motionrack/rack/peak_velocity.hpp>

namespace motionrack::rack {

namespace {

constexpr double min_peak_window = 1e-3;
constexpr std::size_t max_looks = 1 << 10;
/// Pulses by which a count over some time may exceed the velocity: counts and segment ends are whole.
constexpr double count_excess = 2;
/// With this number of pulses, a single pulse is negligible.
constexpr double many_pulses = 1000;

}  // namespace

PeakVelocity::PeakVelocity(double jump_hz, Duration period)
    : jump_hz_(jump_hz), period_s_(to_seconds(period)), counts_(max_looks) {
    while (static_cast<double>(min_looks_) * period_s_ < min_peak_window && min_looks_ < max_looks / 2) min_looks_ *= 2;
}

void PeakVelocity::pass(double rate, Instant now) {
    pulses_ += 0.5 * (std::fabs(rate_) + std::fabs(rate)) * to_seconds(now - since_);
    piece_top_ = std::max(piece_top_, std::fabs(rate));
    rate_ = rate;
    since_ = now;
}

void PeakVelocity::changed(double before, double rate, Instant now) {
    pass(before, now);
    if (std::fabs(rate - before) > jump_hz_) {
        whole_pulses_ = true;
        end_piece();
        whole_pulses_ = true;
    }
    rate_ = rate;
    piece_top_ = std::max(piece_top_, std::fabs(rate));
}

void PeakVelocity::end_piece() {
    const double surely = !whole_pulses_ || pulses_ >= many_pulses ? 1 : 1 - 1 / std::max(pulses_, 1.0);
    top_ = std::max(top_, surely * piece_top_);
    piece_top_ = pulses_ = 0;
    whole_pulses_ = false;
}

void PeakVelocity::sample(std::int64_t count, double rate, Instant now) {
    pass(rate, now);
    for (std::size_t window = min_looks_; window <= std::min(looks_, max_looks - 1); window *= 2) {
        const auto pulses = static_cast<double>(std::abs(count - counts_[(looks_ - window) % max_looks]));
        top_ = std::max(top_, (pulses - count_excess) / (static_cast<double>(window) * period_s_));
    }
    counts_[looks_++ % max_looks] = count;
}

void PeakVelocity::finish() {
    end_piece();
}

}  // namespace motionrack::rack
