// A path section from standstill to standstill, or its known part, with the plan on it.
#pragma once

#include <motionrack/control/path/path_builder.hpp>
#include <motionrack/control/path_velocity/profile_segment.hpp>
#include <motionrack/control/trajectory/section_planner.hpp>
#include <vector>

namespace motionrack::control {

/// All vectors except `feed` have one entry per segment.
struct KnownSection {
    std::vector<CubicSegment> curve;
    std::vector<double> programmed;  ///< feed rates without overrides
    std::vector<SegmentTuning> use;
    std::vector<ProfileSegment> feed;  ///< the plan
    double planned_to = 0;             ///< u of the end of the plan
    bool whole = false;                ///< the stop that ends the section is known
    PathElement rest;

    double known() const { return curve.empty() ? 0 : curve.back().begin + curve.back().length; }
    void clear();
    /// Adds a segment with its programmed feed rate.
    void append(const CubicSegment& piece);
    /// Returns true if a motion may start at segment `from`: the end, or `window` segments are known.
    bool is_ready(std::size_t from, std::size_t window) const { return whole || curve.size() - from >= window; }
    /// Returns the segment at u = `position`, not before `piece`. At a boundary, returns the following one, so that
    /// some of it remains.
    std::size_t piece_at(double position, std::size_t piece) const;
    /// Returns the tuning of a segment for a stop on it. Limits the velocity on a curve to `above` times the larger of
    /// `planned` and the velocity planned there. `k`: the first profile segment to inspect; set to the first one that
    /// reaches the segment.
    SegmentTuning use_for_stop(std::size_t piece, std::size_t& k, double planned, double above) const;
};

}  // namespace motionrack::control
