// Limits that the chip and its host set for a path, in addition to the limits of the machine.
#pragma once

#include <motionrack/cards/mcx314/axes/geometry.hpp>
#include <motionrack/control/trajectory_planner.hpp>

namespace motionrack::mcx314 {

class PathRule final : public control::DriveConstraints {
  public:
    PathRule(const AxisMap& map, const HostTimes& host) : map_(map), host_(host) {}

    double max_junction_velocity(const control::Geometry& before, const control::Geometry& after) const override;
    double constant_velocity_length(const control::Geometry& path) const override;
    int max_interpolated_axes() const override { return 3; }
    double min_velocity_update_s() const override { return 0.008; }
    double velocity_ratio(const control::Geometry& before, const control::Geometry& after) const override;
    double min_seconds() const override;
    double max_velocity(const control::Geometry& path) const override;
    double late_seconds() const override { return to_seconds(host_.latency); }

  private:
    double rate_along(const control::Geometry& path, const control::Point& tangent) const;

    AxisMap map_;
    HostTimes host_;
};

}  // namespace motionrack::mcx314
