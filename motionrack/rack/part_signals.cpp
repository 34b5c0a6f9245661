// Finds the signals of parts through the catalogue.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <motionrack/base/result.hpp>
#include <motionrack/rack/part_catalogue.hpp>
#include <motionrack/rack/part_signals.hpp>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::rack {

std::string signal_name(std::string_view part, std::string_view signal) {
    return signal.empty() ? std::string(part) : fmt::format("{}.{}", part, signal);
}

std::string missing_signal(const SignalOwner& owner, std::string_view needs) {
    return fmt::format("{} needs {} to have it", owner.subject, with_unit(needs, owner.unit));
}

std::vector<PartSignal> part_signals(const RackConfig& config) {
    std::vector<PartSignal> out;
    for (const PartKind* kind : part_kinds()) {
        if (kind->signals == nullptr) continue;
        std::vector<PartSignal> more = kind->signals->of(config);
        out.insert(out.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
    }
    return out;
}

const PartSignals& signals_of(EndOwner owner) {
    const auto kinds = part_kinds();
    const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const PartKind* kind) {
        return kind->signals != nullptr && kind->signals->owner == owner;
    });
    MOTIONRACK_ASSERT(found != kinds.end());  // each owner but cards has a kind
    return *(*found)->signals;
}

}  // namespace motionrack::rack
