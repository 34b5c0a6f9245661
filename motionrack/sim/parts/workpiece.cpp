// Collection of marks into strokes, and their comparison with a drawing.
#include <algorithm>
#include <cmath>
#include <limits>
#include <motionrack/sim/parts/workpiece.hpp>

namespace motionrack::parts {

namespace {

double length_of(sim::Spot v) {
    return std::sqrt(v.x * v.x + v.y * v.y);
}
sim::Spot minus(sim::Spot a, sim::Spot b) {
    return {a.x - b.x, a.y - b.y};
}
constexpr double joined_mm = 1e-9;

}  // namespace

void Workpiece::add(sim::Spot from, sim::Spot to, double joules, double begun_s) {
    const sim::Spot piece = minus(to, from);
    const double mm = length_of(piece);
    state_.length += mm;
    state_.energy += joules;
    const bool joined = state_.collecting && length_of(minus(from, state_.end)) <= joined_mm;
    if (joined && mm <= joined_mm) {
        state_.dwell_j += joules;
        return;
    }
    if (joined && state_.dwell_j == 0) {
        const sim::Spot all = minus(to, state_.start);
        const double along = all.x * state_.direction.x + all.y * state_.direction.y,
                     off = all.x * state_.direction.y - all.y * state_.direction.x;
        // Uniform: the length follows the energy, except for the steps of the card's output.
        const double expected = state_.collected_j > 0 ? joules * (state_.collected_mm / state_.collected_j) : mm;
        const bool even = std::abs(mm - expected) <= std::max(0.01 * expected, 2 * settings_.tolerance_mm);
        const bool onwards = piece.x * state_.direction.x + piece.y * state_.direction.y >= 0;
        if (even && onwards && along > 0 && std::abs(off) <= settings_.tolerance_mm) {
            state_.end = to;
            state_.collected_j += joules;
            state_.collected_mm += mm;
            return;
        }
    }
    flush();
    state_.chained = joined;
    state_.collecting = true;
    state_.start = from, state_.end = to;
    state_.direction = mm > 0 ? sim::Spot{piece.x / mm, piece.y / mm} : sim::Spot{};
    const bool is_stationary = mm <= joined_mm;
    state_.collected_j = is_stationary ? 0 : joules, state_.collected_mm = is_stationary ? 0 : mm;
    state_.dwell_j = is_stationary ? joules : 0;
    state_.begun_s = begun_s;
}

void Workpiece::keep(const MarkedPoint& point) {
    if (static_cast<std::size_t>(state_.points) >= settings_.max_points) {
        ++state_.lost;
        return;
    }
    points_.resize(static_cast<std::size_t>(state_.points));
    points_.push_back(point);
    ++state_.points;
}

void Workpiece::flush() {
    if (!state_.collecting) return;
    if (!state_.chained) keep({state_.start, 0, 0, state_.begun_s, true});
    keep({state_.end, state_.collected_mm > 0 ? state_.collected_j / state_.collected_mm : 0, state_.dwell_j,
          state_.begun_s, false});
    state_.collecting = false;
}

std::optional<DrawnSegment> Workpiece::collecting() const {
    if (!state_.collecting) return std::nullopt;
    return DrawnSegment{state_.start, state_.end};
}

void Workpiece::finish() {
    flush();
}

Deviation compare(std::span<const MarkedPoint> points, std::span<const DrawnSegment> drawing, double step_mm,
                  double near_mm) {
    Deviation out;
    std::vector<DrawnSegment> marked;
    const NearestSegment wanted(drawing);
    double weights = 0, squares = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        if (points[i].first) continue;
        const DrawnSegment s{points[i - 1].at, points[i].at};
        marked.push_back(s);
        const sim::Spot delta = minus(s.to, s.from);
        const double mm = length_of(delta);
        const double samples = std::ceil(mm / step_mm) + 1;
        for (double k = 0; k < samples; ++k) {
            const double part = samples > 1 ? k / (samples - 1) : 0;
            const sim::Spot at{s.from.x + part * delta.x, s.from.y + part * delta.y};
            const double off = wanted.distance(at);
            weights += mm / samples;
            squares += off * off * (mm / samples);
            if (off > out.max_mm) out.max_mm = off, out.max_at = at, out.max_s = points[i].begun_s;
        }
    }
    if (weights > 0) out.rms_mm = std::sqrt(squares / weights);
    const NearestSegment found(marked);
    for (const DrawnSegment& s : drawing) {
        const sim::Spot delta = minus(s.to, s.from);
        const double mm = length_of(delta), samples = std::max(1.0, std::ceil(mm / step_mm));
        for (double k = 0; k < samples; ++k) {
            const double part = (k + 0.5) / samples;
            if (found.distance({s.from.x + part * delta.x, s.from.y + part * delta.y}) > near_mm)
                out.missing_mm += mm / samples;
        }
    }
    return out;
}

NearestSegment::NearestSegment(std::span<const DrawnSegment> segments) : segments_(segments.begin(), segments.end()) {
    if (segments_.empty()) return;
    sim::Spot high = low_ = segments_[0].from;
    double sum = 0;
    for (const DrawnSegment& s : segments_) {
        sum += length_of(minus(s.to, s.from));
        for (const sim::Spot& p : {s.from, s.to}) {
            low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y)};
        }
    }
    const double width = high.x - low_.x, height = high.y - low_.y;
    side_ = std::max({sum / static_cast<double>(segments_.size()), width / 500, height / 500, 1e-6});
    columns_ = static_cast<std::int64_t>(width / side_) + 1;
    rows_ = static_cast<std::int64_t>(height / side_) + 1;
    const auto each_square = [&](auto&& f) {
        for (std::size_t i = 0; i < segments_.size(); ++i) {
            const DrawnSegment& s = segments_[i];
            for (std::int64_t r = row(std::min(s.from.y, s.to.y)); r <= row(std::max(s.from.y, s.to.y)); ++r)
                for (std::int64_t c = column(std::min(s.from.x, s.to.x)); c <= column(std::max(s.from.x, s.to.x)); ++c)
                    f(static_cast<std::size_t>(r * columns_ + c), static_cast<std::uint32_t>(i));
        }
    };
    begins_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
    each_square([&](std::size_t square, std::uint32_t) { ++begins_[square + 1]; });
    for (std::size_t i = 1; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
    members_.resize(begins_.back());
    std::vector<std::uint32_t> next(begins_.begin(), begins_.end() - 1);
    each_square([&](std::size_t square, std::uint32_t i) { members_[next[square]++] = i; });
}

std::int64_t NearestSegment::column(double x) const {
    return static_cast<std::int64_t>(std::clamp((x - low_.x) / side_, 0.0, static_cast<double>(columns_ - 1)));
}
std::int64_t NearestSegment::row(double y) const {
    return static_cast<std::int64_t>(std::clamp((y - low_.y) / side_, 0.0, static_cast<double>(rows_ - 1)));
}

double NearestSegment::distance(sim::Spot p) const {
    double best2 = std::numeric_limits<double>::infinity();
    if (segments_.empty()) return best2;
    const std::int64_t c0 = column(p.x), r0 = row(p.y);
    const double slack = 1e-6 * side_ + 1e-9;  // a position at the edge may be in either square
    const auto beside = [&](double at, double low, std::int64_t square) {
        const double begin = low + static_cast<double>(square) * side_;
        return std::max({begin - slack - at, at - begin - side_ - slack, 0.0});
    };
    // A square of ring n is at least n - 1 sides away from the point's own; a point outside is further away.
    for (std::int64_t ring = 0; ring <= std::max(columns_, rows_); ++ring) {
        if (static_cast<double>(ring - 1) * side_ > std::sqrt(best2)) break;
        for (std::int64_t r = std::max<std::int64_t>(0, r0 - ring); r <= std::min(rows_ - 1, r0 + ring); ++r) {
            const bool edge_row = r == r0 - ring || r == r0 + ring;
            const double above = beside(p.y, low_.y, r);
            for (std::int64_t c = c0 - ring; c <= c0 + ring; c += edge_row || ring == 0 ? 1 : 2 * ring) {
                if (c < 0 || c >= columns_) continue;
                const double aside = beside(p.x, low_.x, c);
                if (aside * aside + above * above >= best2) continue;
                look_in(static_cast<std::size_t>(r * columns_ + c), p, best2);
            }
        }
    }
    return std::sqrt(best2);
}

void NearestSegment::look_in(std::size_t square, sim::Spot p, double& best2) const {
    for (std::uint32_t k = begins_[square]; k < begins_[square + 1]; ++k) {
        const DrawnSegment& s = segments_[members_[k]];
        const sim::Spot delta = minus(s.to, s.from), to = minus(p, s.from);
        const double square_mm = delta.x * delta.x + delta.y * delta.y;
        const double part = square_mm > 0 ? std::clamp((to.x * delta.x + to.y * delta.y) / square_mm, 0.0, 1.0) : 0;
        const sim::Spot off{to.x - part * delta.x, to.y - part * delta.y};
        best2 = std::min(best2, off.x * off.x + off.y * off.y);
    }
}

}  // namespace motionrack::parts
