// Runs a rack from frame to frame of one card of its grating bus, for forwarding the frames.
#pragma once

#include <functional>
#include <memory>
#include <motionrack/cards/grating_bus/model/card.hpp>
#include <motionrack/rack/rack.hpp>
#include <string_view>

namespace motionrack::rack {

class FrameStepper final : public grating_bus::FrameListener {
  public:
    /// Follows the frames of the card of that name; "": the first host. Call before the rack starts. Errors:
    /// invalid_input, listing the available cards.
    static Result<std::unique_ptr<FrameStepper>> create(Rack& rack, std::string_view card);

    const grating_bus::Card& card() const { return card_; }
    /// Period of the bus.
    Duration period() const { return card_.settings().period; }

    /// Runs the rack until the card has published a frame, at most for a period. Returns a frame of 0 words if the card
    /// published none; the rack is at the frame's time then. `between`, which may be empty, is called at every break of
    /// the run, for faults that are due.
    void next(grating_bus::Frame& frame, const std::function<void()>& between);
    /// Copies the frame published since the last call into `frame`; returns false if there was none. For callers that
    /// run the rack themselves; call at every break of a run, which every frame causes.
    bool take(grating_bus::Frame& frame);

    void published(const grating_bus::Card& card, const grating_bus::Frame& frame, Instant now) override;

  private:
    FrameStepper(Rack& rack, grating_bus::Card& card) : rack_(rack), card_(card) {}
    Rack& rack_;
    grating_bus::Card& card_;
    grating_bus::Frame frame_;
    bool came_ = false;
};

}  // namespace motionrack::rack
