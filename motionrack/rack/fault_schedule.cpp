// Parses planned faults and applies them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/base/numbers.hpp>
#include <motionrack/rack/fault_schedule.hpp>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::rack {

Result<std::vector<ScheduledText>> read_faults(const std::vector<std::string>& texts) {
    std::vector<ScheduledText> faults;
    for (const std::string& text : texts) {
        std::optional<ScheduledText> timed = read_timed_text(text);
        if (!timed)
            return fail(
                ErrorKind::invalid_input,
                fmt::format(
                    "The fault {} needs its time, 0 to {:.0f} s: NAME=VALUE@TIME, such as X.limit_plus=0@0.5s or "
                    "X.encoder.broken_a@20ms. Nothing was moved.",
                    in_quotes(text), max_planned_seconds));
        faults.push_back(std::move(*timed));
    }
    return faults;
}

Result<std::unique_ptr<FaultSchedule>> FaultSchedule::create(Rack& rack, const std::vector<std::string>& texts) {
    MOTIONRACK_TRY(const std::vector<ScheduledText> faults, read_faults(texts));
    return create_timed(rack, faults);
}

Result<std::unique_ptr<FaultSchedule>> FaultSchedule::create_timed(Rack& rack,
                                                                   const std::vector<ScheduledText>& faults) {
    std::unique_ptr<FaultSchedule> plan(new FaultSchedule(rack));
    for (const ScheduledText& text : faults) {
        ScheduledFault fault;
        fault.text = text.text;
        fault.at = text.at;
        MOTIONRACK_CHECK(plan->read_action(text.text, text.action, fault));
        plan->faults_.push_back(std::move(fault));
    }
    std::stable_sort(plan->faults_.begin(), plan->faults_.end(),
                     [](const ScheduledFault& a, const ScheduledFault& b) { return a.at < b.at; });
    plan->id_ = rack.kernel().add(*plan, sim::Phase::wires, "faults");
    return plan;
}

Result<void> FaultSchedule::read_action(const std::string& text, std::string_view action, ScheduledFault& fault) {
    const std::size_t equals = action.find('=');
    const std::string_view name = action.substr(0, equals);
    if (context_.knows(name)) {
        const std::string_view value = equals == std::string_view::npos ? "1" : action.substr(equals + 1);
        fault.name = name;
        fault.value = number_of(value);
        if (std::isnan(fault.value) && value != "release")
            return fail(ErrorKind::invalid_input,
                        fmt::format("The fault {}: the value of a wire must be 0, 1 or release, not {}. Nothing was "
                                    "moved.",
                                    in_quotes(text), in_quotes(value)));
        return context_.check(name, fault.value);
    }
    const std::size_t dot = action.find('.');
    if (dot == std::string_view::npos)
        return fail(ErrorKind::invalid_input,
                    fmt::format("The fault {} names neither a wire (X.limit_plus, estop) nor a fault of an axis "
                                "(X.encoder.broken_a). Nothing was moved.",
                                in_quotes(text)));
    fault.target = action.substr(0, dot);
    fault.name = action.substr(dot + 1);
    const Result<void> known = check_fault(rack_, fault.name, fault.target);
    if (!known && known.error().kind == ErrorKind::invalid_input)
        return fail(ErrorKind::invalid_input,
                    fmt::format("The fault {}: {} {}", in_quotes(text), context_.check(name, 1).error().message,
                                known.error().message));
    return known;
}

void FaultSchedule::begin() {
    if (!faults_.empty()) rack_.kernel().schedule(id_, std::max(faults_.front().at, rack_.kernel().now()));
}

void FaultSchedule::on_scheduled(Instant now) {
    rack_.kernel().break_run();
    for (const ScheduledFault& fault : faults_)
        if (fault.at > now) return rack_.kernel().schedule(id_, fault.at);
}

void FaultSchedule::apply_due() {
    for (ScheduledFault& fault : faults_) {
        if (fault.done || fault.at > rack_.kernel().now()) continue;
        fault.done = true;
        const Result<void> done = fault.target.empty() ? context_.force(fault.name, fault.value)
                                                       : inject_fault(rack_, fault.name, fault.target);
        if (!done) fault.refused = done.error().message;  // only the part itself knows its permitted values
    }
}

std::vector<std::string> FaultSchedule::not_done() const {
    std::vector<std::string> out;
    for (const ScheduledFault& fault : faults_) {
        if (!fault.done) out.push_back("the run ended before the fault " + fault.text);
        if (!fault.refused.empty()) out.push_back("the fault " + fault.text + " was refused: " + fault.refused);
    }
    return out;
}

void FaultSchedule::copy_from(const FaultSchedule& other) {
    faults_ = other.faults_;
    context_.copy_from(other.context_);
}

}  // namespace motionrack::rack
