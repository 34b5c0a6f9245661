// The publishing loop.
#include <sys/prctl.h>

#include <algorithm>
#include <motionrack/dds/clock.hpp>
#include <motionrack/dds/pacer.hpp>
#include <motionrack/dds/publishing.hpp>

namespace motionrack::dds {

namespace {

/// Sleeps in pieces, so that a stop is heeded between slow frames.
void wait_until(Instant due, const std::atomic<bool>* stop) {
    for (Instant now = monotonic_now(); now < due && !(stop && stop->load()); now = monotonic_now())
        sleep_until(std::min(due, now + milliseconds(100)));
}

}  // namespace

Result<Published> publish_frames(Publisher& publisher, FrameSource& source, const PublishingSettings& settings) {
    // Linux may add 50 us to a thread's sleeps, a quarter of the usual period.
    ::prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
    Pacer pacer(settings.speed, settings.pace);
    Published out;
    Frame frame;
    for (std::uint64_t number = 0; settings.most == 0 || number < settings.most; ++number) {
        MOTIONRACK_TRY(const bool more, source.next(frame));
        if (!more) break;
        const Instant due = pacer.due(frame.instant(), monotonic_now());
        wait_until(due, settings.stop);
        out.stopped = settings.stop && settings.stop->load();
        if (out.stopped) break;
        publisher.publish(frame);
        publisher.look();
        if (settings.report)
            for (Event event; publisher.next_event(event);) settings.report(event);
        if (settings.progress) settings.progress(publisher.sent(), monotonic_now() - due);
    }
    out.late = pacer.late();
    out.slips = pacer.slips();
    out.worst = pacer.worst();
    return out;
}

}  // namespace motionrack::dds
