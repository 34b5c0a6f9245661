// Publishes frames, each at its due time: single frames, or those of a source in a loop.
#pragma once

#include <atomic>
#include <functional>
#include <motionrack/dds/frame_pacer.hpp>
#include <motionrack/dds/publisher.hpp>

namespace motionrack::dds {

/// Source of frames: a card of a running rack.
class FrameSource {
  public:
    virtual ~FrameSource() = default;
    /// Runs until the next frame is complete and returns it; false: no more frames. A frame of 0 words says that no
    /// frame was read: the loop waits for its due time and publishes nothing. Errors: the cause of a stop.
    virtual Result<bool> next(Frame& frame) = 0;
};

struct PublishingSettings {
    double time_scale = 1;                        ///< bus time per unit of real time
    Duration pace = microseconds(200);            ///< real time between two frames
    std::uint64_t max_frames = 0;                 ///< frames to publish; 0: all
    const std::atomic<bool>* stop = nullptr;      ///< ends the loop before the next frame
    std::function<void(const BusEvent&)> report;  ///< receives each event of the publisher
    /// Called once per frame with the number of frames sent and the time since the due time of this frame.
    std::function<void(std::uint64_t sent, Duration behind)> progress;
};

struct Published {
    std::uint64_t late = 0;   ///< frames more than one pace behind their due time
    std::uint64_t slips = 0;  ///< number of times the schedule restarted because a frame was more than one second late
    Duration max_lateness{};  ///< time behind schedule of the frame that was latest
    bool stopped = false;
};

/// Publishes frames in real time, one by one.
class FramePublisher {
  public:
    FramePublisher(Publisher& publisher, const PublishingSettings& settings);
    /// Waits until the frame's due time and publishes it. Returns false after the last frame or a stop.
    bool put(const Frame& frame);
    const Published& outcome() const { return outcome_; }

  private:
    Publisher& publisher_;
    PublishingSettings settings_;
    FramePacer pacer_;
    Published outcome_;
    std::uint64_t frames_ = 0;
};

/// Publishes until the source ends, `max_frames` are sent or `stop` is set. Errors: those of the source.
Result<Published> publish_frames(Publisher& publisher, FrameSource& source, const PublishingSettings& settings);

}  // namespace motionrack::dds
