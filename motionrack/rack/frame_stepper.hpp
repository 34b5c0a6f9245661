// Runs a rack from frame to frame of one card of its grating bus, for those who pass frames on.
#pragma once

#include <functional>
#include <memory>
#include <motionrack/cards/grating_bus/model/card.hpp>
#include <motionrack/rack/rack.hpp>
#include <string_view>

namespace motionrack::rack {

class FrameStepper final : public grating_bus::FrameListener {
  public:
    /// Frames of the card of that name; "": of the first host. Before the rack is started. Errors: invalid_input with
    /// the cards that there are.
    static Result<std::unique_ptr<FrameStepper>> create(Rack& rack, std::string_view card);

    const grating_bus::Card& card() const { return card_; }
    /// Of the bus.
    Duration period() const { return card_.settings().period; }

    /// Runs the rack until the card has published a frame, at most for a period. A frame of 0 words: it published none,
    /// and the rack is at the frame's time. `between` is called wherever the run was broken, for faults that are due;
    /// it may be empty.
    void next(grating_bus::Frame& frame, const std::function<void()>& between);
    /// For those who run the rack otherwise, whenever a run was broken, which every frame does: the frame that came
    /// since the last call.
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
