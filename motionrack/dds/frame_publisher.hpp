// FramePublisher frames, each at its time: those that are given, or those of a source in a loop.
#pragma once

#include <atomic>
#include <functional>
#include <motionrack/dds/pacer.hpp>
#include <motionrack/dds/publisher.hpp>

namespace motionrack::dds {

/// Where frames come from: a card of a rack that runs.
class FrameSource {
  public:
    virtual ~FrameSource() = default;
    /// Runs until the next frame is complete and gives it; false: there are no more. A frame of 0 words: none came, it
    /// is for its time that the loop waits. Errors: what stopped it.
    virtual Result<bool> next(Frame& frame) = 0;
};

struct PublishingSettings {
    double speed = 1;                                                   ///< bus time that passes in a unit of real time
    Duration pace = microseconds(200);                                  ///< real time between two frames
    std::uint64_t most = 0;                                             ///< frames to publish; 0: all
    const std::atomic<bool>* stop = nullptr;                            ///< ends the loop before the next frame
    std::function<void(const Event&)> report;                           ///< is given what the publisher notices
    std::function<void(std::uint64_t sent, Duration behind)> progress;  ///< once a frame
};

struct Published {
    std::uint64_t late = 0;   ///< frames that left more than a pace after their time
    std::uint64_t slips = 0;  ///< how often the schedule began anew, more than a second behind
    Duration worst{};         ///< the greatest lateness
    bool stopped = false;
};

/// Frames in real time, one by one.
class FramePublisher {
  public:
    FramePublisher(Publisher& publisher, const PublishingSettings& settings);
    /// Waits until the frame's time and publishes it. False: that was all, or it was told to stop.
    bool put(const Frame& frame);
    const Published& outcome() const { return outcome_; }

  private:
    Publisher& publisher_;
    PublishingSettings settings_;
    FramePacer pacer_;
    Published outcome_;
    std::uint64_t frames_ = 0;
};

/// Publishes until the source ends, `most` frames are sent or `stop` is set. Errors: those of the source.
Result<Published> publish_frames(Publisher& publisher, FrameSource& source, const PublishingSettings& settings);

}  // namespace motionrack::dds
