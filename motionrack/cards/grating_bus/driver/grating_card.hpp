// The function library of a motion card on a grating bus: the processor's program calls it to read the positions of one
// instant. It accesses the card only through a register port, so it works with a virtual card as with a real one.
//
//   wait: FRAME? ─► CLAIM ─► header, counts, CRC ─► RELEASE ─► Reading
//
// The card does not write the claimed buffer, so a reading is never torn, however long it takes.
#pragma once

#include <array>
#include <motionrack/base/port.hpp>
#include <motionrack/base/result.hpp>
#include <motionrack/cards/grating_bus/map.hpp>
#include <span>

namespace motionrack::grating_bus {

/// Configuration of a card, as its registers report it.
struct CardInfo {
    bool host = false;
    bool checks = false;
    bool wrong_direction = false;                 ///< the direction of a level shifter does not match the role
    int scales = 0;                               ///< N
    int first = 0;                                ///< address of the first scale
    std::array<std::uint8_t, max_scales> list{};  ///< addresses of the card's own list, in the order of the words
    BusTiming timing;
    Duration period{};
    /// Returns the address of the scale of each word in the card's own list.
    std::span<const std::uint8_t> addresses() const { return {list.data(), static_cast<std::size_t>(scales)}; }
};

/// Bus errors since the last clear_errors(), each at most 65,535.
struct CardErrors {
    std::uint16_t broken = 0;  ///< bad frames, which were not published
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
    /// Returns the address of the scale of each word, 0 .. 127, as the host put it on the bus.
    std::span<const std::uint8_t> addresses() const { return {frame.addresses.data(), frame.words}; }
};

class GratingCard {
  public:
    GratingCard(RegisterPort& port, Interrupt& interrupt) : port_(port), interrupt_(interrupt) {}

    /// Checks that a motion card answers. Errors: refused, with the answer.
    Result<CardInfo> open();

    /// Reads the frame published last. Errors: refused if there is none yet, if it is stale (two periods old), or if
    /// its CRC is wrong; the last positions are kept.
    Result<Reading> read();
    /// Waits for an unread frame and reads it. Errors: refused after `timeout`, stopped if the user requested a stop,
    /// and those of read().
    Result<Reading> wait(Duration timeout);
    /// Sets the 64-bit count of the scale with the address `n` (0 .. 127) near `count`; the low 32 bits come from the
    /// next reading.
    void set_position(int n, std::int64_t count) { before_[static_cast<std::size_t>(n)] = count; }

    /// Returns the address of the scale of each word of the frame read last; empty before the first frame.
    std::span<const std::uint8_t> addresses() const { return {addresses_.data(), words_}; }

    bool stale();
    CardErrors errors();
    void clear_errors();

  private:
    std::uint32_t read32(std::uint32_t at);
    Result<Reading> take();

    RegisterPort& port_;
    Interrupt& interrupt_;
    std::array<std::int64_t, max_scales> before_{};  // count of each scale by its address
    std::array<std::uint8_t, max_scales> addresses_{};
    std::uint32_t words_ = 0;
};

}  // namespace motionrack::grating_bus
