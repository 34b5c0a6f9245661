// Counts agreeing and differing frames.
#include <algorithm>
#include <motionrack/rack/frame_monitor.hpp>

namespace motionrack::rack {

namespace gb = grating_bus;

FrameMonitor::FrameMonitor(Rack& rack) : rack_(rack), bus_(*grating_bus_of(rack)) {
    MOTIONRACK_ASSERT(!rack.started());
    for (gb::Card* card : bus_.cards()) {
        WatchedCard& watched = cards_.emplace_back();
        watched.card = card;
        watched.name = rack.kernel().device_name(card->id());
        card->add_listener(*this);
    }
}

FrameMonitor::WatchedCard& FrameMonitor::watched(const gb::Card& card) {
    return *std::find_if(cards_.begin(), cards_.end(), [&](const WatchedCard& one) { return one.card == &card; });
}

void FrameMonitor::began(const gb::Card& card, Instant now) {
    WatchedCard& own = watched(card);
    if (bus_.decoders().empty()) return;
    const gb::Decoder& decoder = *bus_.decoders()[0];
    for (int n = 0; n < decoder.settings().scales; ++n) own.truth[static_cast<std::size_t>(n)] = decoder.count(n, now);
}

/// Returns true if a count of the frame differs from that of its scale at the start of the frame. A host's frame
/// contains its configured scales, a slave's the addressed ones.
bool FrameMonitor::untrue(const WatchedCard& own, const gb::Frame& frame) {
    for (std::uint32_t k = 0; k < frame.words; ++k) {
        const int address =
            own.card->is_host() ? own.card->settings().address(static_cast<int>(k)) : int{frame.addresses[k]};
        if (frame.counts[k] != own.truth[static_cast<std::size_t>(address)]) return true;
    }
    return false;
}

void FrameMonitor::published(const gb::Card& card, const gb::Frame& frame, Instant) {
    ++published_;
    WatchedCard& own = watched(card);
    ++own.frames;
    if (card.is_remote()) return;  // scales of another crate, and its time
    own.untrue += untrue(own, frame);
    const Duration apart = frame.instant() - first_.instant();
    if (first_.words == 0 || apart > card.settings().period / 2 || apart < -card.settings().period / 2)
        first_ = frame;
    else
        own.unlike += !gb::same(frame, first_);
}

std::vector<FrameRow> FrameMonitor::rows() const {
    std::vector<FrameRow> out;
    const Instant now = rack_.kernel().now();
    for (const WatchedCard& own : cards_) {
        FrameRow& row = out.emplace_back();
        row.card = own.name;
        row.role = own.card->is_host() ? "host" : own.card->is_remote() ? "remote" : "slave";
        row.stale = own.card->stale();
        row.off = own.card->off();
        row.frame = own.card->last();
        row.age_us = row.frame ? to_seconds(now - own.card->held_since()) * 1e6 : 0;
        row.frames = own.frames;
        row.broken = own.card->counter(gb::Card::broken);
        row.untrue = own.untrue;
        row.unlike = own.unlike;
        const gb::Frame* of_first = out.front().frame;
        row.agrees =
            own.card->is_remote() || (row.frame && of_first ? gb::same(*row.frame, *of_first) : row.frame == of_first);
    }
    return out;
}

}  // namespace motionrack::rack
