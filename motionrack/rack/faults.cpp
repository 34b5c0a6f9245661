// Finding the part that a fault is of.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::rack {

namespace {

constexpr double most = greatest_push;

struct Found {
    RunningAxis* axis = nullptr;
    std::string_view name;
    double value = 1;
};

/// Whether the machine has the part that the fault is of ("encoder.", "limit_plus." ...).
bool has_part(const parts::AxisMachine& machine, std::string_view fault) {
    const std::string_view part = fault.substr(0, fault.find('.'));
    if (part == "encoder") return machine.has_encoder();
    if (part == "limit_minus") return machine.limit_minus().present();
    if (part == "limit_plus") return machine.limit_plus().present();
    if (part == "home") return machine.home().present();
    return true;
}

Result<Found> find(Rack& rack, std::string_view fault, std::string_view target) {
    Found found;
    std::string axes;
    for (RunningAxis& axis : rack.axes()) {
        if (target.size() == 1 && target[0] == axis.config.letter) found.axis = &axis;
        axes += (axes.empty() ? "" : ", ") + std::string(1, axis.config.letter);
    }
    if (found.axis == nullptr)
        return fail(Trouble::bad_input, fmt::format("{} has no faults to inject; the axes of this rack have: {}. Nothing was done.",
                                                    in_quotes(target), axes.empty() ? "there are none" : axes));
    const std::size_t equals = fault.find('=');
    found.name = fault.substr(0, equals);
    const auto names = fault_names();
    if (std::find(names.begin(), names.end(), found.name) == names.end())
        return fail(Trouble::bad_input, fmt::format("There is no fault {}; there are: {}. Nothing was done.",
                                                    in_quotes(found.name), fmt::join(names, ", ")));
    if (equals != std::string_view::npos) {
        const std::string_view text = fault.substr(equals + 1);
        const auto [end, bad] = std::from_chars(text.data(), text.data() + text.size(), found.value);
        if (bad != std::errc() || end != text.data() + text.size() || !(std::fabs(found.value) <= most))
            return fail(Trouble::refused, fmt::format("The value of {} is {}; it is a number from {:.0f} to {:.0f}. Nothing was done.",
                                                      found.name, in_quotes(text), -most, most));
    }
    if (!has_part(*found.axis->machine, found.name))
        return fail(Trouble::refused, fmt::format("Axis {} has nothing that could have the fault {}; see its section of the rack "
                                                  "file. Nothing was done.",
                                                  target, found.name));
    return found;
}

}  // namespace

std::vector<std::string_view> fault_names() {
    const auto names = parts::AxisMachine::fault_names();
    return {names.begin(), names.end()};
}

Result<void> check_fault(Rack& rack, std::string_view fault, std::string_view target) {
    MOTIONRACK_CHECK(find(rack, fault, target));
    return {};
}

Result<void> inject_fault(Rack& rack, std::string_view fault, std::string_view target) {
    MOTIONRACK_TRY(const Found found, find(rack, fault, target));
    parts::AxisMachine& machine = *found.axis->machine;
    const auto names = fault_names();
    sim::Input input{rack.kernel().now(), sim::InputKind::fault, static_cast<std::uint16_t>(machine.id()), 0, 0, found.value};
    input.offset = static_cast<std::uint32_t>(std::find(names.begin(), names.end(), found.name) - names.begin());
    rack.input_log().add(input);
    const bool known = machine.fault(found.name, found.value, rack.kernel().now());
    MOTIONRACK_ASSERT(known);
    rack.kernel().settle();
    return {};
}

}  // namespace motionrack::rack
