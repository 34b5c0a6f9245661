// Runs a rack from frame to frame.
#include <fmt/format.h>

#include <motionrack/rack/frame_stepper.hpp>
#include <motionrack/rack/grating_card.hpp>
#include <string>

namespace motionrack::rack {

Result<std::unique_ptr<FrameStepper>> FrameStepper::create(Rack& rack, std::string_view name) {
    grating_bus::Card* found = nullptr;
    std::string known;
    for (const auto& each : rack.cards()) {
        grating_bus::Card* card = grating_card_of(rack, each->name());
        if (!card) continue;
        known += (known.empty() ? "" : ", ") + each->name();
        if (!found && (name.empty() ? card->is_host() : each->name() == name)) found = card;
    }
    if (known.empty())
        return fail(ErrorKind::invalid_input, "The rack has no grating_bus card and thus no frames. Nothing was done.");
    if (!found && name.empty())
        return fail(
            ErrorKind::invalid_input,
            fmt::format("No card of the rack's grating bus is its host; name the card to read: {}. Nothing was done.",
                        known));
    if (!found)
        return fail(
            ErrorKind::invalid_input,
            fmt::format("The rack's grating bus has no card '{}'; its cards are: {}. Nothing was done.", name, known));
    std::unique_ptr<FrameStepper> out(new FrameStepper(rack, *found));
    found->add_listener(*out);
    return out;
}

void FrameStepper::published(const grating_bus::Card&, const grating_bus::Frame& frame, Instant) {
    frame_ = frame;
    came_ = true;
    rack_.kernel().break_run();
}

void FrameStepper::next(grating_bus::Frame& frame, const std::function<void()>& between) {
    sim::Kernel& kernel = rack_.kernel();
    const Instant until = kernel.now() + period();
    came_ = false;
    while (!came_ && kernel.now() < until) {
        kernel.run_until(until);
        if (between) between();
    }
    if (take(frame)) return;
    frame.words = 0;
    frame.time = kernel.now().count();
}

bool FrameStepper::take(grating_bus::Frame& frame) {
    if (!came_) return false;
    frame = frame_;
    came_ = false;
    return true;
}

}  // namespace motionrack::rack
