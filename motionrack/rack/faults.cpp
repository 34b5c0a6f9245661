// Injects faults into the parts of a rack, and lists them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/base/numbers.hpp>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/part.hpp>
#include <motionrack/rack/part_catalogue.hpp>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::rack {

namespace {

/// A fault with its value, at the part that has it.
struct FaultAtPart {
    Part* part = nullptr;
    std::string_view name;
    double value = 1;
    std::uint32_t number = 0;  ///< index in the part's fault_names()
};

/// Finds the part of that name, if it has faults.
Result<Part*> find_target(Rack& rack, std::string_view target) {
    std::string targets;
    for (const auto& part : rack.parts()) {
        if (part->fault_names().empty()) continue;
        if (part->name() == target) return part.get();
        targets.append(targets.empty() ? "" : ", ").append(part->name());
    }
    return fail(ErrorKind::invalid_input,
                fmt::format("{} has no faults to inject; these of this rack have: {}. Nothing was done.",
                            in_quotes(target), targets.empty() ? "there are none" : targets));
}

Result<FaultAtPart> find_fault(Rack& rack, std::string_view fault, std::string_view target) {
    FaultAtPart found;
    MOTIONRACK_TRY(found.part, find_target(rack, target));
    const std::size_t equals = fault.find('=');
    found.name = fault.substr(0, equals);
    const auto names = found.part->fault_names();
    const auto at = std::find(names.begin(), names.end(), found.name);
    if (at == names.end())
        return fail(ErrorKind::invalid_input, fmt::format("The rack has no fault {}; known are: {}. Nothing was done.",
                                                          in_quotes(found.name), fmt::join(names, ", ")));
    found.number = static_cast<std::uint32_t>(at - names.begin());
    if (equals != std::string_view::npos) {
        const std::string_view text = fault.substr(equals + 1);
        found.value = number_of(text);
        if (!(std::fabs(found.value) <= max_push))
            return fail(ErrorKind::refused,
                        fmt::format("The value of {} is {}; it must be {:.0f} to {:.0f}. Nothing was done.", found.name,
                                    in_quotes(text), -max_push, max_push));
    }
    if (!found.part->can_have(found.name))
        return fail(ErrorKind::refused, fmt::format("{} has no part with the fault {}; see its section of the rack "
                                                    "file. Nothing was done.",
                                                    found.part->subject(), found.name));
    return found;
}

/// Returns the faults that the part can have.
std::vector<std::string_view> faults_of(const Part& part) {
    std::vector<std::string_view> out = part.fault_names();
    std::erase_if(out, [&](std::string_view name) { return !part.can_have(name); });
    return out;
}

}  // namespace

std::vector<std::string_view> fault_names() {
    return axis_part_kind.fault_names();
}

std::vector<FaultTarget> fault_targets(Rack& rack) {
    std::vector<FaultTarget> out;
    for (const auto& part : rack.parts())
        if (auto names = faults_of(*part); !names.empty()) out.push_back({part->name(), std::move(names)});
    return out;
}

std::vector<FaultValue> fault_values(Rack& rack) {
    std::vector<FaultValue> out;
    for (const auto& part : rack.parts())
        for (const std::string_view name : faults_of(*part)) {
            const FaultRange range = part->fault_range(name);
            out.push_back({part->name(), name, range.unit, range.doc, range.min, range.max});
        }
    return out;
}

Result<void> check_fault(Rack& rack, std::string_view fault, std::string_view target) {
    MOTIONRACK_CHECK(find_fault(rack, fault, target));
    return {};
}

Result<void> inject_fault(Rack& rack, std::string_view fault, std::string_view target) {
    MOTIONRACK_TRY(const FaultAtPart found, find_fault(rack, fault, target));
    if (found.part->drives(found.name) && rack.stop_latch().latched())
        return fail(ErrorKind::refused,
                    fmt::format("{} is stopped until a reset. Nothing was done; reset the stop, then start {} again.",
                                target, target));
    const sim::LoggedInput input{rack.kernel().now(),
                                 sim::InputKind::fault,
                                 static_cast<std::uint16_t>(found.part->device_of(found.name)),
                                 found.number,
                                 0,
                                 found.value};
    rack.input_log().add(input);
    if (!found.part->inject(rack.kernel(), found.name, found.value))
        return fail(ErrorKind::refused, fmt::format("{} cannot have the fault {} with the value {}. Nothing was done.",
                                                    target, found.name, found.value));
    rack.kernel().settle();
    return {};
}

}  // namespace motionrack::rack
