// What the ride's tests share: whole rides, kept beyond the callback.
#pragma once

#include <motionrack/control/ride/ride.hpp>
#include <vector>

namespace motionrack::control::ride_test {

/// A stretch with its own pieces.
struct KeptStretch {
    std::vector<CurvePiece> curve;
    std::vector<FeedPiece> feed;
    Stretch stretch;

    explicit KeptStretch(const Stretch& from) : curve(from.curve.begin(), from.curve.end()), feed(from.feed.begin(), from.feed.end()), stretch(from) {}
    /// Valid as long as this is.
    Stretch view() const {
        Stretch out = stretch;
        out.curve = curve;
        out.feed = feed;
        return out;
    }
};

inline std::vector<KeptStretch> kept_ride(const std::vector<Move>& moves, const MachineLimits& limits, const Point& start = {}) {
    std::vector<KeptStretch> out;
    Ride ride(limits, start, [&](const Stretch& stretch) { out.emplace_back(stretch); });
    for (const Move& move : moves) ride.push(move);
    ride.flush();
    return out;
}

}  // namespace motionrack::control::ride_test
