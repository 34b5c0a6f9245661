#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "bench.hpp"

namespace howto {

namespace {

std::string lock_picture(const Record& hunting, const Record& settling) {
    trace::SvgChart chart;
    chart.title = "Position, mm";
    chart.series = {{"hunts: window 0.05 mm, 5 V at once", "x", hunting.seconds, hunting.mm},
                    {"settles: window 0.25 mm, slope", "y", settling.seconds, settling.mm}};
    return trace::svg_chart(chart, {.width = 720, .height = 360, .standalone = true});
}

/// How far it swings in the last second.
double swing(const Record& record) {
    const auto last = std::span(record.mm).last(1'000);
    return static_cast<double>(*std::max_element(last.begin(), last.end()) -
                               *std::min_element(last.begin(), last.end()));
}

}  // namespace

Result<std::string> lock() {
    Bench hunting(0, milliseconds(4)), settling(0, milliseconds(4));  // a firmware pass every 4 ms
    MOTIONRACK_CHECK(hunting.card().connect());
    MOTIONRACK_CHECK(hunting.card().set_rate(16'302));  // 5 V: 500 mm/s at once, and 5 mm of overrun
    MOTIONRACK_CHECK(hunting.card().set_deviation(5));  // the window: 0.05 mm

    SpeedScale scale{.analog = true, .counts_per_volt = 10'000};
    SlopeDemand demand{.top_speed = 20'000, .acceleration = 40'000, .deceleration = 40'000};
    demand.creep_speed = 300, demand.lag_s = 0.01;
    MOTIONRACK_TRY(const SlopeTable table, design_slope(demand, scale));
    MOTIONRACK_CHECK(settling.card().connect());
    MOTIONRACK_CHECK(settling.card().set_slope(table));
    MOTIONRACK_CHECK(settling.card().on_regulation());
    MOTIONRACK_CHECK(settling.card().set_deviation(25));  // 0.25 mm

    for (Bench* bench : {&hunting, &settling}) {
        databoard4002::Driver& card = bench->card();
        MOTIONRACK_CHECK(card.move_to_mm(500, whole_seconds(10)));
        MOTIONRACK_CHECK(card.lock());
        bench->record();
        bench->run(milliseconds(500));
        bench->push(1'000);  // pushes the carriage 10 mm aside
        bench->run(milliseconds(2'000));
        MOTIONRACK_TRY(const double mm, card.position_mm());
        fmt::print("at {:.2f} mm; in the last second it swings by {:.2f} mm\n", mm, swing(bench->recorded()));
    }
    return lock_picture(hunting.recorded(), settling.recorded());
}

}  // namespace howto
