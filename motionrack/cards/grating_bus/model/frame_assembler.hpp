// Assembles the frames of a card: the present one word by word, its end, and the two buffers.
//
//   words ──► [ A | B ] ──publish──► the frame published last ──claim──► processor
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/cards/grating_bus/model/card_state.hpp>
#include <motionrack/cards/grating_bus/model/error_counters.hpp>
#include <motionrack/cards/grating_bus/model/settings.hpp>

namespace motionrack::grating_bus {

/// Counts of all scales of a decoder, by address.
using Latched = std::array<std::uint32_t, max_scales>;

class FrameAssembler {
  public:
    /// Keeps references to parts of the card's `state`, which, like `settings`, must outlive this.
    FrameAssembler(CardState& state, const CardSettings& settings, ErrorCounters& errors);

    // ---- the present frame
    void begin(Instant time, std::uint32_t sequence);
    Instant time() const { return time_; }
    /// Returns the index of the present word.
    int word() const { return word_; }
    void set_word(int word) { word_ = word; }
    /// Stores address and count of the present word.
    void put(std::uint32_t address, std::uint32_t count);
    /// Takes the first `words` words from the decoder's latch.
    void put_words(const Latched& latched, int words);

    // ---- its faults
    void begin_check() { bad_word_ = 0; }
    /// Adds an address to the present frame; returns true if the frame did not have it.
    bool add_address(std::uint32_t address) { return taken_.add(address); }
    /// Counts the present word as bad, once.
    void spoil(ErrorCounter why, std::uint8_t bad);
    /// Counts a scale that differs from the card's list.
    void note_other();

    // ---- its end
    /// Completes the frame; drops a bad one and returns false. `like`: a frame with the same counts and a known CRC, or
    /// nullptr.
    bool finish(const Frame* like);
    /// Drops the present frame as bad. `why`: bits of BadFrame.
    void give_up(std::uint32_t sequence, std::uint8_t why);
    /// Publishes the current buffer, and returns its frame.
    const Frame& publish();

    // ---- the buffers
    /// Returns the buffer for a frame of another crate's bus.
    Frame& begin_remote() { return buffers_.begin(); }
    void abandon() {
        if (buffers_.begun()) buffers_.abandon();
    }
    /// Returns the frame published last; nullptr: none yet, or it is being overwritten.
    const Frame* last() const { return buffers_.last(); }
    /// Returns the claimed frame; nullptr: none.
    const Frame* held() const { return buffers_.held(); }
    void claim() { buffers_.claim(); }
    void release() { buffers_.release(); }
    /// Returns the number of published frames.
    std::uint32_t published() const { return published_; }

  private:
    const CardSettings& settings_;
    ErrorCounters& errors_;
    sim::PingPong<Frame>& buffers_;
    std::uint8_t& bad_;
    std::uint8_t& was_bad_;
    std::int32_t& word_;
    Instant& time_;
    std::uint32_t& sequence_;
    std::uint32_t& bad_word_;
    std::uint16_t& other_;
    std::uint16_t& was_other_;
    TakenAddresses& taken_;
    std::uint32_t& published_;
};

}  // namespace motionrack::grating_bus
