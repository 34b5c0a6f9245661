// The laser behind its gate: when it really shines, and with what power.
//
//   gate   ____|‾‾‾‾‾‾|____
//   light  ______|‾‾‾‾‾‾‾|_      each edge later by its own delay
#pragma once

#include <cstdint>
#include <motionrack/base/result.hpp>
#include <vector>

namespace motionrack::parts {

struct LaserSettings {
    double power_w = 20;     ///< mean power while on, 0 .. 1e5
    double on_delay_us = 0;  ///< 0 .. 1e5
    double off_delay_us = 0;
};

class LaserGate {
  public:
    static Result<LaserGate> make(const LaserSettings& settings);

    /// The gate changes `half_us` half-microseconds after 0 s; in order of time.
    void change(std::int64_t half_us, bool on);

    /// Where in a tick of 10 us the laser shines, as parts of it: 0 .. 1.
    struct Light {
        double from = 0, to = 0;
    };
    /// Calls f(Light) for tick `tick`; ticks come in order, and changes of it are known.
    template <class F>
    void shine(std::int64_t tick, F&& f) {
        double cursor = 0;
        while (next_ < edges_.size() && edges_[next_].at < static_cast<double>(tick + 1)) {
            const double at = edges_[next_].at - static_cast<double>(tick);
            if (on_ && at > cursor) f(Light{cursor, at});
            if (at > cursor) cursor = at;
            on_ = edges_[next_++].on;
        }
        if (on_) f(Light{cursor, 1.0});
        if (next_ > 1024) forget();
    }
    /// Whether it may shine in this tick.
    bool dark(std::int64_t tick) const {
        return !on_ && (next_ >= edges_.size() || edges_[next_].at >= static_cast<double>(tick + 1));
    }
    double power_w() const { return settings_.power_w; }

  private:
    struct Edge {
        double at = 0;  ///< ticks
        bool on = false;
    };
    void forget();

    LaserSettings settings_;
    std::vector<Edge> edges_;
    std::size_t next_ = 0;
    bool on_ = false;
};

}  // namespace motionrack::parts
