// Levels and pockets of a lathe cycle.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/control/gcode/lathe_cycle.hpp>
#include <motionrack/control/gcode/plane_point.hpp>

namespace motionrack::control::gcode {

namespace {

/// Heights and positions with a smaller difference are equal, mm.
constexpr double same_mm = 1e-7;
constexpr double lowest_ever = -1e300;

/// Pockets that a roughing cycle cuts.
enum class Part : std::uint8_t { whole, without_pockets, pockets };

/// Collects the moves, in machine orientation; skips moves of zero length.
class Path {
  public:
    Path(const CuttingOrientation& view, PlanePoint at, std::vector<LatheMove>& moves)
        : view_(view), at_(view.in(at)), moves_(moves) {}

    PlanePoint at() const { return at_; }
    bool full() const { return moves_.size() > max_turning_moves; }
    void rapid(PlanePoint to) { add(MoveKind::rapid, to, {}, 0); }
    /// Moves to `to` above everything up to `max_height`: retracts first if an end is lower, and descends at the
    /// target.
    void over(double max_height, PlanePoint to) {
        if (std::min(at_.second, to.second) < max_height - same_mm) {
            const double clear = std::max(to.second, max_height);
            rapid({at_.first, clear});
            rapid({to.first, clear});
        }
        rapid(to);
    }
    /// Moves to the start. If it lies behind the beginning of the contour, continues to a point above the beginning.
    /// Never passes through the workpiece, neither on a slant nor where it is higher than the start.
    PlanePoint before(PlanePoint start, PlanePoint begin, double max_height) {
        rapid(start);
        if (begin.first < start.first) over(max_height, {begin.first, start.second});
        return at_;
    }
    void feed(PlanePoint to) { add(MoveKind::feed, to, {}, 0); }
    /// Moves along a segment up to a point on it. `on`: continues the arc of the previous move.
    void along(const ContourSegment& piece, PlanePoint to, bool on) {
        if (!piece.arc()) return feed(to);
        if (on && !moves_.empty() && moves_.back().kind == MoveKind::arc &&
            length(view_.in(moves_.back().centre) - piece.centre) < same_mm)
            moves_.pop_back();
        add(MoveKind::arc, to, piece.centre, piece.turns);
    }

  private:
    void add(MoveKind kind, PlanePoint to, PlanePoint centre, std::int32_t turns) {
        if (length(to - at_) < same_mm) return;
        at_ = to;
        if (!full()) moves_.push_back({kind, view_.out(to), view_.out(centre), view_.turns(turns)});
    }

    const CuttingOrientation& view_;
    PlanePoint at_;
    std::vector<LatheMove>& moves_;
};

/// Returns the point at a given height on a rising or falling segment.
PlanePoint at_height(const ContourSegment& piece, double height) {
    if (std::fabs(height - piece.to.second) <= same_mm) return piece.to;
    if (!piece.arc()) {
        const double share = (height - piece.from.second) / (piece.to.second - piece.from.second);
        return {piece.from.first + (piece.to.first - piece.from.first) * share, height};
    }
    const double radius = length(piece.from - piece.centre), over = height - piece.centre.second;
    const double half = std::sqrt(std::max(0.0, (radius - over) * (radius + over)));
    const double side = piece.from.first + piece.to.first > 2 * piece.centre.first ? half : -half;
    return {std::clamp(piece.centre.first + side, piece.from.first, piece.to.first), height};
}

double highest_of(const std::vector<ContourSegment>& contour) {
    double max_height = contour.front().from.second;
    for (const ContourSegment& piece : contour) {
        max_height = std::max(max_height, piece.to.second);
        if (piece.arc() && extremes_passed(piece.from - piece.centre, piece.to - piece.centre, piece.turns > 0)[1])
            max_height = std::max(max_height, piece.centre.second + length(piece.from - piece.centre));
    }
    return max_height;
}

/// Roughing along a monotone contour, in its own orientation.
class Rougher {
  public:
    Rougher(const LatheCycle& plan, Part part, PlanePoint start, const std::vector<ContourSegment>& contour, Path& path)
        : plan_(plan),
          part_(part),
          start_(start),
          top_(part == Part::pockets ? lowest_ever : start.second),
          contour_(contour),
          path_(path) {}

    void cut();

  private:
    /// A point on the contour.
    struct On {
        std::size_t piece;
        PlanePoint at;
    };

    double level(std::int64_t k) const { return top_ - static_cast<double>(k) * plan_.depth; }
    bool falls(std::size_t i) const { return contour_[i].to.second < contour_[i].from.second - same_mm; }
    bool rises(std::size_t i) const { return contour_[i].to.second > contour_[i].from.second + same_mm; }
    void enter();
    void pocket(std::size_t& piece);
    void pass_over(std::size_t& piece);
    void follow(On& from, On to, bool on);
    bool cut_level(PlanePoint from, const On& behind, bool outside);
    bool exit_of(double height, std::size_t from, On& exit) const;

    const LatheCycle& plan_;
    Part part_;
    PlanePoint start_;
    double top_;  ///< height of the first level: the start, or the highest pocket so far if only pockets are cut
    const std::vector<ContourSegment>& contour_;
    Path& path_;
    bool goes_on_ = false;  ///< the next segment may extend the arc of the last move
};

void Rougher::cut() {
    enter();
    for (std::size_t i = 0; i < contour_.size() && !path_.full();) {
        if (!falls(i)) {
            path_.along(contour_[i], contour_[i].to, goes_on_);
            goes_on_ = false;
            ++i;
        } else if (part_ == Part::without_pockets) {
            pass_over(i);
        } else {
            pocket(i);
        }
    }
}

/// Moves from the start down to the beginning of the contour; the workpiece has not been reached there.
void Rougher::enter() {
    const PlanePoint begin = contour_.front().from;
    start_ = path_.before(start_, begin, highest_of(contour_));
    if (part_ != Part::pockets) {
        for (std::int64_t k = 0; level(k) > begin.second + same_mm && !path_.full(); ++k) {
            const double share = (start_.second - level(k)) / (start_.second - begin.second);
            const PlanePoint from = {start_.first + (begin.first - start_.first) * share, level(k)};
            path_.rapid(from);
            if (!cut_level(from, {0, begin}, true)) break;
        }
    }
    path_.rapid(begin);
}

/// Cuts one level from `from` to the contour, and returns. Returns false if the contour never rises to it.
bool Rougher::cut_level(PlanePoint from, const On& behind, bool outside) {
    On exit{};
    if (!exit_of(from.second, behind.piece, exit)) return false;
    const double distance = exit.at.first - from.first;
    if (distance <= same_mm) return true;
    const double back = std::min(plan_.retract, distance / 2);
    path_.feed(exit.at);
    path_.rapid({exit.at.first - back, from.second + back});
    path_.rapid({from.first + back, from.second + back});
    if (outside)
        path_.rapid(from);
    else
        path_.feed(from);
    return true;
}

/// Finds the point where the contour rises to a height from below.
bool Rougher::exit_of(double height, std::size_t from, On& exit) const {
    for (std::size_t i = from; i < contour_.size(); ++i) {
        const ContourSegment& piece = contour_[i];
        if (!rises(i) || piece.to.second < height - same_mm || piece.from.second >= height - same_mm) continue;
        exit = {i, at_height(piece, std::min(height, piece.to.second))};
        return true;
    }
    return false;
}

/// Cuts a pocket, where the contour descends: its levels, then its bottom.
void Rougher::pocket(std::size_t& piece) {
    On at{piece, contour_[piece].from};
    std::size_t bottom = piece;
    for (std::size_t i = piece; i < contour_.size() && !rises(i); ++i)
        if (falls(i)) bottom = i;
    const PlanePoint bottom_point = contour_[bottom].to;
    if (part_ == Part::pockets) top_ = std::max(top_, at.at.second);
    auto k = static_cast<std::int64_t>(std::ceil((top_ - at.at.second - same_mm) / plan_.depth));
    for (k = std::max<std::int64_t>(k, 0); level(k) > bottom_point.second + same_mm && !path_.full(); ++k) {
        On down = at;
        while (contour_[down.piece].to.second > level(k) + same_mm) down = {down.piece + 1, contour_[down.piece].to};
        if (down.at.second > level(k) + same_mm) down.at = at_height(contour_[down.piece], level(k));
        follow(at, down, false);
        if (!cut_level(at.at, {at.piece, at.at}, false)) break;
    }
    follow(at, {bottom, bottom_point}, false);
    goes_on_ = true;
    piece = bottom + 1;
}

/// Moves straight to the point where the contour is as high again; along the contour if there is none.
void Rougher::pass_over(std::size_t& piece) {
    const PlanePoint top = contour_[piece].from;
    On exit{};
    if (!exit_of(top.second, piece, exit)) {
        path_.along(contour_[piece], contour_[piece].to, false);
        ++piece;
        return;
    }
    path_.feed(exit.at);
    path_.along(contour_[exit.piece], contour_[exit.piece].to, false);
    piece = exit.piece + 1;
}

void Rougher::follow(On& from, On to, bool on) {
    for (std::size_t i = from.piece; i <= to.piece; ++i)
        path_.along(contour_[i], i == to.piece ? to.at : contour_[i].to, on && i == from.piece);
    from = to;
}

/// Extends the last segment up to the height of the start.
void close(std::vector<ContourSegment>& contour, double height) {
    const ContourSegment& last = contour.back();
    if (last.to.second >= height - same_mm) return;
    ContourSegment up;
    up.from = last.to;
    up.to = {last.to.first, height};
    up.line = last.line;
    contour.push_back(up);
}

bool find_view(const LatheCycle& plan, const std::vector<ContourSegment>& contour, bool swapped,
               CuttingOrientation& view) {
    view = {};
    view.swapped = swapped;
    const double along = view.in(contour.back().to).first - view.in(contour.front().from).first;
    if (std::fabs(along) < same_mm) return false;
    view.along = along > 0 ? 1 : -1;
    double max_height = lowest_ever;
    for (const ContourSegment& piece : contour)
        max_height = std::max({max_height, view.in(piece.from).second, view.in(piece.to).second});
    const double start = view.in(plan.start).second, begin = view.in(contour.front().from).second;
    const bool above = start > begin + same_mm || (start > begin - same_mm && start >= max_height - same_mm);
    view.away = above ? 1 : -1;
    return true;
}

std::vector<ContourSegment> seen(const std::vector<ContourSegment>& contour, const CuttingOrientation& view) {
    std::vector<ContourSegment> out = contour;
    for (ContourSegment& piece : out) {
        piece.from = view.in(piece.from);
        piece.to = view.in(piece.to);
        piece.centre = view.in(piece.centre);
        piece.turns = view.turns(piece.turns);
    }
    return out;
}

/// Makes the moves of G70: passes along the contour in equal steps towards it. The return to the start avoids a part
/// that is higher than both ends.
std::string finish(const LatheCycle& plan, const CuttingOrientation& view, const std::vector<ContourSegment>& contour,
                   Path& path) {
    PlanePoint start = view.in(plan.start);
    double max_height = lowest_ever;
    for (std::int32_t left = plan.passes - 1; left >= 0 && !path.full(); --left) {
        std::vector<ContourSegment> beside;
        const double distance = plan.end_distance + (plan.distance - plan.end_distance) * left / plan.passes;
        if (std::string fault = offset_contour(contour, distance, beside); !fault.empty()) return fault;
        path.over(max_height, start);
        max_height = std::max(max_height, highest_of(beside));
        start = path.before(start, beside.front().from, max_height);
        path.rapid(beside.front().from);
        for (const ContourSegment& piece : beside) path.along(piece, piece.to, false);
    }
    return {};
}

/// Orients the contour so that it is monotone; G70 accepts both directions.
std::string in_its_view(const LatheCycle& plan, const std::vector<ContourSegment>& contour, CuttingOrientation& view,
                        std::vector<ContourSegment>& out) {
    std::string fault;
    for (const bool swapped : {false, true}) {
        const bool wanted = plan.code == 700 || swapped == (plan.code >= 720);
        if (!wanted) continue;
        const char axis = swapped ? 'X' : 'Z';
        std::string why;
        if (find_view(plan, contour, swapped, view)) {
            out = seen(contour, view);
            why = make_monotone(out, axis);
            if (why.empty()) return why;
        } else {
            why = fmt::format("the contour ends at its start along {}, so it has no depth to cut", axis);
        }
        if (fault.empty()) fault = why;
    }
    return fault;
}

}  // namespace

std::string make_lathe_moves(const LatheCycle& plan, std::vector<ContourSegment> contour, PlanePoint from,
                             std::vector<LatheMove>& moves) {
    moves.clear();
    if (std::string fault = insert_fillets(contour); !fault.empty()) return fault;
    CuttingOrientation view;
    std::vector<ContourSegment> pieces, beside;
    if (std::string fault = in_its_view(plan, contour, view, pieces); !fault.empty()) return fault;
    Path path(view, from, moves);
    if (plan.code == 700) {
        if (std::string fault = finish(plan, view, seen(contour, view), path); !fault.empty()) return fault;
    } else {
        if (std::string fault = offset_contour(seen(contour, view), plan.distance, beside); !fault.empty())
            return fault;
        if (std::string fault = make_monotone(beside, plan.code >= 720 ? 'X' : 'Z'); !fault.empty()) return fault;
        const PlanePoint start = view.in(plan.start);
        close(beside, start.second);
        constexpr Part parts[] = {Part::whole, Part::without_pockets, Part::pockets};
        Rougher(plan, parts[plan.code % 10], start, beside, path).cut();
    }
    if (path.full()) return fmt::format("it needs more than {} moves; increase I", max_turning_moves);
    return {};
}

}  // namespace motionrack::control::gcode
