// Finds the target of a fault.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <motionrack/base/numbers.hpp>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::rack {

namespace {

/// Faults of encoder tracks that are wires; other encoder faults belong to the machine.
constexpr std::array<std::string_view, 7> line_faults = {
    "encoder.inverted_a", "encoder.inverted_b", "encoder.noise",       "encoder.jitter",
    "encoder.dirt",       "encoder.overspeed",  "encoder.eccentricity"};

bool of_lines(std::string_view fault) {
    return std::find(line_faults.begin(), line_faults.end(), fault) != line_faults.end();
}

/// A part that accepts faults: an axis' mechanics or servo, a stage's motor or scale, a belt or table, or a card.
struct Found {
    RunningAxis* axis = nullptr;
    Card* card = nullptr;
    RunningStage* stage = nullptr;
    RunningConveyor* track = nullptr;
    std::string_view name;
    double value = 1;
    bool of_servo() const { return axis != nullptr && axis->servo && name.substr(0, 6) == "motor."; }
};

/// Returns true if the machine has the part named by the fault ("encoder.", "limit_plus." ...).
bool has_part(const RunningAxis& axis, std::string_view fault) {
    const parts::AxisMechanics& machine = *axis.machine;
    const std::string_view part = fault.substr(0, fault.find('.'));
    if (of_lines(fault)) return axis.lines != nullptr;
    if (part == "encoder") return machine.has_encoder();
    if (part == "limit_minus") return machine.switches().limit_minus().present();
    if (part == "limit_plus") return machine.switches().limit_plus().present();
    if (part == "home") return machine.switches().home().present();
    const auto knows = [fault](std::span<const std::string_view> names) {
        return std::find(names.begin(), names.end(), fault) != names.end();
    };
    return axis.servo ? knows(parts::DcMotor::fault_names()) : knows(parts::AxisMechanics::fault_names());
}

std::vector<std::string_view> names_of(const Found& found) {
    if (found.axis != nullptr) return fault_names();
    if (found.stage != nullptr) {
        const auto motor = parts::LinearStage::fault_names(), scale = parts::LinearScale::fault_names();
        std::vector<std::string_view> out(motor.begin(), motor.end());
        out.insert(out.end(), scale.begin(), scale.end());
        return out;
    }
    if (found.track != nullptr) return found.track->fault_names();
    const auto names = found.card->fault_names();
    return {names.begin(), names.end()};
}

Result<Found> find(Rack& rack, std::string_view fault, std::string_view target) {
    Found found;
    std::string targets;
    const auto add = [&targets](std::string_view name) { targets.append(targets.empty() ? "" : ", ").append(name); };
    for (RunningAxis& axis : rack.axes()) {
        if (target.size() == 1 && target[0] == axis.config.letter) found.axis = &axis;
        add(std::string(1, axis.config.letter));
    }
    for (const auto& card : rack.cards()) {
        if (card->fault_names().empty()) continue;
        if (target == card->name()) found.card = card.get();
        add(card->name());
    }
    for (RunningStage& stage : rack.stages()) {
        if (target == stage.config.name) found.stage = &stage;
        add(stage.config.name);
    }
    for (RunningConveyor& track : rack.tracks()) {
        if (target == track.config.name) found.track = &track;
        add(track.config.name);
    }
    if (found.axis == nullptr && found.card == nullptr && found.stage == nullptr && found.track == nullptr)
        return fail(ErrorKind::invalid_input,
                    fmt::format("{} has no faults to inject; these of this rack have: {}. Nothing was done.",
                                in_quotes(target), targets.empty() ? "there are none" : targets));
    const std::size_t equals = fault.find('=');
    found.name = fault.substr(0, equals);
    const auto names = names_of(found);
    if (std::find(names.begin(), names.end(), found.name) == names.end())
        return fail(ErrorKind::invalid_input, fmt::format("The rack has no fault {}; known are: {}. Nothing was done.",
                                                          in_quotes(found.name), fmt::join(names, ", ")));
    if (equals != std::string_view::npos) {
        const std::string_view text = fault.substr(equals + 1);
        found.value = number_of(text);
        if (!(std::fabs(found.value) <= max_push))
            return fail(ErrorKind::refused,
                        fmt::format("The value of {} is {}; it is a number from {:.0f} to {:.0f}. Nothing was done.",
                                    found.name, in_quotes(text), -max_push, max_push));
    }
    if (found.axis != nullptr && !has_part(*found.axis, found.name))
        return fail(ErrorKind::refused,
                    fmt::format("Axis {} has no part with the fault {}; see its section of the rack "
                                "file. Nothing was done.",
                                target, found.name));
    return found;
}

sim::DeviceId device_of(const Found& found) {
    if (found.card != nullptr) return found.card->device();
    if (found.stage != nullptr)
        return found.name.substr(0, 6) == "scale." ? found.stage->scale->id() : found.stage->motor->id();
    if (found.track != nullptr) return found.track->device_of(found.name);
    if (found.of_servo()) return found.axis->servo->id();
    return of_lines(found.name) ? found.axis->lines->id() : found.axis->machine->id();
}

}  // namespace

std::vector<std::string_view> fault_names() {
    const auto machine = parts::AxisMechanics::fault_names();
    std::vector<std::string_view> out(machine.begin(), machine.end());
    for (const std::string_view name : parts::DcMotor::fault_names())
        if (std::find(out.begin(), out.end(), name) == out.end()) out.push_back(name);
    out.insert(out.end(), line_faults.begin(), line_faults.end());
    return out;
}

std::vector<FaultTarget> fault_targets(Rack& rack) {
    std::vector<FaultTarget> out;
    for (RunningAxis& axis : rack.axes()) {
        FaultTarget& target = out.emplace_back(FaultTarget{std::string(1, axis.config.letter), {}});
        for (const std::string_view name : fault_names())
            if (has_part(axis, name)) target.faults.push_back(name);
    }
    const auto add = [&out](const std::string& name, const Found& found) {
        if (auto names = names_of(found); !names.empty()) out.push_back({name, std::move(names)});
    };
    for (const auto& card : rack.cards()) add(card->name(), {nullptr, card.get(), nullptr, nullptr, {}, 1});
    for (RunningStage& stage : rack.stages()) add(stage.config.name, {nullptr, nullptr, &stage, nullptr, {}, 1});
    for (RunningConveyor& track : rack.tracks()) add(track.config.name, {nullptr, nullptr, nullptr, &track, {}, 1});
    return out;
}

Result<void> check_fault(Rack& rack, std::string_view fault, std::string_view target) {
    MOTIONRACK_CHECK(find(rack, fault, target));
    return {};
}

Result<void> inject_fault(Rack& rack, std::string_view fault, std::string_view target) {
    MOTIONRACK_TRY(const Found found, find(rack, fault, target));
    if (found.track != nullptr && rack.stop_latch().latched() && found.name.substr(0, 6) == "drive.")
        return fail(ErrorKind::refused,
                    fmt::format("{} is stopped until a reset. Nothing was done; reset the stop, then start {} again.",
                                target, target));
    const Instant now = rack.kernel().now();
    const sim::DeviceId device = device_of(found);
    const auto names = names_of(found);
    sim::LoggedInput input{now, sim::InputKind::fault, static_cast<std::uint16_t>(device), 0, 0, found.value};
    input.offset = static_cast<std::uint32_t>(std::find(names.begin(), names.end(), found.name) - names.begin());
    rack.input_log().add(input);
    const bool known = found.card != nullptr ? found.card->fault(found.name, found.value, now)
                                             : rack.kernel().device(device).fault(found.name, found.value, now);
    if (!known)
        return fail(ErrorKind::refused, fmt::format("{} cannot have the fault {} with the value {}. Nothing was done.",
                                                    target, found.name, found.value));
    rack.kernel().settle();
    return {};
}

}  // namespace motionrack::rack
