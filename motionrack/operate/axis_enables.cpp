// Changes of the enabled axes.
#include <algorithm>
#include <motionrack/operate/axis_enables.hpp>
#include <utility>

namespace motionrack::operate {

void AxisEnables::set(bool on, std::string_view axes) {
    for (const rack::RackAxis& axis : config_.axes) {
        if (!axes.empty() && axes.find(axis.letter) == std::string_view::npos) continue;
        disable_wanted_[index(axis)] = !on;
        if (on) enabled_[index(axis)] = true;
    }
}

void AxisEnables::settle() {
    for (std::size_t i = 0; i < enabled_.size(); ++i)
        enabled_[i] = enabled_[i] && !std::exchange(disable_wanted_[i], false);
}

bool AxisEnables::any() const {
    return std::find(enabled_.begin(), enabled_.end(), true) != enabled_.end();
}

}  // namespace motionrack::operate
