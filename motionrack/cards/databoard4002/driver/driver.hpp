// The DataBoard 4002's function library: every command with its handshake, events by polling and by interrupt. It
// accesses the card only through its ports, so it works with a virtual card as with a real one.
//
//   wait Ready ─► C2 letter ─► (wait Ready ─► DATA) per byte          each wait has a time-out
//   wait Ready ─► C4 enables ─► wait Ready ─► INP DATA = EVENT word
#pragma once

#include <cstdint>
#include <motionrack/base/port.hpp>
#include <motionrack/base/result.hpp>
#include <motionrack/cards/databoard4002/map.hpp>
#include <motionrack/cards/databoard4002/slope_table.hpp>
#include <string>

namespace motionrack::databoard4002 {

/// Maximum bounce time of a stop's contacts after an edge.
inline constexpr Duration contacts_rest = milliseconds(5);

struct DriverSettings {
    std::uint8_t select = 13;                    ///< the card's number on the bus
    Duration ready_timeout = milliseconds(127);  ///< > 0: maximum wait for Ready before an access; `never`: no limit
    Duration poll = microseconds(20);            ///< > 0: interval between two reads of STAT
    Duration bounce = contacts_rest;             ///< >= 0: settling time of a stop's contacts after an edge
    double counts_per_mm = 1000;                 ///< > 0: scale of positions in mm
};

/// STAT, decoded.
struct StatusByte {
    std::uint8_t word = 0;
    bool ready() const { return (word & stat::READY) != 0; }
    bool event() const { return (word & stat::EVENT) != 0; }
    bool interrupt() const { return (word & stat::INT) != 0; }
    bool end_stop_left() const { return (word & stat::ESL) != 0; }
    bool end_stop_right() const { return (word & stat::ESR) != 0; }
    /// Returns true if the end stop in that direction is active.
    bool end_stop(bool forward) const { return forward ? end_stop_right() : end_stop_left(); }
    bool emergency() const { return (word & stat::EMS) != 0; }
    bool reference() const { return (word & stat::REF) != 0; }
    bool zero() const { return (word & stat::ZERO) != 0; }
    /// Names the active stops for a message: "the right end stop is active"; empty if none is.
    std::string stops() const;
};

/// The EVENT word, decoded.
struct Events {
    std::uint8_t word = 0;
    bool position() const { return (word & event::POSITION) != 0; }
    bool zero() const { return (word & event::ZERO) != 0; }
    bool reference() const { return (word & event::REF) != 0; }
    bool stop() const { return (word & event::STOP) != 0; }
    bool was_reset() const { return (word & event::WATCH_OUT) != 0; }
};

enum class Waiting : std::uint8_t { polling, interrupt };

class Driver {
  public:
    Driver(BytePort& port, Interrupt& interrupt, const DriverSettings& settings = {});

    /// Connects to the card, clears the reset mark and reads the version. Errors: machine if no card answers or it
    /// never becomes Ready.
    Result<int> connect();
    /// Resets the card (C3), which clears its position, rate and slope table.
    void reset();
    StatusByte status();

    // ---- commands, one each; counts and rates in the card's units. Common errors: refused (out of range, nothing was
    // written), machine (not Ready in time)
    Result<void> athome();                            ///< A: sets the present position to 0
    Result<void> set_deviation(std::int64_t counts);  ///< D: sets the deviation that lock allows, 0 .. 8,388,607
    Result<std::int64_t> deviation();                 ///< D: reads the present minus the requested position
    Result<void> go();                                ///< G: starts the move and switches lock off
    Result<void> initialise();                        ///< I: has no effect; the maker's programs send it
    Result<void> lock();                              ///< L: goes back whenever the deviation exceeds that of D
    Result<void> manual();                            ///< M: switches slope mode and lock off
    Result<void> set_number(std::int64_t counts);     ///< N: sets the length of the move, -8,388,608 .. 8,388,607
    Result<void> on_regulation();                     ///< O: switches slope mode on, sets Rate to its maximum
    Result<void> set_target(std::int64_t counts);     ///< P: sets the target of the move, -8,388,608 .. 8,388,607
    Result<std::int64_t> position();                  ///< P: reads the counter
    Result<void> quit();                              ///< Q: stops the motor; Rate stays
    /// Returns true if the last quit() did not reach the card, which may drive on.
    bool quit_due() const { return quit_due_; }
    Result<void> set_rate(int rate);                  ///< R: sets Rate, 0 .. 16383; 0 switches the relay off
    Result<int> rate();                               ///< R: reads the rate, negative backwards, 0 at standstill
    Result<void> set_slope(const SlopeTable& table);  ///< S: writes the slope table
    Result<int> version();                            ///< V: reads the version of the card's program
    Result<void> clear_watch_out();                   ///< W: clears the reset mark in EVENT

    // ---- events
    /// Writes the enables (bits of C4) and returns the EVENT word that this releases.
    Result<Events> enable_events(std::uint8_t enables);
    /// True if an EVENT word has reported a reset since connect(): the card has lost its table and is stationary.
    bool met_reset() const { return met_reset_; }
    /// Waits until one of the `wanted` events (01h, 02h, 04h, 20h) has occurred and returns the word; restores the
    /// enables. Errors: machine after `timeout` or if the card was reset meanwhile; stopped if the user requested a
    /// stop.
    Result<Events> wait_event(std::uint8_t wanted, Duration timeout, Waiting how = Waiting::polling);

    // ---- complete moves; a `timeout` of `never` waits without limit, also in wait_event
    /// Moves to `counts` with the present rate, mode and table. Ignores an active stop on the side that the axis
    /// leaves. Errors: machine if a stop blocks the move, the card is reset or `timeout` passes (Q then ends the move);
    /// stopped.
    Result<void> move_to(std::int64_t counts, Duration timeout, Waiting how = Waiting::polling);
    Result<void> move_by(std::int64_t counts, Duration timeout, Waiting how = Waiting::polling);
    Result<void> move_to_mm(double mm, Duration timeout, Waiting how = Waiting::polling);
    Result<double> position_mm();
    /// Moves at `rate` towards `far` (counts) until the zero pulse (`marks` 02h), the reference (04h) or both at once
    /// (06h) set the counter to 0; then stops.
    Result<void> find_zero(std::uint8_t marks, std::int64_t far, int rate, Duration timeout,
                           Waiting how = Waiting::polling);

    /// Converts mm to counts. Errors: refused if the value is not finite or is beyond the card's counts.
    Result<std::int64_t> to_counts(double mm) const;
    double to_mm(std::int64_t counts) const { return static_cast<double>(counts) / settings_.counts_per_mm; }

  private:
    Result<void> wait_ready(const char* what);
    Result<void> send(std::uint8_t code);
    Result<void> send(std::uint8_t code, std::int64_t value, int bytes);
    Result<std::int64_t> ask(std::uint8_t code, int bytes);
    Result<void> in_range(const char* what, std::int64_t value, std::int64_t min, std::int64_t max) const;
    Result<void> run_move(std::uint8_t wanted, bool forward, Duration timeout, Waiting how);
    Result<void> end_move(const Error& error);
    Result<bool> held(bool forward);

    BytePort& port_;
    Interrupt& interrupt_;
    DriverSettings settings_;
    std::uint8_t enables_ = 0;
    bool met_reset_ = false, quit_due_ = false;
};

}  // namespace motionrack::databoard4002
