#include "bench.hpp"

#include <motionrack/trace/svg.hpp>

namespace howto {

Bench::Bench() : port_(kernel_, chip_, chip_.id(), chip_.interrupt_wire(), nanoseconds(250)), driver_(port_, port_) {
    for (int axis = 0; axis < 4; ++axis) chip_.pulses(axis).add_listener(pens_[static_cast<std::size_t>(axis)]);
    kernel_.start();
    for (int axis = 0; axis < 4; ++axis) chip_.pulses(axis).set_edge_listener(&pens_[static_cast<std::size_t>(axis)]);
    driver_.initialise();
}

void Bench::Pen::rate_changed(double before, double rate, Instant now) {
    for (const double each : {before, rate}) {
        seconds.push_back(to_seconds(now - Instant{}));
        mm_s.push_back(static_cast<float>(each * mm_per_pulse));
    }
}

void Bench::Pen::edges(const sim::EdgeBatch& batch) {
    for (std::uint32_t i = 0; i < batch.size; ++i)
        pulses.emplace_back(batch.origin + batch.at[i] * batch.tick, batch.first_count + batch.step * std::int64_t{i});
}

std::string Bench::speeds(const std::string& title, unsigned axes) {
    trace::SvgChart chart;
    chart.title = title + ", mm/s";
    for (int axis = 0; axis < 4; ++axis) {
        const Pen& pen = pens_[static_cast<std::size_t>(axis)];
        if (!(axes >> axis & 1u)) continue;
        chart.series.push_back({std::string(1, "XYZU"[axis]), std::string(1, "xyza"[axis]), pen.seconds, pen.mm_s});
    }
    trace::SvgStyle style;
    style.standalone = true;
    style.height = 300;
    return trace::svg_chart(chart, style);
}

std::string Bench::path(const std::string& title) {
    for (int axis = 0; axis < 2; ++axis) chip_.pulses(axis).deliver_edges();
    const auto &x = pens_[0].pulses, &y = pens_[1].pulses;
    trace::ReportData data;
    data.title = title;
    data.driven.push_back({});
    data.seconds.push_back(0);
    for (std::size_t i = 0, k = 0; i < x.size() || k < y.size();) {
        const bool x_next = k == y.size() || (i < x.size() && x[i].first <= y[k].first);
        const bool y_next = i == x.size() || (k < y.size() && y[k].first <= x[i].first);
        trace::Xyz at = data.driven.back();
        data.seconds.push_back(to_seconds((x_next ? x[i] : y[k]).first - Instant{}));
        if (x_next) at[0] = static_cast<double>(x[i++].second) * mm_per_pulse;
        if (y_next) at[1] = static_cast<double>(y[k++].second) * mm_per_pulse;
        data.driven.push_back(at);
    }
    trace::SvgStyle style;
    style.standalone = true;
    style.height = 420;
    return trace::svg_path(data, trace::PathView::plan, style);
}

}  // namespace howto
