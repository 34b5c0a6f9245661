// Moves to pieces to plans, and the way along them.
#include <algorithm>
#include <cmath>
#include <limits>
#include <motionrack/control/ride/parts.hpp>
#include <motionrack/control/ride/rider.hpp>
#include <utility>

namespace motionrack::control {

namespace {

/// s before it has to slow down at which a path is planned further: more than anybody passes at once.
constexpr double margin = 0.15;
/// s until another plan is sought where none was found.
constexpr double patience = 0.008;
/// Passed pieces are dropped by so many.
constexpr std::size_t least_drop = 1'024;
/// Curves carry the number of the move in the place of its line, and numbers come round.
constexpr std::int64_t tags = std::int64_t{1} << 30;

double fastest_of_axes(const CurvePiece& piece, const MachineLimits& limits) {
    const Point middle = tangent_on(piece, 0.5 * piece.length), end = tangent_on(piece, piece.length);
    return std::min({speed_along(piece.tangent, limits), speed_along(middle, limits), speed_along(end, limits)});
}

}  // namespace

void Rider::Part::clear() {
    curve.clear();
    programmed.clear();
    use.clear();
    feed.clear();
    planned_to = 0;
    whole = false;
    rest = {};
}

Rider::Rider(const MachineLimits& limits, const Point& start, RiderSettings settings)
    : limits_(limits), settings_(settings), builder_(limits, start), planner_(limits) {}

// ---- moves and pieces

void Rider::push(const RideMove& move) {
    Move tagged = move.move;
    tagged.line = static_cast<std::int32_t>(pushed_++ % tags);
    moves_.push_back(move);
    make_room();
    builder_.push(tagged);
    gather(settings_.window);
}

void Rider::flush() {
    make_room();
    flushed_ = pushed_;
    builder_.flush();
    gather(settings_.window);
}

/// A flush and a push may come together: then a few pieces more are known than the window has.
void Rider::make_room() {
    if (!builder_.has_room()) gather(std::numeric_limits<std::size_t>::max());
}

std::int64_t Rider::move_of(std::int32_t tag) const {
    return first_move_ + (tag - first_move_ % tags + tags) % tags;
}

std::int64_t Rider::first_left() const {
    if (left_ > 0 || place_ < now_.known()) return move_of(now_.curve[piece_].line);
    if (now_.whole && dwell_seconds() > 0) return move_of_rest();
    if (now_.whole && !then_.curve.empty()) return move_of(then_.curve.front().line);
    return pushed_ == flushed_ ? pushed_ : std::max(flushed_, told_);
}

void Rider::gather(std::size_t most) {
    for (;;) {
        Part& part = now_.whole ? then_ : now_;
        if (part.whole || part.curve.size() - (now_.whole ? 0 : piece_) >= most) return;
        CurveItem item;
        if (!builder_.pull(item)) return;
        told_ = move_of(item.rest ? item.line : item.piece.line);
        if (item.rest) {
            part.whole = true;
            part.rest = item;
        } else {
            for_parts(item.piece, limits_, [&](const CurvePiece& one) { append(part, one); });
        }
    }
}

void Rider::append(Part& part, const CurvePiece& piece) {
    part.curve.push_back(piece);
    part.programmed.push_back(piece.feed);
    part.use.emplace_back();
    set_feed(part, part.curve.size() - 1);
}

/// Of a piece, with the overrides.
double Rider::feed_of(const Part& part, std::size_t i) const {
    const double programmed = part.programmed[i];
    if (!moves_[static_cast<std::size_t>(move_of(part.curve[i].line) - first_move_)].overridable) return programmed;
    if (programmed < std::numeric_limits<double>::infinity()) return programmed * feed_override_;
    return rapid_override_ < 1 ? rapid_override_ * fastest_of_axes(part.curve[i], limits_) : programmed;
}

/// Without what an earlier plan knew.
void Rider::set_feed(Part& part, std::size_t i, double at_least) const {
    part.curve[i].feed = std::max(feed_of(part, i), at_least);
    part.use[i] = {};
}

void Rider::drop_passed() {
    if (piece_ < least_drop) return;
    const auto drop = [this](auto& column) {
        column.erase(column.begin(), column.begin() + static_cast<std::ptrdiff_t>(piece_));
    };
    drop(now_.curve);
    drop(now_.programmed);
    drop(now_.use);
    piece_ = 0;
    forget_moves_before(move_of(now_.curve.front().line));
}

void Rider::forget_moves_before(std::int64_t number) {
    for (; first_move_ < number; ++first_move_) moves_.pop_front();
}

void Rider::to_next_part() {
    forget_moves_before(move_of(now_.rest.line));
    std::swap(now_, then_);
    then_.clear();
    piece_ = feed_ = 0;
    place_ = on_feed_ = 0;
    reach_ = 0;
    holding_ = met_ = false;
    dwelt_ = 0;
    measure();
    gather(settings_.window);
}

void Rider::set_overrides(double feed, double rapid) {
    if (feed == feed_override_ && rapid == rapid_override_) return;
    feed_override_ = feed;
    rapid_override_ = rapid;
    new_feeds_ = true;
    patience_ = 0;
    part_from_next();
    for (std::size_t i = 0; i < then_.curve.size(); ++i) set_feed(then_, i);
}

// ---- what comes next

RideNext Rider::next(bool early) {
    for (gather(settings_.window);;) {
        if (left_ > 0) {
            tend(early);
            return RideNext::motion;
        }
        if (held_) return RideNext::nothing;
        if (place_ < now_.known()) {
            if (!is_ready(now_, piece_, early)) return RideNext::nothing;
            begin();
            continue;
        }
        if (!now_.whole) return RideNext::nothing;
        if (dwell_seconds() > 0) return RideNext::dwell;
        to_next_part();
    }
}

bool Rider::is_ready(const Part& part, std::size_t from, bool early) const {
    return part.whole || early || part.curve.size() - from >= settings_.window;
}

/// From rest, wherever on its stretch it stands.
void Rider::begin() {
    piece_ = piece_at(place_, piece_);
    drop_passed();
    holding_ = new_feeds_ = false;
    for (std::size_t i = piece_; i < now_.curve.size(); ++i) set_feed(now_, i);
    Spot here;
    here.piece = piece_;
    here.along.place = place_;
    plan_to_end(here.piece, here.along);
    take(here, 0, now_.known());
}

/// Keeps the plan ahead of the motion.
void Rider::tend(bool early) {
    if (patience_ <= 0) {
        bool tried = true, found = true;
        if (held_) {
            tried = !holding_, found = !tried || slow_down();
            if (!found) part_from_next();  // so near its end it stands there
        } else if (new_feeds_)
            found = ease_into_feeds();
        else if (holding_ || (now_.planned_to < now_.known() && left_ - braking_ <= margin))
            found = go_on();
        else
            tried = false;
        if (tried && !found) patience_ = patience;
    }
    meet_next(early);
}

/// The next stretch may begin before this one has ended.
void Rider::meet_next(bool early) {
    if (met_ || held_ || !now_.whole || now_.planned_to < now_.known() || left_ > braking_ + margin) return;
    if (then_.curve.empty() || now_.rest.seconds > 0 || !is_ready(then_, 0, early)) return;
    met_ = true;
    if (!planner_.plan({}, then_.curve, then_.use, 0, then_.known())) return;
    then_.feed.assign(planner_.feed().begin(), planner_.feed().end());
    then_.planned_to = then_.known();
    reach_ = overlap_of(slowing_end(now_.curve, now_.feed), rising_begin(then_.curve, then_.feed), left_ - before_left_,
                        now_.rest.room_mm, limits_);
}

/// It does not after all.
void Rider::part_from_next() {
    met_ = false;
    reach_ = 0;
    then_.feed.clear();
}

// ---- along the plan

Rider::Spot Rider::spot_at(double seconds) const {
    Spot out{feed_, piece_, on_feed_ + seconds, {}};
    while (out.feed + 1 < now_.feed.size() && out.on_feed > now_.feed[out.feed].seconds)
        out.on_feed -= now_.feed[out.feed++].seconds;
    out.along = now_.feed[out.feed].at(std::clamp(out.on_feed, 0.0, now_.feed[out.feed].seconds));
    if (seconds >= left_) out.along = {now_.planned_to, 0, out.along.accel, out.along.jerk};
    out.piece = piece_at(out.along.place, out.piece);
    return out;
}

/// Between two pieces it is the second, so that something of it is left.
std::size_t Rider::piece_at(double place, std::size_t piece) const {
    while (piece + 1 < now_.curve.size() && place >= now_.curve[piece].begin + now_.curve[piece].length) ++piece;
    return piece;
}

RideState Rider::at(double seconds) const {
    const Spot spot = spot_at(seconds);
    RideState out = state_on(now_.curve[spot.piece], spot.along);
    if (now_.whole && seconds >= left_ && now_.planned_to >= now_.known()) out.place = now_.rest.at;
    if (seconds < before_left_) add_landing(out, before_.end(), before_left_ - seconds);
    return out;
}

void Rider::pass(double seconds) {
    before_left_ = std::max(0.0, before_left_ - seconds);
    patience_ = std::max(0.0, patience_ - seconds);
    if (seconds >= left()) {
        if (reach_ > 0) before_.keep(slowing_end(now_.curve, now_.feed));
        before_left_ = reach_;
        if (reach_ > 0) return to_next_part();
        place_ = now_.planned_to;
        piece_ = spot_at(left_).piece;
        left_ = 0;
        now_.feed.clear();
        return;
    }
    const Spot spot = spot_at(seconds);
    feed_ = spot.feed;
    on_feed_ = spot.on_feed;
    piece_ = spot.piece;
    place_ = spot.along.place;
    left_ -= seconds;
    drop_passed();
}

}  // namespace motionrack::control
