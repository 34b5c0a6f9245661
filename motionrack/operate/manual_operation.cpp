// Manual operation: touch off, and accesses to the cards' own buses. While the machine moves, only cards that measure
// and move nothing are accessed.
#include <fmt/format.h>

#include <cmath>
#include <motionrack/operate/machine.hpp>
#include <motionrack/rack/bus_access.hpp>
#include <motionrack/rack/card_types.hpp>

namespace motionrack::operate {

namespace {

bool measures_only(const rack::RackConfig& config, const std::string& card) {
    const rack::RackCard* const found = config.card(card);
    return found != nullptr && rack::find_card_type(found->type)->measures_only;
}

}  // namespace

Result<void> Machine::touch_off(char axis, double value) {
    MOTIONRACK_TRY(const rack::RackAxis* found, axis_named(rack_.config(), "The work offset was not set", axis));
    if (!std::isfinite(value))
        return fail(ErrorKind::invalid_input, "The work offset was not set: the value is not a number.");
    if (stream_->has_work())
        return fail(ErrorKind::refused,
                    "The work offset was not set: the machine moves. Stop it, or wait for standstill.");
    const bool inches = stream_->interpreter().modes().inch && found->kind == rack::AxisKind::linear;
    if (const auto read = line(fmt::format("G10 L20 P0 {}{:.9f}", axis, inches ? value / 25.4 : value), 1); !read)
        return tl::unexpected<Error>(read.error());
    return {};
}

Result<void> Machine::access(const BusAccess& access, std::function<void(std::uint32_t)> ready) {
    const bool stands = idle(state_);
    if ((!stands || stream_->has_work()) && !measures_only(rack_.config(), access.card))
        return fail(
            ErrorKind::refused,
            fmt::format("The card was not accessed: the machine is in state '{}'. Stop it, or wait for standstill.",
                        name_of(state_)));
    MOTIONRACK_CHECK(rack::card_for_access(rack_, access.card, access.bits, access.address, access.value.has_value()));
    if (access.value && access.bits < 32 && *access.value >> access.bits != 0)
        return fail(ErrorKind::refused,
                    fmt::format("{} does not fit into {} bits. Nothing was done.", *access.value, access.bits));
    accesses_.push_back({access, std::move(ready)});
    return {};
}

/// Virtual time advances meanwhile, and commands arrive.
void Machine::access_bus() {
    for (auto& [access, ready] : std::exchange(accesses_, {})) {
        rack::Card& card = *rack_.card(access.card);
        if (!access.value) {
            ready(card.bus_read(access.bits, access.address));
            continue;
        }
        card.bus_write(access.bits, access.address, *access.value);
        for (const rack::RunningAxis& axis : rack_.axes()) {
            if (axis.card != card.motion()) continue;
            validity_.invalidate(axis.config.letter);
        }
        ready(*access.value);
    }
}

}  // namespace motionrack::operate
