// Events, and complete moves.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/cards/databoard4002/driver/driver.hpp>
#include <utility>

namespace motionrack::databoard4002 {

// ---- events

Result<Events> Driver::enable_events(std::uint8_t enables) {
    MOTIONRACK_CHECK(wait_ready("C4"));
    port_.out(ports::C4, enables);
    enables_ = enables;
    MOTIONRACK_CHECK(wait_ready("the EVENT word"));
    const Events seen{port_.in(ports::DATA)};
    met_reset_ = met_reset_ || seen.was_reset();
    return seen;
}

Result<Events> Driver::wait_event(std::uint8_t wanted, Duration timeout, Waiting how) {
    const Instant until = later(interrupt_.now(), timeout);
    while (true) {
        const bool stop = interrupt_.stop_requested();
        const StatusByte now = status();
        if (now.event() && !stop) {
            MOTIONRACK_TRY(const Events seen, enable_events(enables_));
            if (seen.was_reset())
                return fail(ErrorKind::machine,
                            fmt::format("Card {} was reset while an event was waited for (its watchdog, or the bus); "
                                        "position and table are lost. Set it up again.",
                                        settings_.select));
            if (seen.word & wanted) return seen;
            continue;
        }
        if (stop) {
            MOTIONRACK_CHECK(quit());
            return fail(ErrorKind::stopped,
                        fmt::format("Stopped on request; the move of card {} was ended by Q.", settings_.select));
        }
        if (interrupt_.now() >= until)
            return fail(
                ErrorKind::machine,
                fmt::format("Card {} reported no event {:02X}h within {:.3f} s. Check that it moves, and the time-out.",
                            settings_.select, wanted, to_seconds(timeout)));
        const bool polls = how == Waiting::polling || now.interrupt() || (enables_ & event::ON_EVENT) == 0;
        // The line is shared: the interrupt may come from another card.
        if (polls || (interrupt_.wait(std::min(until - interrupt_.now(), milliseconds(100))) && !status().interrupt()))
            interrupt_.pass(settings_.poll);
    }
}

// ---- moves

/// Ends the move after an error and appends the active stops to the error.
Result<void> Driver::end_move(const Error& error) {
    Error out = error;
    if (out.kind == ErrorKind::machine) {
        (void)quit();
        if (const std::string stops = status().stops(); !stops.empty())
            out.message += fmt::format(" At present {}.", stops);
    }
    return tl::unexpected<Error>(std::move(out));
}

/// Returns whether a stop blocks the move; called after its edge.
Result<bool> Driver::held(bool forward) {
    interrupt_.pass(settings_.bounce);
    const StatusByte now = status();
    if (now.event()) return false;  // further events are handled first
    if (now.emergency() || now.end_stop(forward)) return true;
    MOTIONRACK_TRY(const int present, rate());
    return present == 0 && !status().event();  // the emergency stop was active only briefly
}

Result<void> Driver::run_move(std::uint8_t wanted, bool forward, Duration timeout, Waiting how) {
    if (const StatusByte now = status(); now.emergency())
        return fail(ErrorKind::machine,
                    fmt::format("Card {} was not started: {}. Release it first.", settings_.select, now.stops()));
    const auto wake = static_cast<std::uint8_t>(how == Waiting::interrupt ? event::ON_EVENT : 0);
    MOTIONRACK_TRY(const Events old, enable_events(static_cast<std::uint8_t>(wanted | event::STOP | wake)));
    if (old.was_reset())
        return fail(ErrorKind::machine,
                    fmt::format("Card {} was reset, and no program has connected to it since; position and table are "
                                "lost, so it was not moved. Connect to it, then set both again.",
                                settings_.select));
    MOTIONRACK_CHECK(go());
    const Instant until = later(interrupt_.now(), timeout);
    while (true) {
        const auto seen = wait_event(static_cast<std::uint8_t>(wanted | event::STOP),
                                     std::max(until - interrupt_.now(), Duration{0}), how);
        if (!seen) return end_move(seen.error());
        if (seen->word & wanted) return {};
        MOTIONRACK_TRY(const bool stopped, held(forward));
        if (stopped) break;
    }
    const std::string stops = status().stops();
    MOTIONRACK_CHECK(quit());
    MOTIONRACK_TRY(const std::int64_t there, position());
    return fail(ErrorKind::machine,
                fmt::format("Card {} reached a stop at {} counts ({:.3f} mm): {}. The move was ended; move away in the "
                            "other direction, or release the stop.",
                            settings_.select, there, to_mm(there), stops.empty() ? "it is inactive again" : stops));
}

Result<void> Driver::move_to(std::int64_t counts, Duration timeout, Waiting how) {
    MOTIONRACK_TRY(const std::int64_t here, position());
    MOTIONRACK_CHECK(in_range("The target P", counts, map::min_24, map::max_24));
    MOTIONRACK_CHECK(in_range("The length of the move", counts - here, -max_move_counts, max_move_counts));
    MOTIONRACK_CHECK(set_target(counts));
    return run_move(event::POSITION, counts >= here, timeout, how);
}

Result<void> Driver::move_by(std::int64_t counts, Duration timeout, Waiting how) {
    MOTIONRACK_TRY(const std::int64_t here, position());
    MOTIONRACK_CHECK(in_range("The length of the move", counts, -max_move_counts, max_move_counts));
    MOTIONRACK_CHECK(in_range("The end of the move", here + counts, map::min_24, map::max_24));
    MOTIONRACK_CHECK(set_number(counts));
    return run_move(event::POSITION, counts >= 0, timeout, how);
}

Result<void> Driver::move_to_mm(double mm, Duration timeout, Waiting how) {
    MOTIONRACK_TRY(const std::int64_t counts, to_counts(mm));
    return move_to(counts, timeout, how);
}

Result<void> Driver::find_zero(std::uint8_t marks, std::int64_t far, int rate, Duration timeout, Waiting how) {
    if (marks == 0 || (marks & ~(event::ZERO | event::REF)) != 0)
        return fail(ErrorKind::refused,
                    fmt::format("The marks to search are {:02X}h; they must be 02h (zero pulse), 04h (reference) or "
                                "06h (both). Nothing was moved.",
                                marks));
    MOTIONRACK_TRY(const std::int64_t here, position());
    MOTIONRACK_CHECK(manual());
    MOTIONRACK_CHECK(set_rate(rate));
    MOTIONRACK_CHECK(set_target(far));
    MOTIONRACK_CHECK(run_move(marks, far >= here, timeout, how));
    MOTIONRACK_CHECK(quit());
    MOTIONRACK_CHECK(enable_events(0));
    return {};
}

}  // namespace motionrack::databoard4002
