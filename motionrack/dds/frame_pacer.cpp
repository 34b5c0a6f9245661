// Computes the due times of frames.
#include <algorithm>
#include <motionrack/dds/frame_pacer.hpp>

namespace motionrack::dds {

Instant FramePacer::due(Instant frame, Instant now) {
    const bool begin = !begun_ || frame < first_frame_;
    if (begin) {
        begun_ = true;
        first_frame_ = frame;
        first_due_ = now;
    }
    // A time scale of 1 uses whole ticks. Other scales use a double: its 53 bits resolve one tick in a run of ten days.
    const Duration elapsed = frame - first_frame_;
    const Duration real = time_scale_ == 1
                              ? elapsed
                              : Duration{static_cast<std::int64_t>(static_cast<double>(elapsed.count()) / time_scale_)};
    const Instant due = first_due_ + real;
    const Duration behind = now - due;
    max_lateness_ = std::max(max_lateness_, behind);
    if (behind > pace_) ++late_;
    if (behind <= max_behind) return due;
    ++slips_;
    first_frame_ = frame;
    first_due_ = now;
    return now;
}

}  // namespace motionrack::dds
