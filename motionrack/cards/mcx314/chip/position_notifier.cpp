// Sends rates and watched counts to the position listeners after an event.
#include <bit>
#include <motionrack/cards/mcx314/chip/position_notifier.hpp>
#include <utility>

namespace motionrack::mcx314 {

/// Updates, before an event, the rates last sent to listeners: along an arc they drift between the reported changes.
void PositionNotifier::note_rates() {
    if (state_.chain == 0 || !state_.path.command.arc()) return;
    for (int i = 0; i < 2; ++i) {
        const int a = state_.path.command.axis[i];
        if (listeners_.of_axis[a].size() > 0)
            state_.axis[a].reported_rate = std::bit_cast<std::uint64_t>(law_.rate_of(a, Instant{0}));
    }
}

void PositionNotifier::notify(Instant now) {
    const unsigned changed = requests_.take_changed();
    for_each_axis((changed | state_.crossed) & listeners_.heard, [&](int a) {
        if (changed >> a & 1u) {
            if (edges_.wanted(a)) edges_.flush(a);
            if (listeners_.of_axis[a].size() > 0) {
                const double rate = law_.rate_of(a, now);
                const auto before = std::bit_cast<double>(
                    std::exchange(state_.axis[a].reported_rate, std::bit_cast<std::uint64_t>(rate)));
                listeners_.of_axis[a].notify_rate(before, rate, now);
            }
        }
        Axis& axis = state_.axis[a];
        if (!(state_.crossed >> a & 1u)) return;
        state_.crossed &= ~(1u << a);
        if (edges_.wanted(a)) edges_.flush(a);
        listeners_.of_axis[a].notify_crossed(axis.watch, axis.count, now);
    });
}

}  // namespace motionrack::mcx314
