// Finds the intervals beyond each edge of the field; evaluates single ticks only in blocks that leave the field.
#include <algorithm>
#include <motionrack/cards/rtc5/model/kernels.hpp>
#include <motionrack/mark/overflow.hpp>

namespace motionrack::mark {

namespace {

struct Edge {
    std::string_view bit;
    bool y = false, upper = false;

    /// Returns the distance beyond the edge, bits; 0 or less: inside.
    double beyond(rtc5::Point p) const {
        const double v = y ? p.y : p.x;
        return upper ? v - rtc5::max_field : rtc5::min_field - v;
    }
};
constexpr std::array<Edge, 4> edges = {Edge{"FLY_X_UNDERFLOW", false, false}, Edge{"FLY_X_OVERFLOW", false, true},
                                       Edge{"FLY_Y_UNDERFLOW", true, false}, Edge{"FLY_Y_OVERFLOW", true, true}};

const rtc5::BitInfo& info_of(const Edge& edge) {
    const auto& bits = rtc5::map::marking_info_bits;
    return *std::find_if(std::begin(bits), std::end(bits),
                         [&](const rtc5::BitInfo& bit) { return bit.name == edge.bit; });
}

}  // namespace

void OverflowLog::block(const rtc5::Samples& s) {
    const bool any_open = std::any_of(edges_.begin(), edges_.end(), [](const Open& e) { return e.open; });
    if (s.corrected_x.empty()) return any_open ? finish(s.first) : void();
    const rtc5::PlanExtent e = rtc5::kernels::extent(s.corrected_x.data(), s.corrected_y.data(), s.corrected_x.size());
    const bool inside = std::all_of(edges.begin(), edges.end(), [&](const Edge& edge) {
        return edge.beyond(edge.upper ? rtc5::Point{e.max_x, e.max_y} : rtc5::Point{e.min_x, e.min_y}) <= 0;
    });
    if (inside) return any_open ? finish(s.first) : void();
    for (std::size_t i = 0; i < s.corrected_x.size(); ++i)
        sample(s.first + static_cast<std::int64_t>(i), {s.corrected_x[i], s.corrected_y[i]}, s.laser[i] > 0);
}

void OverflowLog::sample(std::int64_t tick, rtc5::Point at, bool laser) {
    for (std::size_t i = 0; i < edges.size(); ++i) {
        Open& edge = edges_[i];
        const double beyond = edges[i].beyond(at);
        if (!(beyond > 0)) {
            if (edge.open) close(i, tick);
            continue;
        }
        if (!edge.open) edge = {true, false, tick, at, 0};
        edge.beyond = std::max(edge.beyond, beyond);
        edge.marking |= laser;
    }
}

void OverflowLog::close(std::size_t i, std::int64_t tick) {
    Open& edge = edges_[i];
    edge.open = false;
    if (all_.size() == max_places) {
        ++lost_;
        return;
    }
    const rtc5::BitInfo& bit = info_of(edges[i]);
    const Spot field{edge.at.x / k_, edge.at.y / k_};
    const double from_s = static_cast<double>(edge.since) * 1e-5;
    all_.push_back({std::string(bit.name), std::string(bit.meaning), from_s, static_cast<double>(tick) * 1e-5, field,
                    track_.on_part(field, from_s), 0, edge.beyond / k_, edge.marking});
}

void OverflowLog::finish(std::int64_t tick) {
    for (std::size_t i = 0; i < edges.size(); ++i)
        if (edges_[i].open) close(i, tick);
}

}  // namespace motionrack::mark
