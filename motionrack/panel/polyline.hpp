// Polyline of many points in bounded memory: drops every second point when it is full.
#pragma once

#include <cstddef>
#include <motionrack/control/move.hpp>
#include <vector>

namespace motionrack::panel {

/// A point, and the program line that leads to it.
struct PathPoint {
    control::Point at = {};
    std::int32_t line = 0;
    bool feed = true;  ///< false: reached by a rapid
};

class Polyline {
  public:
    explicit Polyline(std::size_t max_points) : max_points_(max_points < 4 ? 4 : max_points) {}

    void add(const PathPoint& point) {
        last_ = point;
        pending_ = (count_++ % step_) != 0;
        if (pending_) return;
        points_.push_back(point);
        if (points_.size() < max_points_) return;
        std::size_t kept = 0;
        for (std::size_t i = 0; i < points_.size(); i += 2) points_[kept++] = points_[i];
        points_.resize(kept);
        step_ *= 2;
    }
    /// Returns the points, always with the last one.
    std::vector<PathPoint> points() const {
        std::vector<PathPoint> out = points_;
        if (pending_) out.push_back(last_);
        return out;
    }
    /// Returns n if every n-th added point is stored; a power of two.
    std::size_t step() const { return step_; }

  private:
    std::size_t max_points_, step_ = 1, count_ = 0;
    bool pending_ = false;
    PathPoint last_;
    std::vector<PathPoint> points_;
};

}  // namespace motionrack::panel
