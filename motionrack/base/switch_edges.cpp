// Comparison of the edges of a search.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/base/switch_edges.hpp>

namespace motionrack {

std::string EdgeConflict::text_with(std::string_view distance, std::string_view max_distance) const {
    return fmt::format(
        "it became active {} {} the position at which it {} in this search; a sound switch deviates by at most {}",
        distance, beyond ? "beyond" : "before", with_release ? "was released" : "became active", max_distance);
}

void SwitchEdges::begin(std::optional<double> hysteresis, double repeats) {
    hysteresis_ = hysteresis;
    repeats_ = repeats;
    acted_.reset();
    released_.reset();
}

void SwitchEdges::released(double distance, double within) {
    const Span here{distance, distance + within};
    released_ = released_ ? Span{std::min(released_->low, here.low), std::max(released_->high, here.high)} : here;
}

std::optional<EdgeConflict> SwitchEdges::acted(double distance, double within) {
    if (!hysteresis_) return {};
    const Span here{distance - within, distance};
    std::optional<EdgeConflict> out;
    if (released_) out = conflict(here, *released_, *hysteresis_);
    if (out) out->with_release = true;
    if (!out && acted_) out = conflict(here, *acted_, 0);
    acted_ = here;
    released_.reset();
    return out;
}

std::optional<EdgeConflict> SwitchEdges::conflict(const Span& edge, const Span& other, double slack) const {
    const double beyond = edge.low - other.high, before = other.low - edge.high;
    if (beyond > slack + repeats_) return EdgeConflict{false, true, beyond, slack + repeats_};
    if (before > repeats_) return EdgeConflict{false, false, before, repeats_};
    return {};
}

}  // namespace motionrack
