// Instruments of a running rack: the tap for its recorders, and the monitor of its grating bus.
#pragma once

#include <motionrack/rack/frame_monitor.hpp>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/recorder.hpp>
#include <optional>

namespace motionrack::operate {

/// Used only by the motion thread.
class Instruments {
  public:
    /// Call before the rack starts; it must outlive this.
    explicit Instruments(rack::Rack& rack) : tap_(rack.kernel()) {
        if (rack::grating_bus_of(rack) != nullptr) frames_.emplace(rack);
    }

    /// Tap to which recorders of the running rack are attached.
    rack::RecorderTap& tap() { return tap_; }
    /// Frames of the grating bus; nullptr: the rack has none.
    const rack::FrameMonitor* frames() const { return frames_ ? &*frames_ : nullptr; }

  private:
    rack::RecorderTap tap_;
    std::optional<rack::FrameMonitor> frames_;
};

}  // namespace motionrack::operate
