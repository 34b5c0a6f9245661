// Waits for due times, and publishes frames in a loop.
#include <sys/prctl.h>

#include <algorithm>
#include <motionrack/dds/clock.hpp>
#include <motionrack/dds/frame_publisher.hpp>

namespace motionrack::dds {

namespace {

/// Sleeps in slices of at most 100 ms, so that a stop takes effect between slow frames.
void wait_until(Instant due, const std::atomic<bool>* stop) {
    for (Instant now = monotonic_now(); now < due && !(stop && stop->load()); now = monotonic_now())
        sleep_until(std::min(due, now + milliseconds(100)));
}

}  // namespace

FramePublisher::FramePublisher(Publisher& publisher, const PublishingSettings& settings)
    : publisher_(publisher), settings_(settings), pacer_(settings.time_scale, settings.pace) {
    // By default Linux may lengthen each sleep of a thread by 50 us, a quarter of the default period.
    ::prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
}

bool FramePublisher::put(const Frame& frame) {
    const Instant due = pacer_.due(frame.instant(), monotonic_now());
    wait_until(due, settings_.stop);
    outcome_.stopped = settings_.stop && settings_.stop->load();
    if (outcome_.stopped) return false;
    if (frame.words != 0) {
        publisher_.publish(frame);
        ++frames_;
    }
    publisher_.poll();
    if (settings_.report)
        for (BusEvent event; publisher_.next_event(event);) settings_.report(event);
    if (settings_.progress) settings_.progress(publisher_.sent(), monotonic_now() - due);
    outcome_.late = pacer_.late();
    outcome_.slips = pacer_.slips();
    outcome_.max_lateness = pacer_.max_lateness();
    return settings_.max_frames == 0 || frames_ < settings_.max_frames;
}

Result<Published> publish_frames(Publisher& publisher, FrameSource& source, const PublishingSettings& settings) {
    FramePublisher publishing(publisher, settings);
    for (Frame frame;;) {
        MOTIONRACK_TRY(const bool more, source.next(frame));
        if (!more || !publishing.put(frame)) return publishing.outcome();
    }
}

}  // namespace motionrack::dds
