// Instruments of a running rack.
#pragma once

#include <motionrack/rack/frame_monitor.hpp>
#include <motionrack/rack/periodic_sampler.hpp>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/recorder.hpp>
#include <optional>

namespace motionrack::operate {

/// Used only by the motion thread.
class Instruments {
  public:
    /// Call before the rack starts; it must outlive this.
    explicit Instruments(rack::Rack& rack) : tap_(rack.kernel()), sampler_(rack.kernel()) {
        if (rack::grating_bus_of(rack) != nullptr) frames_.emplace(rack);
    }

    /// For recordings of on-demand pins.
    rack::WireTap& tap() { return tap_; }
    rack::PeriodicSampler& sampler() { return sampler_; }
    /// Frames of the grating bus; nullptr: the rack has none.
    const rack::FrameMonitor* frames() const { return frames_ ? &*frames_ : nullptr; }

  private:
    rack::WireTap tap_;
    rack::PeriodicSampler sampler_;
    std::optional<rack::FrameMonitor> frames_;
};

}  // namespace motionrack::operate
