// The grating bus as a slow loop: simple and evidently correct, written from RULES.md alone. It is the oracle of the
// event-driven cards.
//
// Each instant is processed in the order of RULES.md: all cards sample the previous lines, all drivers change their
// outputs, edges act. Instants without a possible event are skipped, or also processed if `every_tick`. External
// actions (faults, stuck lines, claims) follow everything else of their instant.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <motionrack/cards/grating_bus/frame.hpp>
#include <set>
#include <vector>

namespace motionrack::grating_bus::twin {

using Ticks = std::int64_t;  ///< time in units of 0.1 ns

/// The lines of the bus; addr has 7 bits, data 32.
enum Line { clk, hold, read_n, addr, data, line_count };
inline constexpr std::array<int, line_count> width{1, 1, 1, 7, 32};
inline constexpr std::array<std::uint32_t, line_count> rest{0, 0, 1, 0x7F, 0xFFFFFFFF};
using Levels = std::array<std::uint32_t, line_count>;

struct CardSettings {
    bool host = false, clock_out = false, address_out = false, verify_lines = true;
    int first = 0, words = 1;
    std::vector<int> list;  ///< addresses of the words; empty: from `first` on
    Ticks t1 = 200, t2 = 300, t3 = 300, clock = 100, period = 2'000'000, offset = 0;
    /// Returns the delay of pulse `n`, at most `max_delay` (the fault `jitter`).
    std::function<Ticks(std::int64_t n, Ticks max_delay)> jitter;

    std::uint32_t address(int word) const {
        return static_cast<std::uint32_t>(list.empty() ? first + word : list[static_cast<std::size_t>(word)]);
    }
};

struct DecoderSettings {
    int scales = 1;
    Ticks latch = 100, output = 200;
    std::function<std::uint32_t(int scale, Ticks at)> count;
};

struct Published {
    Ticks at = 0;
    Frame frame;
    friend bool operator==(const Published& a, const Published& b) {
        return a.at == b.at && a.frame.crc == b.frame.crc && same(a.frame, b.frame);
    }
};
struct StateChange {
    Ticks at = 0;
    int state = 0;
    friend bool operator==(const StateChange&, const StateChange&) = default;
};
struct StaleChange {
    Ticks at = 0;
    bool stale = false;
    friend bool operator==(const StaleChange&, const StaleChange&) = default;
};
struct LevelChange {
    Ticks at = 0;
    Line line = clk;
    std::uint32_t level = 0;
    friend bool operator==(const LevelChange&, const LevelChange&) = default;
};

inline constexpr Ticks lasting = -1;

/// Drivers of one bit that differed from `begin` to `end` (`lasting` while they do). Drivers: cards by number, then
/// decoders.
struct Conflict {
    Ticks begin = 0, end = lasting;
    Line line = clk;
    int bit = 0;
    std::set<int> high, low;
    friend bool operator==(const Conflict&, const Conflict&) = default;
};

/// Error counters, which saturate at FFFFh, and the number of published frames, which does not.
struct Counters {
    std::uint32_t broken = 0, missed_words = 0, alien = 0, lines = 0, missed_edges = 0, overrun = 0, frames = 0;
    friend bool operator==(const Counters&, const Counters&) = default;
};

class Twin {
  public:
    Twin(std::vector<CardSettings> cards, std::vector<DecoderSettings> decoders, bool every_tick = false);

    /// Processes every instant up to and including `until`.
    void run_to(Ticks until);

    // ---- external actions, at the instant reached
    void set_off(int card, bool off);
    void reset(int card);
    void set_late(int card, Ticks late) { cards_[card].late = late; }
    void set_miss_edges(int card, int edges) { cards_[card].miss_edges = edges; }
    void set_jitter(int card, Ticks max_delay) { cards_[card].jitter_most = max_delay; }
    void set_no_latch(int decoder, bool no_latch) { decoders_[decoder].no_latch = no_latch; }
    /// Forces a bit of a line, or with `bit` -1 the whole line; the bit takes precedence.
    void force(Line line, int bit, std::uint32_t level);
    void release(Line line, int bit);
    void claim(int card);
    void give_back(int card) { cards_[card].claimed = none; }
    void clear_errors(int card);

    // ---- observations
    const Levels& levels() const { return levels_; }
    const std::vector<LevelChange>& changes() const { return changes_; }
    const std::vector<Conflict>& conflicts() const { return conflicts_; }
    const std::vector<Published>& frames(int card) const { return cards_[card].frames; }
    const std::vector<StateChange>& states(int card) const { return cards_[card].states; }
    const std::vector<StaleChange>& stale_changes(int card) const { return cards_[card].stale_changes; }
    /// Instants of the end of the first of consecutive bad frames.
    const std::vector<Ticks>& broken_rows(int card) const { return cards_[card].broken_rows; }
    const Counters& counters(int card) const { return cards_[card].counters; }
    int state(int card) const { return cards_[card].state; }
    bool frame_done(int card) const { return cards_[card].state == 12; }
    bool stale(int card) const { return cards_[card].stale; }
    /// Returns true if a frame was published since the last claim.
    bool fresh(int card) const { return cards_[card].fresh; }
    bool off(int card) const { return cards_[card].off; }
    bool claimed(int card) const { return cards_[card].claimed != none; }
    /// Returns the claimed frame; one of 0 words if none is claimed.
    Frame claimed_frame(int card) const;

  private:
    static constexpr int none = -1;
    static constexpr Ticks nothing_due = INT64_MAX;

    struct Card {
        CardSettings settings;
        // Faults.
        bool off = false;
        Ticks late = 0, jitter_most = 0;
        int miss_edges = 0;
        // The host's own clock: period n begins at offset + n * period, its pulse comes at `pulse_at`.
        std::int64_t next_period = 0;
        Ticks pulse_at = nothing_due, clock_falls = nothing_due;
        bool own_clock = false, own_clock_before = false;
        // The slave's edges.
        Ticks start_at = nothing_due, last_edge = none;
        // The sequence of states.
        int state = 0, word = 0;
        Ticks leaves_at = nothing_due, frame_time = 0;
        bool silent = false;  // after a reset, until the next pulse or edge
        bool seen_one = false;
        std::uint32_t sequence = 0, frame_sequence = 0;
        bool word_bad = false, frame_bad = false, row_bad = false;
        // Its outputs, behind the shifters.
        std::uint32_t hold_pin = 0, read_pin = 1, address_pin = rest[addr];
        bool asks = false;              // pulls READ low at this instant, and will sample it
        std::set<std::uint32_t> taken;  // addresses of the present frame
        // The buffers.
        std::array<Frame, 2> buffer;
        int filling = none, published = none, claimed = none;
        Ticks last_time = none;  // of the frame published last
        bool stale = true, fresh = false;
        // The results.
        Counters counters;
        std::vector<Published> frames;
        std::vector<StateChange> states;
        std::vector<StaleChange> stale_changes;
        std::vector<Ticks> broken_rows;
    };

    struct Decoder {
        DecoderSettings settings;
        bool no_latch = false;
        bool latched = false;  // hold is high, and its edge took the counts
        std::vector<std::uint32_t> taken;
        Ticks valid_at = 0;
        Levels seen = rest;
        Ticks read_fell = 0, address_changed = 0;
        bool put_out = false;  // requested by the present read
        std::uint32_t drives = 0;
        bool answers = false;
    };

    Ticks next_instant() const;
    void instant();
    void settle();
    void own_clock(Card& card);
    void pulse(Card& card);
    void edge(Card& card);
    void start(Card& card);
    void leave(Card& card);
    void enter(Card& card, int state);
    void sample(Card& card);
    void check_read_ended(Card& card);
    void bad_word(Card& card, std::uint32_t& counter);
    void finish(Card& card);
    void abandon(Card& card);
    void begin_anew(Card& card);
    void look_at_age(Card& card);
    Ticks duration(const Card& card) const;
    void decode(Decoder& decoder);
    Ticks ready_at(const Decoder& decoder) const;
    bool drives(int driver, Line line, std::uint32_t& level) const;
    void take_levels(Line line);
    void note_conflicts(Line line);

    std::vector<Card> cards_;
    std::vector<Decoder> decoders_;
    bool every_tick_;
    Ticks now_ = -1;
    Levels levels_ = rest;
    Levels before_ = rest;                                  // levels just before this instant
    std::map<std::pair<Line, int>, std::uint32_t> forced_;  // line and bit, or -1 -> level
    std::vector<LevelChange> changes_;
    std::vector<Conflict> conflicts_;
    std::map<std::pair<int, int>, std::size_t> lasting_;  // line and bit -> number of its conflict
};

}  // namespace motionrack::grating_bus::twin
