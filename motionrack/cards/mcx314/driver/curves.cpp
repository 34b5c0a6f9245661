// The generator's rule (RULES.md, one axis, without external inputs), evaluated from event to event: between two events
// the speed, the rate and their accumulators grow evenly.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <motionrack/cards/mcx314/driver/curves.hpp>
#include <motionrack/cards/mcx314/driver/parameters.hpp>
#include <motionrack/cards/mcx314/ramp.hpp>

namespace motionrack::mcx314 {

namespace {

class Walk {
  public:
    Walk(const CurveData& data, const std::function<void(const CurveSpan&)>& spans) : d_(data), spans_(spans) {
        plan_.data = data;
        jerk_ticks_ = rules::jerk_ticks_per_k * data.K;
        law_.speed = data.V > data.SV ? data.SV : data.V;
        tick_ = rules::start_ticks;
        open_ = {tick_, 0, law_.speed, 0, 0};
    }

    CurvePlan run() {
        check_final();
        // Without pulses a fixed drive ends at its first working tick.
        if (d_.pulses == 0) ++tick_, ended_ = true;
        while (!ended_) {
            const std::int64_t plain = std::min(ticks_to_speed_event(), ticks_to_special_pulse()) - 1;
            if (plain > 0) skip(plain);
            step();
        }
        flush();
        plan_.ticks = tick_;
        plan_.pulses = n_;
        plan_.reaches_v = plan_.top_v == d_.V;
        plan_.full_s = d_.s_curve && !straight_middle_;
        return plan_;
    }

  private:
    std::int64_t target() const { return final_ ? std::min(law_.speed, d_.SV) : d_.V; }
    std::int64_t limit() const { return law_.ramp < 0 && d_.asymmetric ? d_.D : d_.A; }

    std::int64_t ticks_to_speed_event() const {
        if (final_ != final_seen_ || asked_to_stop_) return 1;
        if (law_.ramp == 0) return law_.speed == target() ? (d_.pulses ? far : 1) : 1;
        return d_.s_curve ? rules::s_ticks(law_, jerk_ticks_) : rules::ticks_to_carry(law_.speed_part, limit());
    }

    /// Ticks until the pulse that ends the drive or begins its last deceleration.
    std::int64_t ticks_to_special_pulse() const {
        if (!d_.pulses) return far;
        std::int64_t pulses = *d_.pulses - n_;
        if (!final_) {
            if (d_.dec_point)
                pulses = std::min(pulses, *d_.dec_point - n_);
            else {
                const std::int64_t spare = pulses - accel_pulses_ - d_.AO;
                pulses = std::min(pulses, law_.ramp > 0 ? rules::ceil_div(std::max<std::int64_t>(spare, 0), 2) : spare);
            }
        }
        pulses = std::max<std::int64_t>(pulses, 1);
        return rules::ceil_div(pulses * d_.R - phase_, law_.speed);
    }

    CurvePart& part(int direction) {
        if (direction > 0) return plan_.rise;
        if (direction < 0) return plan_.fall;
        return final_ ? plan_.creep : plan_.cruise;
    }

    void note(int direction, std::int64_t ticks, std::int64_t rate, std::int64_t from) {
        CurvePart& at = part(direction);
        if (at.ticks == 0) at.from_v = from;
        at.to_v = law_.speed;
        at.ticks += ticks;
        if (direction != 0) at.peak_rate = std::max(at.peak_rate, rate);
        plan_.top_v = std::max({plan_.top_v, from, law_.speed});
    }

    void skip(std::int64_t ticks) {
        phase_ += ticks * law_.speed;
        const std::int64_t pulses = phase_ / d_.R;
        phase_ %= d_.R;
        n_ += pulses;
        if (law_.ramp > 0) accel_pulses_ += pulses;
        if (law_.ramp != 0) {
            if (d_.s_curve)
                rules::s_skip(law_, ticks);
            else
                law_.speed_part += ticks * limit();
        }
        tick_ += ticks;
        part(law_.ramp).pulses += pulses;
        note(law_.ramp, ticks, d_.s_curve ? law_.rate : limit(), law_.speed);
    }

    void check_final() {
        if (!d_.pulses || final_) return;
        final_ = d_.dec_point ? n_ >= *d_.dec_point : *d_.pulses - n_ <= accel_pulses_ + d_.AO;
    }

    /// One tick by the rule: pulse, then speed.
    void step() {
        ++tick_;
        const std::int64_t from = law_.speed;
        if (asked_to_stop_) asked_to_stop_ = false, final_ = stopping_ = true;
        phase_ += law_.speed;
        if (phase_ >= d_.R) {
            phase_ -= d_.R;
            ++n_;
            ++part(law_.ramp).pulses;  // the pulse that begins the deceleration is the last one before it
            if (law_.ramp > 0) ++accel_pulses_;
            plan_.end_v = law_.speed;
            if (d_.pulses && n_ >= *d_.pulses) {
                ended_ = true;
                return note(law_.ramp, 1, d_.s_curve ? law_.rate : limit(), from);
            }
            check_final();
        }
        direction_ = 0;
        if (!(stopping_ && law_.speed <= d_.SV)) {
            if (d_.s_curve)
                s_curve();
            else
                t_curve();
            final_seen_ = final_;
        }
        note(direction_, 1, law_.rate, from);
        if (law_.speed != from) flush();
        if (stopping_ && law_.speed <= d_.SV) ended_ = true;
        // A continuous drive is planned with a slow stop as soon as it reaches its speed.
        if (!d_.pulses && !final_ && law_.ramp == 0 && law_.speed == d_.V) asked_to_stop_ = true;
    }

    void t_curve() {
        const std::int64_t to = target();
        const int want = to > law_.speed ? 1 : to < law_.speed ? -1 : 0;
        if (want != law_.ramp) {
            law_.ramp = want;
            law_.speed_part = 0;
        }
        if (law_.ramp == 0) return;
        direction_ = law_.ramp;
        law_.rate = limit();
        law_.speed_part += law_.rate;
        if (law_.speed_part >= rules::speed_carry) {
            law_.speed_part -= rules::speed_carry;
            law_.speed += law_.ramp;
        }
        if (law_.speed == target()) ramp_over();
    }

    void ramp_over() {
        law_.ramp = 0;
        law_.speed_part = law_.rate_part = 0;
    }

    void s_curve() {
        if (final_ && !final_seen_ && law_.ramp > 0) ramp_over();  // the accelerating ramp is dropped
        const std::int64_t to = target();
        if (law_.ramp == 0 && law_.speed != to) {
            law_.ramp = to > law_.speed ? 1 : -1;
            rules::s_begin(law_, to, jerk_ticks_);
        }
        if (law_.ramp == 0) return;
        direction_ = law_.ramp;
        if (rules::s_tick(law_, jerk_ticks_, limit())) ramp_over();
        straight_middle_ |= law_.phase == RatePhase::constant;
    }

    /// Ends the open span and starts the next one at the present speed.
    void flush() {
        open_.ticks = tick_ - open_.tick;
        open_.ramp = direction_;
        if (spans_ && open_.ticks > 0) spans_(open_);
        open_ = {tick_, 0, law_.speed, phase_, 0};
    }

    const CurveData& d_;
    const std::function<void(const CurveSpan&)>& spans_;
    CurvePlan plan_;
    CurveSpan open_;
    std::int64_t jerk_ticks_ = 0, tick_ = 0, phase_ = 0, n_ = 0, accel_pulses_ = 0;
    Speed law_;
    int direction_ = 0;
    bool final_ = false, final_seen_ = false, stopping_ = false, asked_to_stop_ = false, ended_ = false,
         straight_middle_ = false;
};

Result<void> check(const CurveData& data) {
    struct Item {
        const Parameter& parameter;
        std::int64_t value;
        bool used;
    };
    const Item items[] = {{param::vector_range, data.R, true},
                          {param::SV, data.SV, true},
                          {param::V, data.V, true},
                          {param::A, data.A, true},
                          {param::D, data.D, data.asymmetric},
                          {param::K, data.K, data.s_curve},
                          {param::AO, data.AO, true},
                          {param::DP, data.dec_point.value_or(0), true},
                          {param::pulses, data.pulses.value_or(0), true}};
    for (const Item& item : items) {
        const std::int64_t min_value = item.parameter.code == cmd::P ? 0 : item.parameter.min;
        if (item.used && (item.value < min_value || item.value > item.parameter.max))
            return fail(ErrorKind::refused,
                        fmt::format("{} of the plan is {}; it must be {} to {}. Nothing was planned.",
                                    item.parameter.name, item.value, min_value, item.parameter.max));
    }
    return {};
}

std::int64_t fall_rate(const CurveData& data) {
    return data.asymmetric ? data.D : data.A;
}

/// Ticks until a straight ramp has made step number `n`.
std::int64_t step_tick(std::int64_t n, std::int64_t rate) {
    return rules::ceil_div(n * rules::speed_carry, rate);
}

}  // namespace

Result<CurvePlan> plan_drive(const CurveData& data, const std::function<void(const CurveSpan&)>& spans) {
    MOTIONRACK_CHECK(check(data));
    return Walk(data, spans).run();
}

Result<std::int64_t> best_dec_point(const CurveData& data) {
    MOTIONRACK_CHECK(check(data));
    if (!data.pulses)
        return fail(ErrorKind::refused,
                    "A continuous drive has no deceleration point. Nothing was planned. Give the number of pulses.");
    CurveData tried = data;
    const std::function<void(const CurveSpan&)> no_observer;
    auto ends_slow = [&](std::int64_t point) {
        tried.dec_point = point;
        return Walk(tried, no_observer).run().ends_slow();
    };
    // If the top speed is reached, its deceleration is almost the answer; otherwise the answer lies below.
    const std::int64_t guess = *data.pulses - (data.V > data.SV ? fall_pulses(data, data.V) : 0);
    std::int64_t low = 0, high = *data.pulses + 1;  // slow at low (or not found), not at high
    if (guess - 2 > low && ends_slow(guess - 2)) low = guess - 2;
    if (guess + 2 < high && guess + 2 > low && !ends_slow(guess + 2)) high = guess + 2;
    while (high - low > 1) {
        const std::int64_t middle = low + (high - low) / 2;
        (ends_slow(middle) ? low : high) = middle;
    }
    return low;
}

Result<std::int64_t> best_offset(const CurveData& data) {
    MOTIONRACK_CHECK(check(data));
    if (!data.pulses)
        return fail(ErrorKind::refused,
                    "A continuous drive needs no offset. Nothing was planned. Give the number of pulses.");
    CurveData tried = data;
    tried.dec_point.reset();
    const std::function<void(const CurveSpan&)> no_observer;
    auto ends_slow = [&](std::int64_t offset) {
        tried.AO = offset;
        return Walk(tried, no_observer).run().ends_slow();
    };
    std::int64_t low = -1, high = 0;  // too fast at low, slow at high
    while (high < param::AO.max && !ends_slow(high)) {
        low = high;
        high = std::min(param::AO.max, 2 * high + 1);
    }
    while (high - low > 1) {
        const std::int64_t middle = low + (high - low) / 2;
        (ends_slow(middle) ? high : low) = middle;
    }
    return high;
}

Result<CurveData> with_slow_end(const CurveData& data) {
    CurveData out = data;
    if (!data.pulses) return out;
    if (data.asymmetric) {
        MOTIONRACK_TRY(out.dec_point, best_dec_point(data));
    } else {
        MOTIONRACK_TRY(out.AO, best_offset(data));
    }
    return out;
}

std::int64_t fall_pulses(const CurveData& data, std::int64_t v) {
    if (v <= data.SV) return 0;
    const std::int64_t rate = fall_rate(data);
    if (data.s_curve) return rules::ceil_div(rules::s_ramp(v, data.SV, rate, data.K).phase, data.R);
    std::int64_t phase = 0, before = 0;
    for (std::int64_t n = 1; n <= v - data.SV; ++n) {
        const std::int64_t at = step_tick(n, rate);
        phase += (at - before) * (v - n + 1);
        before = at;
    }
    return rules::ceil_div(phase, data.R);
}

std::int64_t speed_after_fall(const CurveData& data, std::int64_t v, std::int64_t pulses) {
    MOTIONRACK_ASSERT(!data.s_curve);
    const std::int64_t rate = fall_rate(data);
    std::int64_t phase = 0, before = 0;
    for (std::int64_t n = 1; v > data.SV; ++n, --v) {
        const std::int64_t at = step_tick(n, rate);
        phase += (at - before) * v;
        before = at;
        if (phase >= pulses * data.R) break;
    }
    return v;
}

}  // namespace motionrack::mcx314
