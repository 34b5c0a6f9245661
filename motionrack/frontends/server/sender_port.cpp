#include <fmt/format.h>

#include <motionrack/frontends/server/sender_port.hpp>
#include <utility>

namespace motionrack::server {

SenderPort::SenderPort(operate::Machine& machine, auth::ControlLease& lease, const GrblPortSettings& settings)
    : machine_(machine), lease_(lease), resets_stop_all_(settings.resets_stop_all) {
    grbl::SessionSettings session;
    session.axes = settings.axes;
    session.take_control = [this] { return take_control(); };
    session.may_stop = [this] { return may_stop(); };
    session.source = [this](const char* kind) { return operate::StopOrigin{"a sender", speaker_, kind}; };
    session.onlookers_reset = settings.resets_stop_all;
    if (settings.on_setting)
        session.on_setting = [this, call = settings.on_setting](const std::string& text) { call(user_, text); };
    session_ = std::make_unique<grbl::GrblSession>(machine, std::move(session));
}

// ---- from the network thread

void SenderPort::came(const std::string& user, const std::string& address, const std::string& id) {
    machine_.post([self = shared_from_this(), user, address, id] {
        self->user_ = user;
        self->address_ = address;
        self->id_ = id;
        self->had_control_ = false;
        self->flush();
        self->session_->greet();
        self->flush(true);
    });
}

void SenderPort::left() {
    machine_.post([self = shared_from_this()] { self->lease_.left(self->id_); });
}

void SenderPort::receive(std::string bytes, bool writer, const std::string& address, std::function<void()> then) {
    machine_.post([self = shared_from_this(), bytes = std::move(bytes), writer, address, then = std::move(then)] {
        self->speaker_ = address;
        if (writer) {
            self->see_control();
            (void)self->lease_.keep(self->id_);
            self->session_->receive(bytes);
        } else {
            self->session_->observe(bytes);
        }
        self->flush();
        then();
    });
}

// ---- the motion thread

void SenderPort::tick() {
    see_control();
    session_->tick();
    flush();
}

void SenderPort::stopped(const operate::StopReport& report) {
    session_->stopped(report);
    flush();
}

void SenderPort::flush(bool greets) {
    if (std::string out = session_->take_output(); !out.empty())
        send({std::make_shared<const std::string>(std::move(out)), greets});
}

Result<void> SenderPort::take_control() {
    if (!lease_.check(id_)) {
        const bool is_stationary = operate::idle(machine_.state());
        MOTIONRACK_CHECK(lease_.take(user_, id_, is_stationary, is_stationary));
    }
    had_control_ = true;
    return {};
}

Result<void> SenderPort::may_stop() const {
    const auto holder = lease_.holder();
    if (resets_stop_all_ || !holder || holder->left || holder->session == id_) return {};
    return fail(
        ErrorKind::refused,
        fmt::format(
            "Only this connection was reset, because {} has control. ! holds the machine, STOP on the page ends it",
            holder->user.empty() ? "another session" : holder->user));
}

/// Locks the session of a sender that has lost control, so that the rest of its lines is not executed.
void SenderPort::see_control() {
    if (!had_control_) return;
    const auto holder = lease_.holder();
    if (!holder || holder->session == id_) return;
    had_control_ = false;
    session_->lose_control(holder->user);
}

}  // namespace motionrack::server
