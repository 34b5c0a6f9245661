// Monitor of grating-bus frames: content of every card, agreement of the cards, and a frame as a picture.
//
//   cards ──published──► FrameMonitor ──► rows of a table
//   bus, decoder ───────────┘             agreement with the host, with the scales' true positions
#pragma once

#include <motionrack/rack/grating_card.hpp>
#include <optional>
#include <string>
#include <vector>

namespace motionrack::rack {

/// Frame content of a card of the bus.
struct FrameRow {
    std::string card;
    std::string_view role;  ///< "host", "slave" or "remote"
    bool stale = true;
    bool off = false;
    const grating_bus::Frame* frame = nullptr;  ///< nullptr: no frame yet; valid until the rack runs again
    double age_us = 0;
    std::uint64_t frames = 0;  ///< published since the monitor started
    std::uint64_t broken = 0;  ///< bad frames, not published
    std::uint64_t untrue = 0;  ///< published frames whose counts differ from the scales' counts at the frame's time
    std::uint64_t unlike = 0;  ///< published frames that differ from the first card's at the same time; remote cards
                               ///< have no `unlike` and no `untrue`
    bool agrees = false;       ///< frame equal to that of the first card, or both have none
};

class FrameMonitor final : private grating_bus::FrameListener {
  public:
    /// Call before the rack starts. The rack must have a grating bus.
    explicit FrameMonitor(Rack& rack);

    std::vector<FrameRow> rows() const;
    const grating_bus::Bus& bus() const { return bus_; }
    /// Number of frames published by all cards.
    std::uint64_t published() const { return published_; }

  private:
    struct WatchedCard {
        const grating_bus::Card* card = nullptr;
        std::string name;
        std::uint64_t frames = 0, untrue = 0, unlike = 0;
        std::array<std::uint32_t, grating_bus::max_scales> truth{};  ///< counts of all scales when the frame began
    };
    WatchedCard& watched(const grating_bus::Card& card);
    static bool untrue(const WatchedCard& own, const grating_bus::Frame& frame);
    void began(const grating_bus::Card& card, Instant now) override;
    void published(const grating_bus::Card& card, const grating_bus::Frame& frame, Instant now) override;

    Rack& rack_;
    grating_bus::Bus& bus_;
    std::vector<WatchedCard> cards_;
    grating_bus::Frame first_;  ///< first frame of the present period
    std::uint64_t published_ = 0;
};

/// Draws one frame of the rack as waves: states of all cards, every line of the bus. Builds a new rack and runs it to
/// the end of frame number `frame`. Errors: refused if the rack has no grating bus or no card reads a frame.
Result<std::string> frame_picture(const RackConfig& config, int frame = 1);

}  // namespace motionrack::rack
