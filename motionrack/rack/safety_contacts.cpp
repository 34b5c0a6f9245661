// Reactions of the contacts themselves.
#include <fmt/format.h>

#include <motionrack/rack/safety_contacts.hpp>
#include <utility>

namespace motionrack::rack {

SafetyContacts::SafetyContacts(sim::Kernel& kernel, const RackSafety& settings)
    : kernel_(kernel), settings_(settings), estop_(kernel.find_wire("estop")) {
    if (settings_.estop_channels < 2 && !settings_.door) return;
    id_ = kernel_.add(*this, sim::Phase::wires, "safety_contacts");
    for (int i = 0; i < 2 && settings_.estop_channels == 2; ++i) {
        channels_[static_cast<std::size_t>(i)] = kernel_.add_wire(fmt::format("estop{}", i + 1), 1);
        kernel_.listen(channels_[static_cast<std::size_t>(i)], id_, i);
    }
    if (!settings_.door) return;
    door_ = kernel_.add_wire("door", 1);
    kernel_.listen(door_, id_, door_pin);
}

void SafetyContacts::press(bool pressed) {
    state_.pressed = pressed ? 1 : 0;
    drive();
    kernel_.settle();
}

void SafetyContacts::drive() {
    const bool closed = !has_channels() || (level(0) != 0 && level(1) != 0);
    kernel_.set_wire(estop_, closed && state_.pressed == 0 ? 1 : 0);
}

void SafetyContacts::on_wire(int pin, int changed, Instant now) {
    if (pin == door_pin) {
        if (changed != 0) return;
        state_.door_opened = now;
        kernel_.break_run();
        return;
    }
    const bool alike = level(0) == level(1);
    drive();
    if (alike) state_.differs = state_.reported = 0;
    kernel_.schedule(id_, alike ? never : later(now, from_seconds(settings_.estop_discrepancy_ms * 1e-3)));
}

void SafetyContacts::on_scheduled(Instant now) {
    if (level(0) == level(1)) return;
    state_.differs = 1;
    state_.differs_at = now;
    kernel_.break_run();
}

std::vector<std::string> SafetyContacts::take_alarms() {
    if (state_.differs == 0 || std::exchange(state_.reported, 1) != 0) return {};
    return {fmt::format(
        "The two channels of the emergency stop have differed for {:g} ms at {:.3f} s: estop{} is open, "
        "estop{} closed. No reset is accepted until both are equal; check both contacts and their wires.",
        settings_.estop_discrepancy_ms, to_seconds(state_.differs_at), level(0) == 0 ? 1 : 2, level(0) == 0 ? 2 : 1)};
}

}  // namespace motionrack::rack
