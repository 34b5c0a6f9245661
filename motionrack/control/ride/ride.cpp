#include <motionrack/control/ride/ride.hpp>

#include <algorithm>
#include <motionrack/control/ride/limits_on.hpp>
#include <utility>

namespace motionrack::control {

namespace {

constexpr double no_speed_limit = 1e300;
/// Rounds of planning a stretch, and the part of the time that must be won for another one.
constexpr int most_rounds = 4;
constexpr double worth_another = 0.995;
/// So much faster than found last it may become.
constexpr double slack = 1.25;

}  // namespace

RideState StretchView::at(double seconds) {
    const auto& feed = stretch_.feed;
    const auto& curve = stretch_.curve;
    while (feed_ + 1 < feed.size() && seconds > feed_begin_ + feed[feed_].seconds) feed_begin_ += feed[feed_++].seconds;
    const FeedState along = feed[feed_].at(std::clamp(seconds - feed_begin_, 0.0, feed[feed_].seconds));
    while (piece_ + 1 < curve.size() && along.place > curve[piece_ + 1].begin) ++piece_;
    const CurvePiece& piece = curve[piece_];
    const double x = std::clamp(along.place - piece.begin, 0.0, piece.length);
    RideState out;
    out.u = along.place;
    out.line = piece.line;
    out.place = position_on(piece, x);
    const Point tangent = tangent_on(piece, x), bend = bend_on(piece, x);
    const double v = along.speed, a = along.accel, j = along.jerk;
    for (std::size_t i = 0; i < out.place.size(); ++i) {
        out.speed[i] = tangent[i] * v;
        out.accel[i] = tangent[i] * a + bend[i] * v * v;
        out.jerk[i] = tangent[i] * j + 3 * bend[i] * v * a + piece.twist[i] * v * v * v;
    }
    if (seconds < stretch_.overlap) add_before(out, seconds);
    return out;
}

/// The last of the stretch before, which is straight there: what it has still to go is missing.
void StretchView::add_before(RideState& state, double seconds) const {
    const FeedPiece& landing = stretch_.before.feed;
    const FeedState along = landing.at(landing.seconds - stretch_.overlap + seconds);
    const double left = landing.begin + landing.length - along.place;
    for (std::size_t i = 0; i < state.place.size(); ++i) {
        const double tangent = stretch_.before.curve.tangent[i];
        state.place[i] -= tangent * left;
        state.speed[i] += tangent * along.speed;
        state.accel[i] += tangent * along.accel;
        state.jerk[i] += tangent * along.jerk;
    }
}

Ride::Ride(const MachineLimits& limits, const Point& start, OnStretch on_stretch) : limits_(limits), on_stretch_(std::move(on_stretch)), builder_(limits, start) {}

void Ride::push(const Move& move) {
    if (!builder_.has_room()) take();
    builder_.push(move);
}

void Ride::flush() {
    if (!builder_.has_room()) take();
    builder_.flush();
    take();
}

void Ride::take() {
    CurveItem item;
    while (builder_.pull(item)) {
        if (!item.rest) {
            curve_.push_back(item.piece);
            spans_.push_back(limits_on(item.piece, limits_, no_speed_limit));
            continue;
        }
        plan();
        Stretch stretch{curve_, feed_, seconds_, 0, end_, item.seconds, item.line, item.at};
        if (!curve_.empty()) {
            stretch.overlap = overlap_of(end_, {curve_.front(), feed_.front()}, room_mm_, limits_);
            end_ = {curve_.back(), feed_.back()};
        }
        room_mm_ = curve_.empty() ? 0 : item.room_mm;
        on_stretch_(stretch);
        curve_.clear();
        spans_.clear();
    }
}

/// What a bend leaves for changing the speed depends on the speed: where that turns out to be slower than it might be, there is more.
void Ride::plan() {
    feed_.clear();
    seconds_ = 0;
    if (curve_.empty()) return;
    for (int round = 0; round < most_rounds; ++round) {
        const std::span<const FeedPiece> found = planner_.plan(spans_);
        double seconds = 0;
        for (const FeedPiece& piece : found) seconds += piece.seconds;
        const bool much = seconds < worth_another * seconds_;
        if (round == 0 || seconds < seconds_) {
            feed_.assign(found.begin(), found.end());
            seconds_ = seconds;
        }
        if ((round > 0 && !much) || !narrow()) return;
    }
}

/// False: all is driven nearly as fast as was allowed.
bool Ride::narrow() {
    bool news = false;
    std::size_t k = 0;
    for (std::size_t i = 0; i < curve_.size(); ++i) {
        const double end = curve_[i].begin + curve_[i].length;
        double fastest = 0;
        for (;; ++k) {
            fastest = std::max({fastest, feed_[k].at(0).speed, feed_[k].at(feed_[k].seconds).speed});
            if (k + 1 == feed_.size() || feed_[k].begin + feed_[k].length >= end) break;
        }
        if (fastest * slack >= spans_[i].speed || is_straight(curve_[i])) continue;
        spans_[i] = limits_on(curve_[i], limits_, fastest * slack);
        news = true;
    }
    return news;
}

}  // namespace motionrack::control
