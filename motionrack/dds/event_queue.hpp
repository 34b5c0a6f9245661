// Events reported by a validator, and their messages.
#pragma once

#include <array>
#include <cstddef>
#include <motionrack/dds/sample.hpp>
#include <string>

namespace motionrack::dds {

enum class EventKind : std::uint8_t {
    joined,
    stale,
    fresh,
    lost,
    late,
    duplicate,
    jump,
    anew,
    wrong_crc,
    foreign,
    malformed,
    wrong_words,
    conflict,
    conflict_over,
    restart,
    takeover,
};
inline constexpr std::size_t event_kinds = 16;
const char* name_of(EventKind kind);

struct BusEvent {
    EventKind kind = EventKind::joined;
    Instant when{};
    PublisherIdentity source, other;  ///< the owner of the bus, and the other source of a conflict, restart or takeover
    std::uint64_t number = 0;         ///< value in the message: frames lost, N seen, sequence
    std::uint64_t limit = 0;          ///< N expected, previous sequence
    std::uint64_t total = 0;          ///< total of this kind
};

/// Returns the message of an event: the event, its consequence and the remedy.
std::string sentence(const BusEvent& event);

/// Stores up to 32 events until they are read; drops further ones. put() stores every event: a caller that can have
/// many events of a kind asks open() first, so that a thousand bad frames give one report.
class EventQueue {
  public:
    static constexpr Duration min_distance = whole_seconds(1);

    /// Returns true if the last event of this kind is at least one second old, or if there was none.
    bool open(EventKind kind, Instant now) const;
    void put(const BusEvent& event);
    bool take(BusEvent& event);

  private:
    std::array<BusEvent, 32> ring_;
    std::size_t first_ = 0, count_ = 0;
    std::array<Instant, event_kinds> last_{};
    std::array<bool, event_kinds> reported_{};
};

}  // namespace motionrack::dds
