#include <bit>
#include <motionrack/base/result.hpp>
#include <motionrack/control/path/junction_planner.hpp>

namespace motionrack::control {

void JunctionPlanner::begin() {
    last_ = {};
    candidates_ = {Candidate{}, Candidate{true, 0, 0}};
    known_ = decided_ = 0;
}

void JunctionPlanner::add(const LegLimits& leg, const Junction& end) {
    MOTIONRACK_ASSERT(known_ - decided_ <= max_junctions && known_ < 32);
    candidates_ = {time_optimal_to(leg, end, false), time_optimal_to(leg, end, true)};
    last_ = end;
    ++known_;
    decide();
}

JunctionPlanner::Candidate JunctionPlanner::time_optimal_to(const LegLimits& leg, const Junction& end,
                                                            bool stops) const {
    Candidate out;
    if (!(stops ? end.can_stop : end.can_pass)) return out;
    const bool one_way = candidates_[0].open != candidates_[1].open && !end.is_choice();
    for (const bool stopped : {false, true}) {
        const Candidate& candidate = candidates_[stopped];
        if (!candidate.open) continue;
        const double seconds = one_way ? 0 : candidate.seconds + leg_duration_s(leg, last_, stopped, end, stops);
        if (!out.open || seconds < out.seconds) out = {true, seconds, candidate.stops};
    }
    if (stops) out.stops |= std::uint32_t{1} << known_;
    return out;
}

/// Decides all junctions before the first one on which the two candidates differ. If too many wait, takes the faster
/// one.
void JunctionPlanner::decide() {
    decided_ = known_;
    if (!candidates_[0].open || !candidates_[1].open) return;
    decided_ = static_cast<std::size_t>(std::countr_zero(candidates_[0].stops ^ candidates_[1].stops));
    if (known_ - decided_ <= max_junctions) return;
    candidates_[candidates_[0].seconds < candidates_[1].seconds].open = false;
    decided_ = known_;
}

bool JunctionPlanner::take() {
    MOTIONRACK_ASSERT(decided_ > 0);
    const bool stop = (candidates_[candidates_[1].open].stops & 1) != 0;
    for (Candidate& candidate : candidates_) candidate.stops >>= 1;
    --known_;
    --decided_;
    return stop;
}

}  // namespace motionrack::control
