// Parameters by number and by name.
#include <algorithm>
#include <motionrack/control/gcode/language/parameters.hpp>

namespace motionrack::control::gcode {

void Parameters::set(int number, double value) {
    if (numbered_.empty()) numbered_.resize(last_parameter + 1);
    numbered_[static_cast<std::size_t>(number)] = value;
}

std::optional<double> Parameters::named(std::string_view name) const {
    const Names& names = names_of(name);
    const auto found = names.find(name);
    if (found == names.end()) return std::nullopt;
    return found->second;
}

void Parameters::set(const std::string& name, double value) {
    (is_global(name) ? global_ : calls_.empty() ? main_ : calls_.back().names)[name] = value;
}

std::size_t Parameters::capacity_for(std::string_view name) const {
    const std::size_t kept = names_of(name).size();
    return kept < max_names ? max_names - kept : 0;
}

bool Parameters::enter(std::span<const double> arguments) {
    if (level() == max_call_depth) return false;
    SubprogramCall& call = calls_.emplace_back();
    call.keeps = true;
    for (int i = 0; i < max_arguments; ++i) {
        const auto at = static_cast<std::size_t>(i);
        call.kept[at] = numbered(i + 1);
        const double argument = at < arguments.size() ? arguments[at] : 0;
        if (argument != 0 || !numbered_.empty()) set(i + 1, argument);
    }
    return true;
}

bool Parameters::enter() {
    if (level() == max_call_depth) return false;
    calls_.emplace_back();
    return true;
}

void Parameters::leave(std::optional<double> returned) {
    for (int i = 0; i < max_arguments; ++i)
        if (calls_.back().keeps && !numbered_.empty()) set(i + 1, calls_.back().kept[static_cast<std::size_t>(i)]);
    calls_.pop_back();
    returned_ = returned;
}

}  // namespace motionrack::control::gcode
