#include <fmt/format.h>

#include "bench.hpp"

namespace howto {

namespace {

void print(const char* name, const SlopeMotion& motion) {
    fmt::print("{}: {} counts in {:.3f} s; {} accelerating, {} decelerating, at most {:.0f} counts/s, {} legs\n", name,
               motion.distance, motion.duration_s, motion.accelerating, motion.decelerating, motion.top_speed,
               motion.legs.size());
}

std::string slope_picture(const SlopeMotion& empty, const SlopeMotion& loaded, const Record& driven) {
    auto a = series_of(empty), b = series_of(loaded);
    for (auto* series : {&a, &b})
        for (float& speed : series->speed) speed /= static_cast<float>(counts_per_mm);
    trace::SvgChart chart;
    chart.title = "Speed, mm/s";
    chart.series = {{"table, empty", "x", a.seconds, a.speed},
                    {"table, loaded", "z", b.seconds, b.speed},
                    {"motor, loaded", "y", driven.seconds, driven.mm_s}};
    return trace::svg_chart(chart, {.width = 720, .height = 320, .standalone = true});
}

}  // namespace

Result<std::string> slope() {
    SpeedScale scale{.analog = true, .counts_per_volt = 10'000};  // the servo's velocity per volt
    SlopeDemand demand;
    demand.top_speed = 50'000;  // counts/s: 500 mm/s
    demand.acceleration = 100'000, demand.deceleration = 60'000;
    demand.creep_speed = 800, demand.lag_s = 0.01;  // the last step, and how late the motor follows
    MOTIONRACK_TRY(const SlopeTable gentle, design_slope(demand, scale));
    MOTIONRACK_TRY(const SlopeMotion empty, motion_of(gentle, 150'000, max_rate, scale));
    print("empty ", empty);

    demand.load = 1;  // as much inertia again: both ramps become twice as long
    MOTIONRACK_TRY(const SlopeTable table, design_slope(demand, scale));
    MOTIONRACK_TRY(const SlopeMotion loaded, motion_of(table, 150'000, max_rate, scale));
    print("loaded", loaded);
    for (std::size_t i : {0u, 1u, 22u, 23u, 24u, 45u, 46u}) {
        const auto& leg = loaded.legs[i];
        fmt::print("  leg {:2}  rate {}  {:5.0f} counts/s  from {:6} to {:6}  {:.3f} s\n", i, leg.rate, leg.speed,
                   leg.from, leg.to, leg.duration_s);
    }

    Bench bench(demand.load);  // nothing has moved so far; this is the machine
    databoard4002::Driver& card = bench.card();
    MOTIONRACK_CHECK(card.connect());
    MOTIONRACK_CHECK(card.set_slope(table));
    MOTIONRACK_CHECK(card.on_regulation());
    bench.record();
    MOTIONRACK_CHECK(card.move_to_mm(1'500, whole_seconds(30)));
    MOTIONRACK_TRY(const double mm, card.position_mm());
    fmt::print("driven: at {:.2f} mm after {:.3f} s\n", mm, bench.recorded().seconds.back());
    bench.run(milliseconds(200));
    return slope_picture(empty, loaded, bench.recorded());
}

}  // namespace howto
