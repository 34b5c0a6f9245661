#include <algorithm>
#include <cmath>
#include <motionrack/control/path_velocity/reduced_jerk_profile.hpp>
#include <motionrack/control/rest_profiles.hpp>
#include <optional>

namespace motionrack::control {

namespace {

constexpr int max_steps = 60;
constexpr double settled_part_of_ease = 1e-14;

/// Motion from standstill to a maximum velocity, phase by phase; lengths and s.
struct Rise {
    double accel = 0;                      ///< maximum acceleration reached
    double even_from = 0, even_until = 0;  ///< velocities at which `accel` is reached, and left
    double steeper = 0, even = 0, flatter = 0;
    double steeper_way = 0, even_way = 0, flatter_way = 0;
};

/// One end of the line, seen from its standstill.
class End {
  public:
    End(double eased_way, double eased_jerk, const LimitInterval& limits)
        : way_(eased_way),
          jerk_(limits.jerk),
          max_accel_(limits.accel),
          first_(cube_root(6 * eased_way / eased_jerk)),
          accel_(eased_jerk * first_),
          velocity_(0.5 * accel_ * first_) {}

    double eased_way() const { return way_; }
    double velocity() const { return velocity_; }  ///< velocity at the end of the reduced-jerk part
    double accel() const { return accel_; }
    bool is_possible() const { return accel_ <= max_accel_; }
    /// Returns the minimum peak velocity: the acceleration falls as soon as the reduced-jerk part ends.
    double min_velocity() const { return velocity_ + 0.5 * accel_ * accel_ / jerk_; }

    Rise to(double velocity) const {
        Rise out;
        const double square = jerk_ * (velocity - velocity_) + 0.5 * accel_ * accel_;
        out.accel = std::max(accel_, std::min(max_accel_, std::sqrt(std::max(0.0, square))));
        out.steeper = (out.accel - accel_) / jerk_;
        out.flatter = out.accel / jerk_;
        out.even_from = velocity_ + 0.5 * (accel_ + out.accel) * out.steeper;
        out.even_until = velocity - 0.5 * out.accel * out.flatter;
        out.even = std::max(0.0, (out.even_until - out.even_from) / out.accel);
        out.steeper_way = out.steeper * (velocity_ + out.steeper * (0.5 * accel_ + out.steeper * jerk_ / 6));
        out.even_way = 0.5 * out.even * (out.even_from + out.even_until);
        out.flatter_way = out.flatter * (velocity - out.flatter * out.accel / 6);
        return out;
    }
    double way_to(double velocity) const {
        const Rise rise = to(velocity);
        return way_ + rise.steeper_way + rise.even_way + rise.flatter_way;
    }

  private:
    double way_, jerk_, max_accel_, first_, accel_, velocity_;
};

/// Finds the highest velocity for which the remaining length is not negative, by false position.
std::optional<double> max_reachable_velocity(const End& begin, const End& end, double length, double max_velocity) {
    const auto over = [&](double velocity) { return begin.way_to(velocity) + end.way_to(velocity) - length; };
    double low = std::max(begin.min_velocity(), end.min_velocity()), high = max_velocity;
    if (!(low <= high)) return std::nullopt;
    double over_low = over(low), over_high = over(high);
    if (over_low > 0) return std::nullopt;
    if (over_high <= 0) return high;
    int side = 0;
    for (int step = 0; step < max_steps && high - low > settled_part_of_ease * high; ++step) {
        const double velocity = (low * over_high - high * over_low) / (over_high - over_low), here = over(velocity);
        if (!(velocity > low && velocity < high)) break;
        if (here <= 0) {
            low = velocity, over_low = here;
            if (side < 0) over_high *= 0.5;
            side = -1;
        } else {
            high = velocity, over_high = here;
            if (side > 0) over_low *= 0.5;
            side = 1;
        }
    }
    return low;
}

/// Returns true if only the jerk at one or both ends differs.
bool is_eased_line(std::span<const LimitInterval> intervals, const LimitInterval& full) {
    return std::all_of(intervals.begin(), intervals.end(), [&](const LimitInterval& interval) {
        return interval.velocity == full.velocity && interval.accel == full.accel && interval.brake == full.accel &&
               interval.jerk <= full.jerk;
    });
}

}  // namespace

bool write_reduced_jerk_profile(std::span<const LimitInterval> intervals, std::vector<ProfileSegment>& out) {
    if (intervals.size() < 2 || intervals.size() > 3) return false;
    const std::size_t first = intervals.size() == 3 || intervals[0].jerk < intervals[1].jerk ? 1 : 0;
    const LimitInterval& full = intervals[first];
    if (!is_eased_line(intervals, full)) return false;
    double length = 0;
    for (const LimitInterval& interval : intervals) length += interval.length;
    const auto end_of = [&](bool there, std::size_t i) {
        return there ? End(intervals[i].length, intervals[i].jerk, full) : End(0, full.jerk, full);
    };
    const End begin = end_of(first > 0, 0), end = end_of(first + 1 < intervals.size(), intervals.size() - 1);
    if (!begin.is_possible() || !end.is_possible()) return false;
    const std::optional<double> found = max_reachable_velocity(begin, end, length, full.velocity);
    if (!found) return false;
    const double peak = *found, jerk = full.jerk;
    const Rise up = begin.to(peak), down = end.to(peak);
    double at = 0;
    const auto add = [&](double distance, double seconds, double velocity, double accel, double change) {
        if (!(seconds > 0)) return;
        out.push_back(constant_jerk_segment(at, distance, seconds, velocity, accel, change));
        at += distance;
    };
    // Without reduced jerk the first phase is the launch.
    const bool eased_begin = begin.eased_way() > 0, eased_end = end.eased_way() > 0;
    at = eased_begin ? begin.eased_way() : up.steeper_way;
    out.push_back(
        from_rest_segment(0, at, eased_begin ? begin.velocity() * begin.velocity() : up.even_from * up.even_from));
    if (eased_begin) add(up.steeper_way, up.steeper, begin.velocity(), begin.accel(), jerk);
    add(up.even_way, up.even, up.even_from, up.accel, 0);
    add(up.flatter_way, up.flatter, up.even_until, up.accel, -jerk);
    const double cruise = length - begin.way_to(peak) - end.way_to(peak);
    add(cruise, cruise / peak, peak, 0, 0);
    add(down.flatter_way, down.flatter, peak, 0, -jerk);
    add(down.even_way, down.even, down.even_until, -down.accel, 0);
    if (eased_end) add(down.steeper_way, down.steeper, down.even_from, -down.accel, jerk);
    const double landing = eased_end ? end.eased_way() : down.steeper_way,
                 landing_velocity = eased_end ? end.velocity() : down.even_from;
    out.push_back(to_rest_segment(length - landing, landing, landing_velocity * landing_velocity));
    return true;
}

}  // namespace motionrack::control
