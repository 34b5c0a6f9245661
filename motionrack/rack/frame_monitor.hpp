// Who looks at the frames of a rack: what every card holds, whether all agree, and a frame as a picture.
//
//   cards ──published──► FrameMonitor ──► rows of a table
//   bus, decoder ─────────────┘         agreement with the host, with the scales' true places
#pragma once

#include <motionrack/rack/grating_card.hpp>
#include <optional>
#include <string>
#include <vector>

namespace motionrack::rack {

/// What a card of the bus holds.
struct FrameRow {
    std::string card;
    std::string_view role;  ///< "host", "slave" or "remote"
    bool stale = true;
    bool off = false;
    const grating_bus::Frame* frame = nullptr;  ///< nullptr: none yet; else until the rack runs on
    double age_us = 0;
    std::uint64_t frames = 0;  ///< published since the watch began
    std::uint64_t broken = 0;  ///< bad ones, which were not
    std::uint64_t untrue = 0;  ///< of the published ones: counts that were not the scales' at the frame's time
    std::uint64_t unlike = 0;  ///< of the published ones: other than that of the first card at the same time; not of
                               ///< remote cards, nor is `untrue`
    bool agrees = false;       ///< the frame is that of the first card, or both have none
};

class FrameMonitor final : private grating_bus::FrameListener {
  public:
    /// Before the rack is started. The rack must have a grating bus.
    explicit FrameMonitor(Rack& rack);

    std::vector<FrameRow> rows() const;
    const grating_bus::Bus& bus() const { return bus_; }
    /// Frames that any card published.
    std::uint64_t published() const { return published_; }

  private:
    struct Watched {
        const grating_bus::Card* card = nullptr;
        std::string name;
        std::uint64_t frames = 0, untrue = 0, unlike = 0;
        std::array<std::uint32_t, grating_bus::max_scales> truth{};  ///< of all scales, when its frame began
    };
    Watched& watched(const grating_bus::Card& card);
    static bool untrue(const Watched& own, const grating_bus::Frame& frame);
    void began(const grating_bus::Card& card, Instant now) override;
    void published(const grating_bus::Card& card, const grating_bus::Frame& frame, Instant now) override;

    Rack& rack_;
    grating_bus::Bus& bus_;
    std::vector<Watched> cards_;
    grating_bus::Frame first_;  ///< of the present period
    std::uint64_t published_ = 0;
};

/// One frame of the rack as waves: states of all cards, every line of the bus. The rack is built anew and runs until
/// frame number `frame` is over. Errors: refused if the rack has no grating bus or no card reads a frame.
Result<std::string> frame_picture(const RackConfig& config, int frame = 1);

}  // namespace motionrack::rack
