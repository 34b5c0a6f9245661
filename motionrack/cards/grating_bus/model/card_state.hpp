// The complete state of a card; trivially copyable, so a snapshot is one assignment.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/base/time.hpp>
#include <motionrack/cards/grating_bus/frame.hpp>
#include <motionrack/cards/grating_bus/map.hpp>
#include <motionrack/cards/grating_bus/model/lines.hpp>
#include <motionrack/sim/blocks/ping_pong.hpp>
#include <type_traits>

namespace motionrack::grating_bus {

/// Set of the addresses in a frame.
class TakenAddresses {
  public:
    /// Adds an address; returns true if it was not in the set.
    bool add(std::uint32_t address) {
        std::uint32_t& word = bits_[address / 32];
        const std::uint32_t bit = 1u << address % 32;
        const bool fresh = (word & bit) == 0;
        word |= bit;
        return fresh;
    }

  private:
    std::array<std::uint32_t, max_scales / 32> bits_{};
};

struct ErrorCountersState {
    /// Counted errors, in the order of their registers.
    enum Counter { broken, missed_words, alien, line_faults, missed_edges, overrun, counter_count };
    std::array<std::uint16_t, counter_count> counters{};
    std::uint32_t reported_overrun = 0;
};
using ErrorCounter = ErrorCountersState::Counter;

struct PulseState {
    Instant last_edge{-1};    ///< -1: none yet
    std::int64_t number = 0;  ///< host: number of the next pulse
    Instant next = never;     ///< instant of that pulse
    Instant fall = never;     ///< instant at which its clk falls
};

struct LineOutputsState {
    std::uint32_t clk = 0, hold = 0, read_n = 1, addr = rest_of(Line::addr);
    std::uint32_t quiet = 0;  ///< in reset: all outputs are off
};

struct FrameAgeState {
    Instant stale_at = never;
    Instant held_since{};  ///< age origin of the frame published last: its time; on a remote card, its arrival
    std::uint32_t published_sequence = 0;
    std::uint32_t any = 0;  ///< a frame was published
};

struct CardState {
    sim::PingPong<Frame> buffers;
    // the sequence
    State fsm = State::S0;
    std::uint8_t bad = 0;      ///< bits of BadFrame of the present frame
    std::uint8_t was_bad = 0;  ///< the last frame was bad and was reported
    std::uint8_t stale = 1;
    std::int32_t word = 0;
    Instant state_ends = never;
    Instant starts = never;  ///< start of a late slave
    Instant frame_time{};
    std::uint32_t frame_sequence = 0;
    // pulses and edges
    std::uint32_t sequence = 0;  ///< number of the last pulse
    PulseState pulses;
    // outputs through the shifters
    LineOutputsState outputs;
    std::uint32_t off = 0;
    FrameAgeState age;
    std::uint32_t bad_word = 0;   ///< the present word was counted as bad
    std::uint32_t asks = 0;       ///< a host has pulled READ low and not yet sampled it
    std::uint16_t other = 0;      ///< 1 + the first word of the frame whose scale differs from the card's list
    std::uint16_t was_other = 0;  ///< value of `other` of the frame published last
    TakenAddresses taken;         ///< addresses in the present frame of a slave
    std::uint32_t frames = 0;     ///< number of published frames
    ErrorCountersState errors;
    std::uint32_t fresh = 0;  ///< STATUS.FRAME
    // faults
    std::uint32_t miss = 0;  ///< number of edges to miss
    Duration late{};
    Duration jitter{};
};

static_assert(sizeof(CardState) == sizeof(sim::PingPong<Frame>) + 192, "another layout would change the state's hash");
static_assert(std::has_unique_object_representations_v<CardState>, "padding would get into the state's hash");

}  // namespace motionrack::grating_bus
