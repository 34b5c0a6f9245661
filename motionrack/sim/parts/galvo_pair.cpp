// Motion of the mirrors, tick by tick, with the exact solution of the lag over a tick.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/base/trig.hpp>
#include <motionrack/sim/parts/galvo_pair.hpp>

namespace motionrack::parts {

namespace {

constexpr double galvo_tick_s = 1e-5;

using Matrix = std::array<double, 4>;

Matrix times(const Matrix& a, const Matrix& b) {
    return {a[0] * b[0] + a[1] * b[2], a[0] * b[1] + a[1] * b[3], a[2] * b[0] + a[3] * b[2], a[2] * b[1] + a[3] * b[3]};
}

/// exp(m): the series for m / 1024, squared ten times.
Matrix exponential_of(Matrix m) {
    for (double& v : m) v /= 1024;
    Matrix sum{1, 0, 0, 1}, term{1, 0, 0, 1};
    for (int i = 1; i < 20; ++i) {
        term = times(term, m);
        for (double& v : term) v /= i;
        for (std::size_t k = 0; k < 4; ++k) sum[k] += term[k];
    }
    for (int i = 0; i < 10; ++i) sum = times(sum, sum);
    return sum;
}

}  // namespace

Result<void> check(const GalvoSettings& s) {
    const auto range = [](const char* name, double value, double min, double max) -> Result<void> {
        if (value >= min && value <= max) return {};
        return fail(ErrorKind::refused,
                    fmt::format("the {} of the mirrors is {}; it must be {} to {}", name, value, min, max));
    };
    MOTIONRACK_CHECK(range("dead time in us", s.dead_time_us, 0, max_dead_time_us));
    MOTIONRACK_CHECK(range("natural frequency in Hz", s.natural_frequency_hz, 10, 20'000));
    MOTIONRACK_CHECK(range("damping ratio", s.damping_ratio, 0.1, 10));
    return range("maximum velocity in bits/ms", s.max_velocity_bits_ms, 1, 1e9);
}

GalvoPair::GalvoPair(const GalvoSettings& settings) : settings_(settings), limit_(settings.max_velocity_bits_ms / 100) {
    MOTIONRACK_ASSERT(check(settings).has_value());
    const double w = 2 * pi * settings.natural_frequency_hz * galvo_tick_s;  // radians per tick
    over_tick_ = exponential_of({0, 1, -w * w, -2 * settings.damping_ratio * w});
    dead_ = static_cast<std::int64_t>(settings.dead_time_us / 10);
}

void GalvoPair::reset(double x, double y) {
    const double at[2] = {x, y};
    for (std::size_t i = 0; i < 2; ++i) {
        mirrors_[i].position = at[i];
        mirrors_[i].velocity = 0;
        std::fill(mirrors_[i].late.begin(), mirrors_[i].late.end(), at[i]);
    }
}

double GalvoPair::lag_us() const {
    if (settings_.ideal_mirrors) return 0;
    return static_cast<double>(dead_) * 10 +
           1e6 * 2 * settings_.damping_ratio / (2 * pi * settings_.natural_frequency_hz);
}

double GalvoPair::step(Mirror& m, double reported) const {
    if (dead_ > 0) {
        std::swap(reported, m.late[static_cast<std::size_t>(m.head)]);
        m.head = m.head + 1 == dead_ ? 0 : m.head + 1;
    }
    const double off = m.position - reported;
    const double position = reported + (over_tick_[0] * off + over_tick_[1] * m.velocity);
    const double velocity = over_tick_[2] * off + over_tick_[3] * m.velocity;
    m.position += std::clamp(position - m.position, -limit_, limit_);
    m.velocity = std::clamp(velocity, -limit_, limit_);
    return m.position;
}

void GalvoPair::run(std::span<const std::int32_t> x, std::span<const std::int32_t> y, std::span<double> to_x,
                    std::span<double> to_y) {
    const std::size_t n = x.size();
    if (settings_.ideal_mirrors) {
        std::copy(x.begin(), x.end(), to_x.begin());
        std::copy(y.begin(), y.end(), to_y.begin());
        if (n > 0) mirrors_[0].position = to_x[n - 1], mirrors_[1].position = to_y[n - 1];
        return;
    }
    for (std::size_t i = 0; i < n; ++i) to_x[i] = step(mirrors_[0], x[i]);
    for (std::size_t i = 0; i < n; ++i) to_y[i] = step(mirrors_[1], y[i]);
}

}  // namespace motionrack::parts
