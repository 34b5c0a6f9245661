// The judge: decides of every sample that was heard on a bus whether its positions may be used, and counts the rest. It
// knows no network and no clock: it is given samples with the time at which they were received.
//
//   frames of the source that has the bus      used, or lost, late, twice, jumping
//   frames of any other source                 counted, never used, until the first is silent for `release`
//   foreign, damaged, malformed samples        counted, reported, never used
//
// Reports are events, at most one a second of each kind, with the count so far; events.hpp makes sentences of them.
#pragma once

#include <array>
#include <motionrack/dds/events.hpp>
#include <motionrack/dds/sample.hpp>
#include <motionrack/dds/window.hpp>
#include <span>

namespace motionrack::dds {

enum class Validation : std::uint8_t {
    used,
    duplicate,     ///< this sequence number was there already
    late,          ///< older than the frame that is held
    jump,          ///< sequence and time do not go on from the frame that is held
    wrong_crc,     ///< the frame's CRC or the sample's check is another
    foreign,       ///< of another format
    malformed,     ///< values that no publisher sends
    wrong_words,   ///< another N than expected
    other_source,  ///< another source has the bus
};
const char* name_of(Validation verdict);

struct Counts {
    std::uint64_t received = 0;  ///< all samples
    std::uint64_t used = 0;
    std::uint64_t lost = 0;  ///< sequence numbers that are missing; one that comes late is taken off again
    std::uint64_t duplicates = 0, late = 0, jumps = 0, wrong_crc = 0, foreign = 0, malformed = 0, wrong_words = 0,
                  other_source = 0;
    std::uint64_t anew = 0;       ///< the source's sequence began anew: its card was reset
    std::uint64_t restarts = 0;   ///< a new source on the same host followed
    std::uint64_t takeovers = 0;  ///< a source on another host followed
    std::uint64_t conflicts = 0;  ///< other sources that published while the first did
    std::uint64_t stale = 0;      ///< how often the data went stale
};

struct ValidatorSettings {
    int words = 0;                         ///< the N that is expected; 0: that of the source's first frame
    Duration release = milliseconds(500);  ///< a source keeps the bus until it is silent for so long, and for two paces
};

/// Another source than the one that has the bus.
struct OtherSource {
    Source source;
    std::uint64_t frames = 0;
    Instant heard{};
    bool in_conflict = false;
};

class FrameValidator {
  public:
    static constexpr std::size_t max_others = 8;

    explicit FrameValidator(const ValidatorSettings& settings = {}) : settings_(settings) {}

    /// Judges a sample that was received at `now` (never before the `now` of an earlier call). If it is used, frame()
    /// is its frame.
    Validation take(const Sample& sample, Instant now);
    /// Nothing was received until `now`: what is stale, who is gone.
    void look(Instant now);

    /// A source has the bus; all below mean something only then.
    bool joined() const { return joined_; }
    const Source& source() const { return source_; }
    const Frame& frame() const { return frame_; }
    Duration period() const { return Duration{period_}; }
    Duration pace() const { return Duration{pace_}; }
    /// Two paces without a used frame. True before the first one.
    bool stale() const { return stale_; }
    /// Since the frame that is held was received.
    Duration age(Instant now) const { return now - used_at_; }
    const Counts& counts() const { return counts_; }
    std::span<const OtherSource> others() const { return {others_.data(), other_count_}; }
    bool in_conflict() const;

    /// The next event that was not taken yet; false if there is none. Of more than the queue holds the newest are
    /// dropped.
    bool next_event(Event& event) { return events_.take(event); }

  private:
    Validation check(const Sample& sample) const;
    Validation follow(const Sample& sample, Instant now);
    Validation use(const Frame& frame, Instant now);
    Validation bad(Validation verdict, const Sample& sample, Instant now);
    void hand_bus_to(const Sample& sample, Instant now);
    void note_other(const Source& source, Instant now);
    void find_conflicts(Instant now);
    void forget_silent(Instant now);
    bool fits(const Frame& before, const Frame& after) const;
    Duration release() const;
    std::uint64_t& count_of(Validation verdict);

    ValidatorSettings settings_;
    Counts counts_;
    bool joined_ = false, stale_ = true, stale_told_ = false;
    Source source_;
    std::int64_t period_ = 0, pace_ = 0;
    Frame frame_;
    Instant used_at_{}, heard_at_{};
    SequenceWindow window_;
    bool doubtful_ = false;  ///< `doubt_` jumped; a frame that goes on from it begins the sequence anew
    Frame doubt_;
    std::array<OtherSource, max_others> others_;
    std::size_t other_count_ = 0;
    EventQueue events_;
};

}  // namespace motionrack::dds
