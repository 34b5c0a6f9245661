// Rows of a section.
#include <algorithm>
#include <motionrack/control/trajectory/known_section.hpp>

namespace motionrack::control {

void KnownSection::clear() {
    curve.clear();
    programmed.clear();
    use.clear();
    feed.clear();
    planned_to = 0;
    whole = false;
    rest = {};
}

void KnownSection::append(const CubicSegment& piece) {
    curve.push_back(piece);
    programmed.push_back(piece.feed);
    use.emplace_back();
}

std::size_t KnownSection::piece_at(double position, std::size_t piece) const {
    while (piece + 1 < curve.size() && position >= curve[piece].begin + curve[piece].length) ++piece;
    return piece;
}

SegmentTuning KnownSection::use_for_stop(std::size_t piece, std::size_t& k, double planned, double above) const {
    const CubicSegment& on = curve[piece];
    SegmentTuning tuning = use[piece];
    if (is_straight(on)) return tuning;
    while (k + 1 < feed.size() && feed[k + 1].begin <= on.begin) ++k;
    for (std::size_t i = k; i < feed.size() && feed[i].begin < on.begin + on.length; ++i)
        planned = std::max({planned, feed[i].at(0).velocity, feed[i].last().velocity});
    tuning.velocity = std::min(tuning.velocity, above * planned);
    return tuning;
}

}  // namespace motionrack::control
