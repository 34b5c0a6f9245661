// Jogs and their leases.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/operate/jogs.hpp>
#include <utility>

namespace motionrack::operate {

// ---- commands

Result<void> Jogs::see(const JogOrigin& origin) {
    if (origin.sequence == 0) return {};
    if (origin.session == newest_.session && origin.sequence <= newest_.sequence)
        return fail(ErrorKind::refused,
                    fmt::format("Not jogged: the command has the sequence {}, but {} came before it. Nothing was "
                                "changed; number the commands of a session upwards.",
                                origin.sequence, newest_.sequence));
    newest_ = origin;
    return {};
}

Result<void> Jogs::accept(char letter, const JogOrigin& origin) {
    MOTIONRACK_CHECK(see(origin));
    if (!origin.renews || held(letter)) return {};
    return fail(ErrorKind::refused, fmt::format("Not jogged: the jog of axis {} has ended, so it cannot be renewed. "
                                                "Nothing was moved; release the key and jog again.",
                                                letter));
}

void Jogs::hold(char letter, double speed, const std::string& session) {
    if (speed == 0)
        leases_.erase(letter);
    else
        leases_[letter] = {speed, session, wall_() + lease_};
    requests_.push_back({letter, speed, std::nullopt});
}

void Jogs::move(char letter, double distance, double speed) {
    requests_.push_back({letter, speed, distance});
}

void Jogs::end_of(const std::string& session) {
    std::erase_if(leases_, [&](const auto& one) { return one.second.session == session; });
}

void Jogs::let_go() {
    requests_.clear();
    leases_.clear();
}

bool Jogs::held(char letter) const {
    const auto found = leases_.find(letter);
    return found != leases_.end() && wall_() < found->second.until;
}

// ---- motion

/// Continues a jog by one step. Checks for its end before it renews the jog, so that a valid lease does not restart a
/// jog that has ended by itself.
std::optional<Jogs::Ended> Jogs::carry_on(Moving& one, Instant now, bool stop) {
    using control::AxisState;
    if (stop) one.axis->stop();
    one.axis->step(now);
    const AxisState state = one.axis->state();
    if (state == AxisState::standstill || state == AxisState::error) {
        leases_.erase(one.letter);
        return Ended{one.letter, one.axis->position_valid(), one.axis->wait(Duration{0})};
    }
    if (one.leased && !stop) static_cast<void>(one.axis->jog(held(one.letter) ? leases_.at(one.letter).speed : 0, now));
    return std::nullopt;
}

/// Starts a requested jog. Checks for a stop after taking the axis, which takes virtual time.
Result<void> Jogs::begin(const PendingJog& request, const Take& take, Instant now, const Stops& stops) {
    const bool leased = !request.distance;
    if (leased && request.speed != 0 && !held(request.letter)) return {};  // over before its start
    MOTIONRACK_TRY(control::Axis * axis, take(request.letter));
    if (stops(request.letter)) return {};
    MOTIONRACK_CHECK(leased ? axis->jog(request.speed, now) : axis->move_by(*request.distance, request.speed));
    const bool known =
        std::any_of(moving_.begin(), moving_.end(), [&](const Moving& one) { return one.letter == request.letter; });
    if (!known) moving_.push_back({request.letter, axis, leased});
    return {};
}

std::vector<Jogs::Ended> Jogs::step(const Take& take, Instant now, const Stops& stops) {
    std::vector<Ended> out;
    std::erase_if(moving_, [&](Moving& one) {
        std::optional<Ended> ended = carry_on(one, now, stops(one.letter));
        if (ended) out.push_back(std::move(*ended));
        return ended.has_value();
    });
    for (const PendingJog& request : std::exchange(requests_, {})) {
        Result<void> begun = begin(request, take, now, stops);
        if (begun) continue;
        leases_.erase(request.letter);
        out.push_back({request.letter, true, std::move(begun)});
    }
    return out;
}

}  // namespace motionrack::operate
