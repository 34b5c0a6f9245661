// Finds velocity steps of a motion from the instants of the pulses on the wires of an axis alone.
//
//   pulses   | | | ||||||||||||     |     n(t, t + w) - n(t - w, t): change of the velocity from one window of w to the
//            [--- w ---][--- w ---]        next; the part beyond the acceleration limit and the two pulses of counting
//                       t                  error is a velocity step
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <motionrack/rack/rack.hpp>
#include <motionrack/sim/position_function.hpp>
#include <vector>

namespace motionrack::test {

/// A velocity step.
struct VelocityJump {
    double velocity = 0;  ///< size, units a second
    double seconds = 0;   ///< time since the start of the rack
};

/// The pulses of one axis, each with its instant and direction.
class PulseLog final : public sim::EdgeListener {
  public:
    void edges(const sim::EdgeBatch& batch) override {
        for (std::uint32_t i = 0; i < batch.size; ++i) {
            at_.push_back(to_seconds(batch.origin + batch.tick * batch.at[i] - Instant{}));
            count_.push_back(batch.first_count + batch.step * static_cast<std::int64_t>(i));
        }
    }

    std::size_t size() const { return at_.size(); }

    /// Returns the largest step, from `window` s before and after each pulse. `accel`: pulses/s2.
    VelocityJump max_jump(double window, double accel) const {
        VelocityJump worst;
        std::size_t before = 0, after = 0;
        for (std::size_t i = 0; i < at_.size(); ++i) {
            while (at_[before] < at_[i] - window) ++before;
            while (after + 1 < at_.size() && at_[after + 1] <= at_[i] + window) ++after;
            const double change = std::fabs(static_cast<double>(way(i, after) - way(before, i)));
            const double jump = (change - rounding) / window - accel * window;
            if (jump > worst.velocity) worst = {jump, at_[i]};
        }
        return worst;
    }

  private:
    static constexpr double rounding = 2;
    std::int64_t way(std::size_t from, std::size_t to) const { return count_[to] - count_[from]; }

    std::vector<double> at_;
    std::vector<std::int64_t> count_;
};

/// The logs of all axes of a rack that has not been started.
class PulseReferee {
  public:
    explicit PulseReferee(rack::Rack& rack) : rack_(rack), logs_(rack.axes().size()) {
        for (std::size_t i = 0; i < logs_.size(); ++i) rack.axes()[i].turned_by().set_edge_listener(&logs_[i]);
    }
    ~PulseReferee() {
        for (rack::RunningAxis& axis : rack_.axes()) axis.turned_by().set_edge_listener(nullptr);
    }
    PulseReferee(const PulseReferee&) = delete;
    PulseReferee& operator=(const PulseReferee&) = delete;

    /// The largest velocity step of an axis over all windows, relative to its limit.
    struct Verdict {
        double parts = 0;
        int axis = 0;
        VelocityJump jump;
    };
    /// `accel_parts`: share of each axis' acceleration limit that explains a velocity change.
    Verdict verdict(double accel_parts = 1) {
        Verdict worst;
        for (std::size_t i = 0; i < logs_.size(); ++i) {
            const rack::RackAxis& axis = rack_.axes()[i].config;
            rack_.axes()[i].turned_by().deliver_edges();
            const double pulses = axis.pulses_per_unit();
            for (const double window : {0.002, 0.004}) {
                VelocityJump jump = logs_[i].max_jump(window, accel_parts * axis.max_accel * pulses);
                jump.velocity /= pulses;
                const double parts = jump.velocity / axis.max_velocity_step;
                if (parts > worst.parts) worst = {parts, static_cast<int>(i), jump};
            }
        }
        return worst;
    }
    const PulseLog& log(std::size_t axis) const { return logs_[axis]; }

  private:
    rack::Rack& rack_;
    std::vector<PulseLog> logs_;
};

}  // namespace motionrack::test
