// Conditions of manual accesses, and the end of motion that they have started.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/base/function_library.hpp>
#include <motionrack/operate/machine.hpp>
#include <motionrack/operate/manual_access.hpp>
#include <motionrack/rack/bus_access.hpp>
#include <motionrack/rack/card_types.hpp>

namespace motionrack::operate {

namespace {

constexpr const char* not_written = "The card was not written";

bool measures_only(const rack::RackConfig& config, const std::string& card) {
    const rack::RackCard* const found = config.card(card);
    return found != nullptr && rack::find_card_type(found->type)->measures_only;
}

}  // namespace

Result<void> ManualAccess::check_write(const std::string& card) const {
    if (measures_only(machine_.rack_.config(), card)) {
        MOTIONRACK_CHECK(rack::check_released(machine_.rack_.stop_latch(), not_written));
        return machine_.conditions_.may_start(not_written);
    }
    MOTIONRACK_CHECK(machine_.conditions_.may_begin(not_written));
    return machine_.conditions_.axes_may_move(not_written, machine_.service_.axes_of(card));
}

Result<void> ManualAccess::request(const BusAccess& access, Answered ready) {
    const bool is_stationary = idle(machine_.publisher_.state()) && !machine_.programs_.stream().has_work();
    if (!is_stationary && !measures_only(machine_.rack_.config(), access.card))
        return fail(
            ErrorKind::refused,
            fmt::format("The card was not accessed: the machine is in state '{}'. Stop it, or wait for standstill.",
                        name_of(machine_.publisher_.state())));
    MOTIONRACK_CHECK(
        rack::card_for_access(machine_.rack_, access.card, access.bits, access.address, access.value.has_value()));
    if (access.value && std::uint64_t{*access.value} >> access.bits != 0)
        return fail(ErrorKind::refused,
                    fmt::format("{} does not fit into {} bits. Nothing was done.", *access.value, access.bits));
    if (access.value) MOTIONRACK_CHECK(check_write(access.card));
    pending_.emplace_back(access, std::move(ready));
    return {};
}

void ManualAccess::step() {
    for (const auto& [access, ready] : std::exchange(pending_, {})) execute(access, ready);
}

void ManualAccess::execute(const BusAccess& access, const Answered& ready) {
    rack::Card& card = *machine_.rack_.card(access.card);
    if (!access.value) return ready(card.bus_read(access.bits, access.address));
    if (const Result<void> may = check_write(access.card); !may) return ready(tl::unexpected<Error>(may.error()));
    card.bus_write(access.bits, access.address, *access.value);
    for (const rack::RunningAxis& axis : machine_.rack_.axes()) {
        if (axis.card != card.motion()) continue;
        machine_.validity_.invalidate(axis.config.letter);
        if (std::find(written_.begin(), written_.end(), access.card) == written_.end()) written_.push_back(access.card);
    }
    ready(*access.value);
}

char ManualAccess::moving_axis() const {
    for (const std::string& card : written_)
        for (const rack::RunningAxis& axis : machine_.rack_.axes())
            if (axis.config.card == card && axis.moves(machine_.now())) return axis.config.letter;
    return '\0';
}

Result<void> ManualAccess::end_motion() {
    machine_.handover_.release();
    for (const std::string& card : std::exchange(written_, {})) {
        const std::unique_ptr<FunctionLibrary> library = machine_.rack_.card(card)->take_library();
        stop_at_once(*library, host_of(machine_.rack_));
    }
    return machine_.handover_.take_group();
}

}  // namespace motionrack::operate
