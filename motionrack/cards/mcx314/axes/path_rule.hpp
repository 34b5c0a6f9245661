// What the chip and its host ask of a path beside what the machine can do.
#pragma once

#include <motionrack/cards/mcx314/axes/geometry.hpp>
#include <motionrack/control/path_planner.hpp>

namespace motionrack::mcx314 {

class PathRule final : public control::DriveRule {
  public:
    PathRule(const AxisMap& map, const HostTimes& host) : map_(map), host_(host) {}

    double joint_speed(const control::Geometry& before, const control::Geometry& after) const override;
    double spent_length(const control::Geometry& path) const override;
    int most_drawn() const override { return 3; }
    double steering_seconds() const override { return 0.008; }
    double speed_ratio(const control::Geometry& before, const control::Geometry& after) const override;
    double least_seconds() const override;
    double late_seconds() const override { return to_seconds(host_.latency); }

  private:
    AxisMap map_;
    HostTimes host_;
};

}  // namespace motionrack::mcx314
