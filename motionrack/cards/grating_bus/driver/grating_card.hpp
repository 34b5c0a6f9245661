// The function library of a motion card on a grating bus: what the processor's program calls to have the positions of
// one instant. It knows the card only by a register port, so it cannot tell a virtual card from a real one.
//
//   wait: FRAME? ─► CLAIM ─► header, counts, CRC ─► RELEASE ─► Reading
//
// The claimed buffer is not written by the card, so a reading is never torn, whatever time it takes.
#pragma once

#include <array>
#include <motionrack/base/port.hpp>
#include <motionrack/base/result.hpp>
#include <motionrack/cards/grating_bus/map.hpp>
#include <span>

namespace motionrack::grating_bus {

/// How a card is set, as its registers say.
struct CardInfo {
    bool host = false;
    bool checks = false;
    bool wrong_direction = false;                 ///< a level shifter does not fit the role
    int scales = 0;                               ///< N
    int first = 0;                                ///< address of the first scale
    std::array<std::uint8_t, max_scales> list{};  ///< addresses of the card's own list
    Timing timing;
    Duration period{};
    /// The card's own list: address of the scale of each word.
    std::span<const std::uint8_t> addresses() const { return {list.data(), static_cast<std::size_t>(scales)}; }
};

/// What went wrong on the bus since the last clear_errors(), each at most 65,535.
struct CardErrors {
    std::uint16_t broken = 0;  ///< frames that were not published
    std::uint16_t missed_words = 0;
    std::uint16_t alien = 0;
    std::uint16_t lines = 0;
    std::uint16_t missed_edges = 0;
    std::uint16_t overrun = 0;
};

/// Positions of one instant.
struct Reading {
    Frame frame;
    std::array<std::int64_t, max_scales> positions{};  ///< counts, extended beyond 32 bits from reading to reading
    std::span<const std::int64_t> counts() const { return {positions.data(), frame.words}; }
    /// Address of the scale of each word, 0 .. 127: those that the host addressed.
    std::span<const std::uint8_t> addresses() const { return {frame.addresses.data(), frame.words}; }
};

class GratingCard {
  public:
    GratingCard(RegisterPort& port, Interrupt& interrupt) : port_(port), interrupt_(interrupt) {}

    /// Looks whether such a card answers. Errors: refused, with what answered.
    Result<CardInfo> open();

    /// The frame published last. Errors: refused if there is none yet, if it is stale (two periods old), or if its CRC
    /// is wrong; the last positions are kept.
    Result<Reading> read();
    /// Waits for a frame that was not read yet, and reads it. Errors: refused after `timeout`, stopped where the user
    /// asked to stop, and those of read().
    Result<Reading> wait(Duration timeout);
    /// From now on the scale with the address `n` (0 .. 127) counts from `count` on where the next reading's low 32
    /// bits allow it.
    void set_position(int n, std::int64_t count) { before_[static_cast<std::size_t>(n)] = count; }

    /// Of the frame read last, the address of the scale of each word; empty before the first.
    std::span<const std::uint8_t> addresses() const { return {addresses_.data(), words_}; }

    bool stale();
    CardErrors errors();
    void clear_errors();

  private:
    std::uint32_t read32(std::uint32_t at);
    Result<Reading> take();

    RegisterPort& port_;
    Interrupt& interrupt_;
    std::array<std::int64_t, max_scales> before_{};  // of each scale by its address
    std::array<std::uint8_t, max_scales> addresses_{};
    std::uint32_t words_ = 0;
};

}  // namespace motionrack::grating_bus
