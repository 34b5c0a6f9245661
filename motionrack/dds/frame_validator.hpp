// Validator of the samples received on a bus: decides whether the positions of a sample may be used, and counts the
// rejected samples. It uses no network and no clock: its input is samples with reception times.
//
//   frames of the source that owns the bus     used, or lost, late, duplicate, jump
//   frames of any other source                 counted, never used, until the owner is silent for `release`
//   foreign, damaged, malformed samples        counted, reported, never used
//
// Events report these cases, with the count so far. Each kind of rejected or lost sample, and stale data, give at most
// one event per second; a new owner, a conflict, its end and the first frame after stale data are always reported.
// event_queue.hpp formats the messages.
#pragma once

#include <array>
#include <motionrack/dds/event_queue.hpp>
#include <motionrack/dds/sample.hpp>
#include <motionrack/dds/sequence_window.hpp>
#include <span>

namespace motionrack::dds {

enum class Validation : std::uint8_t {
    used,
    duplicate,     ///< this sequence number was already received
    late,          ///< older than the last used frame
    jump,          ///< sequence and time do not continue the last used frame
    wrong_crc,     ///< the frame's CRC or the sample's check does not match
    foreign,       ///< the sample's format number is not wire_format
    malformed,     ///< a value outside the range of a publisher, or another period or pace than before
    wrong_words,   ///< N differs from the expected one
    other_source,  ///< another source owns the bus
};
const char* name_of(Validation verdict);

struct Counts {
    std::uint64_t received = 0;  ///< all samples
    std::uint64_t used = 0;
    std::uint64_t lost = 0;  ///< missing sequence numbers; a late frame is subtracted again
    std::uint64_t duplicates = 0, late = 0, jumps = 0, wrong_crc = 0, foreign = 0, malformed = 0, wrong_words = 0,
                  other_source = 0;
    std::uint64_t anew = 0;       ///< the source's sequence restarted: its card was reset
    std::uint64_t restarts = 0;   ///< a new source on the same host followed
    std::uint64_t takeovers = 0;  ///< a source on another host followed
    std::uint64_t conflicts = 0;  ///< other sources that published at the same time as the owner
    std::uint64_t stale = 0;      ///< number of times the data became stale
};

struct ValidatorSettings {
    int words = 0;  ///< the expected N; 0: that of the source's first frame
    /// A source owns the bus until it is silent for this time and for two paces, whichever is longer.
    Duration release = milliseconds(500);
};

/// A source that does not own the bus.
struct OtherSource {
    PublisherIdentity source;
    std::uint64_t frames = 0;
    Instant last_received{};
    bool in_conflict = false;
};

class FrameValidator {
  public:
    static constexpr std::size_t max_others = 8;

    explicit FrameValidator(const ValidatorSettings& settings = {}) : settings_(settings) {}

    /// Validates a sample received at `now` (not before the `now` of an earlier call). frame() is then its frame if it
    /// is used.
    Validation take(const Sample& sample, Instant now);
    /// Advances the time to `now` without a sample: detects stale data and silent sources.
    void poll(Instant now);

    /// Returns true once a source has owned the bus, also after it has become silent. source(), frame(), period(),
    /// pace() and age() are valid only then.
    bool joined() const { return joined_; }
    const PublisherIdentity& source() const { return source_; }
    const Frame& frame() const { return frame_; }
    Duration period() const { return Duration{period_}; }
    Duration pace() const { return Duration{pace_}; }
    /// Returns true before the first used frame, and after two paces without one. Updated by take() and poll().
    bool stale() const { return stale_; }
    /// Returns the time since the last used frame was received.
    Duration age(Instant now) const { return now - used_at_; }
    const Counts& counts() const { return counts_; }
    std::span<const OtherSource> others() const { return {others_.data(), other_count_}; }
    bool in_conflict() const;

    /// Takes the next event; returns false if there is none. A full queue drops new events.
    bool next_event(BusEvent& event) { return events_.take(event); }

  private:
    Validation check(const Sample& sample) const;
    Validation follow(const Sample& sample, Instant now);
    Validation use(const Frame& frame, Instant now);
    Validation bad(Validation verdict, const Sample& sample, Instant now);
    void hand_bus_to(const Sample& sample, Instant now);
    void note_other(const PublisherIdentity& source, Instant now);
    void find_conflicts(Instant now);
    void forget_silent(Instant now);
    bool fits(const Frame& before, const Frame& after) const;
    Duration release() const;
    std::uint64_t& count_of(Validation verdict);

    ValidatorSettings settings_;
    Counts counts_;
    bool joined_ = false, stale_ = true, stale_reported_ = false;
    PublisherIdentity source_;
    std::int64_t period_ = 0, pace_ = 0;
    Frame frame_;
    Instant used_at_{}, heard_at_{};
    SequenceWindow window_;
    bool doubtful_ = false;  ///< `doubt_` jumped; a frame that continues it restarts the sequence
    Frame doubt_;
    std::array<OtherSource, max_others> others_;
    std::size_t other_count_ = 0;
    EventQueue events_;
};

}  // namespace motionrack::dds
