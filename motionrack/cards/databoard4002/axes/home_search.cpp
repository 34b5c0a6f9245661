// State transitions of the homing search, one poll at a time.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <motionrack/cards/databoard4002/axes/home_search.hpp>

namespace motionrack::databoard4002 {

namespace {

constexpr std::array<std::string_view, 9> names = {"",     "BACK",      "BACK_STOP", "SEARCH", "SEARCH_STOP",
                                                   "SLOW", "SLOW_STOP", "HOMED",     "FAILED"};

}  // namespace

std::string_view HomeSearch::state_name() const {
    return names[static_cast<std::size_t>(state_)];
}

tl::unexpected<Error> HomeSearch::failed(const std::string& why) const {
    const std::string where =
        state_ == State::idle ? "Nothing was moved" : fmt::format("It was stopped in {}", state_name());
    return fail(ErrorKind::machine,
                fmt::format("Homing of axis {}: {}. {}; the position is not valid.", frame_.name, why, where));
}

// ---- start and end

void HomeSearch::begin(const control::HomingRequest& order, const HomeFrame& frame, Instant now) {
    order_ = order;
    frame_ = frame;
    outcome_ = {};
    outcome_.method = order.method;
    outcome_.towards_plus = order.towards_plus;
    outcome_.from = now;
    error_ = {};
    turned_ = zeroed_ = false;
    distance_ = pace_ = step_ = 0;
    std::optional<double> hysteresis;
    if (order.hysteresis) hysteresis = *order.hysteresis * frame.counts_per_unit;
    edges_.begin(hysteresis, contacts_repeat * frame.counts_per_unit + 2);
    state_ = State::idle;
    polled_ = now;
    Result<void> begun;
    if (auto here = driver_.position()) {
        counts_ = *here;
        distance_ = static_cast<double>(counts_);
        const StatusByte status = driver_.status();
        if (status.emergency())
            begun = failed("the emergency stop is active; release it");
        else
            begun = enter(status.reference() ? State::back : State::search, now);
    } else {
        begun = tl::unexpected<Error>(here.error());
    }
    if (!begun) fail_with(begun.error(), now);
}

void HomeSearch::fail_with(const Error& error, Instant now) {
    error_ = error;
    static_cast<void>(driver_.quit());
    finish(State::failed, error.message, now);
}

void HomeSearch::stop() {
    if (!running()) return;
    fail_with({ErrorKind::stopped, fmt::format("Homing of axis {} was stopped in {}; the position is not valid.",
                                               frame_.name, state_name())},
              host_.now());
}

void HomeSearch::leave(Instant now) {
    if (state_ == State::idle) return;
    outcome_.stays.push_back(
        {std::string(state_name()), since(entered_), to_seconds(now - entered_), entered_way_, distance_});
}

/// Converts distances along the search into positions, which are valid from here on.
void HomeSearch::finish(State state, std::string sentence, Instant now) {
    leave(now);
    state_ = state;
    outcome_.homed = state == State::homed;
    outcome_.sentence = std::move(sentence);
    outcome_.took_s = since(now);
    const double zero = zeroed_ ? home_distance_ : 0, called = zeroed_ ? order_.home_offset : frame_.offset;
    const auto place_of = [&](double distance) { return called + (distance - zero) / frame_.counts_per_unit; };
    for (control::HomingStateVisit& stay : outcome_.stays) stay.from = place_of(stay.from), stay.to = place_of(stay.to);
    for (control::HomingEdge& edge : outcome_.edges) edge.position = place_of(edge.position);
    outcome_.position = place_of(distance_);
    if (zeroed_) outcome_.moved_by = order_.home_offset - place(home_distance_);
}

// ---- entering a state

/// Returns the events that set the counter to 0 in the present state.
std::uint8_t HomeSearch::marks() const {
    if (!marking()) return 0;
    const bool index = order_.method == control::HomingMethod::index_after_switch ||
                       (order_.method == control::HomingMethod::twice_and_index && state_ == State::slow);
    return static_cast<std::uint8_t>(event::REF | (index ? event::ZERO : 0));
}

Result<void> HomeSearch::drive(bool towards, int rate) {
    forward_ = towards == order_.towards_plus;
    const StatusByte status = driver_.status();
    if (status.end_stop(forward_)) {
        stop_seen_ = host_.now();  // causes no edge
        return {};
    }
    const std::int64_t far =
        std::clamp<std::int64_t>(counts_ + (forward_ ? frame_.travel : -frame_.travel), map::min_24, map::max_24);
    MOTIONRACK_CHECK(driver_.on_regulation());
    MOTIONRACK_CHECK(driver_.set_rate(rate));
    MOTIONRACK_CHECK(driver_.set_target(far));
    MOTIONRACK_TRY(const Events old,
                   driver_.enable_events(static_cast<std::uint8_t>(marks() | event::POSITION | event::STOP)));
    MOTIONRACK_CHECK(check_set_up(old));
    return driver_.go();
}

Result<void> HomeSearch::enter(State state, Instant now) {
    leave(now);
    state_ = state;
    entered_ = still_since_ = now;
    entered_way_ = distance_;
    marked_ = counted_ = seen_ = off_ = under_ = false;
    stop_seen_ = never;
    switch (state) {
        case State::back:
            return drive(false, frame_.speed_rate);
        case State::search:
            return drive(true, frame_.speed_rate);
        case State::slow:
            return drive(true, frame_.slow_rate);
        default:
            return driver_.quit();  // stops the motor
    }
}

// ---- polling

void HomeSearch::step(Instant now) {
    if (!running()) return;
    if (const Result<void> looked = poll(now); !looked) fail_with(looked.error(), now);
}

/// Adds the distance since the last poll; if the counter was set to 0 in between, estimates it from the previous
/// velocity.
Result<void> HomeSearch::count(Instant now) {
    MOTIONRACK_TRY(const std::int64_t counts, driver_.position());
    // The counter may have become 0 just now, perhaps after it was read: the next poll decides.
    if (marking() && !marked_ && driver_.status().event()) return {};
    const double seconds = to_seconds(now - polled_);
    double step = static_cast<double>(counts - counts_);
    if (marked_ && !counted_) {
        step = pace_ * seconds;
        counted_ = true;
        home_distance_ = distance_ + step - static_cast<double>(counts);
    } else if (seconds > 0) {
        pace_ += (step / seconds - pace_) / 8;  // a poll sees whole counts
    }
    if (counts != counts_) still_since_ = now;
    distance_ += step;
    step_ = std::fabs(step);
    counts_ = counts;
    polled_ = now;
    return {};
}

Result<void> HomeSearch::check_set_up(const Events& seen) const {
    if (!seen.was_reset()) return {};
    return failed("the card was reset (its watchdog, or the bus); home again, which initialises it");
}

Result<void> HomeSearch::look_at_events(Instant now) {
    if (!driver_.status().event()) return {};
    // Without the event marks: a bounce of the reference must not set the counter to 0 again.
    constexpr auto others = static_cast<std::uint8_t>(event::POSITION | event::STOP);
    MOTIONRACK_TRY(const Events seen, driver_.enable_events(others));
    MOTIONRACK_CHECK(check_set_up(seen));
    if (seen.stop()) stop_seen_ = later(now, contacts_rest);
    if ((seen.word & marks()) != 0) {
        marked_ = true;
    } else if (seen.position() && (marking() || state_ == State::back)) {
        return failed(
            fmt::format("no {} was found within {:.3f} {}; check its wire",
                        marks() == (event::REF | event::ZERO) ? "zero pulse under the reference" : "reference",
                        static_cast<double>(frame_.travel) / frame_.counts_per_unit, frame_.unit));
    }
    if (!marking() || marked_) return {};
    MOTIONRACK_CHECK(driver_.enable_events(static_cast<std::uint8_t>(marks() | others)));
    // It may have become active between the two reads.
    return driver_.status().reference() && !driver_.status().event() ? enter(State::back, now) : Result<void>{};
}

/// Ends or reverses the search if a stop blocks the axis; called when the contacts of the stop have settled.
Result<void> HomeSearch::look_at_stop(Instant now) {
    stop_seen_ = never;
    const StatusByte status = driver_.status();
    if (status.emergency()) return failed("the emergency stop is active; release it");
    if (!(marking() || state_ == State::back) || !status.end_stop(forward_)) return {};
    if (state_ == State::search && order_.turn_at_limit && !turned_) {
        turned_ = true;
        outcome_.notes.push_back(
            fmt::format("the {} end stop was reached first; the reference was searched in the other direction",
                        forward_ ? "right" : "left"));
        MOTIONRACK_CHECK(driver_.quit());
        return enter(State::back, now);
    }
    return failed(
        fmt::format("the {} end stop is active and no reference was found before it", forward_ ? "right" : "left"));
}

Result<void> HomeSearch::poll(Instant now) {
    MOTIONRACK_CHECK(look_at_events(now));
    MOTIONRACK_CHECK(count(now));
    if (now >= stop_seen_) return look_at_stop(now);
    switch (state_) {
        case State::back:
            return look_back(now);
        case State::search:
        case State::slow:
            return look_search(now);
        default:
            return now - still_since_ >= frame_.settle ? look_standing(now) : Result<void>{};
    }
}

Result<void> HomeSearch::look_back(Instant now) {
    const bool active = driver_.status().reference();
    if (active) {
        seen_ = true;
        off_ = false;
    } else if (seen_ && !off_) {
        off_ = true;
        off_distance_ = distance_;
        edges_.released(towards(distance_) - step_, 2 * step_);
        outcome_.edges.push_back({"switch off", std::string(state_name()), distance_,
                                  std::fabs(pace_) * 1e-3 / frame_.counts_per_unit,
                                  std::fabs(pace_) / frame_.counts_per_unit, since(now)});
    }
    if (!off_ || std::fabs(distance_ - off_distance_) < order_.backoff * frame_.counts_per_unit) return {};
    return enter(State::back_stop, now);
}

/// The reference became active between two polls. A distance hidden by the zeroing is known to within one poll.
Result<void> HomeSearch::check_edge(double distance) {
    const auto conflict = edges_.acted(towards(distance) + step_, 2 * step_);
    if (!conflict) return {};
    return failed(
        fmt::format("the reference is not sound: {}; look for a loose wire and for contacts that break or stick",
                    conflict->text([&](double counts) {
                        return fmt::format("{:.3f} {}", counts / frame_.counts_per_unit, frame_.unit);
                    })));
}

Result<void> HomeSearch::look_search(Instant now) {
    const bool index = (marks() & event::ZERO) != 0;
    if (index && !under_ && driver_.status().reference()) {
        under_ = true;
        MOTIONRACK_CHECK(check_edge(distance_));
    }
    if (!marked_) return {};
    if (!index) MOTIONRACK_CHECK(check_edge(home_distance_));
    outcome_.edges.push_back({index ? "index" : "switch on", std::string(state_name()), home_distance_, 0,
                              std::fabs(pace_) / frame_.counts_per_unit, since(now)});
    zeroed_ = true;
    return enter(state_ == State::search ? State::search_stop : State::slow_stop, now);
}

Result<void> HomeSearch::look_standing(Instant now) {
    switch (state_) {
        case State::back_stop:
            return enter(twice() ? State::slow : State::search, now);
        case State::search_stop:
            if (twice()) return enter(State::back, now);
            break;
        default:
            break;
    }
    MOTIONRACK_CHECK(driver_.enable_events(0));
    finish(State::homed, fmt::format("Axis {} is homed.", frame_.name), now);
    return {};
}

}  // namespace motionrack::databoard4002
