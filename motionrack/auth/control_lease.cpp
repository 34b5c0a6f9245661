// Rules of the lease.
#include <fmt/format.h>

#include <motionrack/auth/control_lease.hpp>

namespace motionrack::auth {

Result<void> ControlLease::take(std::string_view user, std::string_view session, bool force, bool machine_stands) {
    const std::lock_guard<std::mutex> alone(lock_);
    if (held() && held_->session == session) {
        held_->last_sign = clock_();
        return {};
    }
    const bool comes_back = held() && held_->left && !user.empty() && held_->user == user;
    if (held() && !comes_back) {
        if (!machine_stands && !held_->left)
            return fail(
                ErrorKind::refused,
                fmt::format(
                    "Control was not taken: {} has it and the machine moves. Stop the machine, or wait for standstill.",
                    name()));
        if (!force)
            return fail(ErrorKind::refused,
                        fmt::format("Control was not taken: {} has it. Ask for it, or take it over, "
                                    "which is possible at standstill.",
                                    name()));
    }
    const Moment now = clock_();
    held_ = LeaseHolder{std::string(user), std::string(session), now, now, false};
    return {};
}

Result<void> ControlLease::release(std::string_view session) {
    const std::lock_guard<std::mutex> alone(lock_);
    MOTIONRACK_CHECK(holds(session));
    held_.reset();
    return {};
}

bool ControlLease::revoke(std::string_view user, std::string_view session) {
    const std::lock_guard<std::mutex> alone(lock_);
    if (!held() || (session.empty() ? held_->user == user : held_->session == session)) return false;
    held_.reset();
    return true;
}

Result<void> ControlLease::holds(std::string_view session) const {
    if (!held()) return fail(ErrorKind::refused, "No user has control. Take control first.");
    if (held_->session != session)
        return fail(ErrorKind::refused, fmt::format("Control is with {}. Take control first.", name()));
    return {};
}

Result<void> ControlLease::check(std::string_view session) {
    const std::lock_guard<std::mutex> alone(lock_);
    MOTIONRACK_CHECK(holds(session));
    held_->last_sign = clock_();
    held_->left = false;
    return {};
}

void ControlLease::left(std::string_view session) {
    const std::lock_guard<std::mutex> alone(lock_);
    if (held_ && held_->session == session) held_->left = true;
}

std::optional<ControlLease::Holder> ControlLease::holder() const {
    const std::lock_guard<std::mutex> alone(lock_);
    if (!held()) return std::nullopt;
    return Holder{held_->user, held_->session, std::chrono::duration<double>(held_->since - made_).count(),
                  held_->left};
}

}  // namespace motionrack::auth
