// Reading planned faults and doing them.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <motionrack/rack/fault_plan.hpp>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::rack {

namespace {

constexpr double most_seconds = 1e6;

/// The whole text as a number, or NaN.
double number(std::string_view text) {
    double value = 0;
    const auto [end, bad] = std::from_chars(text.data(), text.data() + text.size(), value);
    return bad == std::errc() && end == text.data() + text.size() ? value : std::numeric_limits<double>::quiet_NaN();
}

/// "0.5s", "20ms", "1e3us" in seconds, or NaN.
double seconds(std::string_view text) {
    struct Unit {
        std::string_view name;
        double size;
    };
    for (const Unit unit : {Unit{"ms", 1e-3}, Unit{"us", 1e-6}, Unit{"s", 1.0}})
        if (text.size() > unit.name.size() && text.substr(text.size() - unit.name.size()) == unit.name)
            return number(text.substr(0, text.size() - unit.name.size())) * unit.size;
    return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

Result<std::unique_ptr<FaultPlan>> FaultPlan::create(Rack& rack, const std::vector<std::string>& texts) {
    std::unique_ptr<FaultPlan> plan(new FaultPlan(rack));
    for (const std::string& text : texts) {
        MOTIONRACK_TRY(PlannedFault fault, plan->read(text));
        plan->faults_.push_back(std::move(fault));
    }
    std::stable_sort(plan->faults_.begin(), plan->faults_.end(),
                     [](const PlannedFault& a, const PlannedFault& b) { return a.at < b.at; });
    plan->id_ = rack.kernel().add(*plan, sim::Phase::wires, "faults");
    return plan;
}

Result<PlannedFault> FaultPlan::read(const std::string& text) {
    PlannedFault fault;
    fault.text = text;
    const std::size_t at = text.rfind('@');
    const double time = at == std::string::npos ? std::nan("") : seconds(std::string_view(text).substr(at + 1));
    if (!(time >= 0 && time <= most_seconds))
        return fail(Trouble::bad_input,
                    fmt::format("The fault {} needs its time, 0 to {:.0f} s: NAME=VALUE@TIME, such as X.limit_plus=0@0.5s or "
                                "X.encoder.broken_a@20ms. Nothing was moved.",
                                in_quotes(text), most_seconds));
    fault.at = from_seconds(time);
    MOTIONRACK_CHECK(read_action(text, std::string_view(text).substr(0, at), fault));
    return fault;
}

Result<void> FaultPlan::read_action(const std::string& text, std::string_view action, PlannedFault& fault) {
    const std::size_t equals = action.find('=');
    const std::string_view name = action.substr(0, equals);
    if (desk_.knows(name)) {
        const std::string_view value = equals == std::string_view::npos ? "1" : action.substr(equals + 1);
        fault.name = name;
        fault.value = number(value);
        if (std::isnan(fault.value) && value != "release")
            return fail(Trouble::bad_input, fmt::format("The fault {}: the value of a wire is 0, 1 or release, not {}. Nothing was "
                                                        "moved.",
                                                        in_quotes(text), in_quotes(value)));
        return desk_.check(name, fault.value);
    }
    const std::size_t dot = action.find('.');
    if (dot == std::string_view::npos)
        return fail(Trouble::bad_input, fmt::format("The fault {} names neither a wire (X.limit_plus, estop) nor a fault of an axis "
                                                    "(X.encoder.broken_a). Nothing was moved.",
                                                    in_quotes(text)));
    fault.target = action.substr(0, dot);
    fault.name = action.substr(dot + 1);
    const Result<void> known = check_fault(rack_, fault.name, fault.target);
    if (!known && known.error().trouble == Trouble::bad_input)
        return fail(Trouble::bad_input, fmt::format("The fault {}: {} {}", in_quotes(text), desk_.check(name, 1).error().message,
                                                    known.error().message));
    return known;
}

void FaultPlan::begin() {
    if (!faults_.empty()) rack_.kernel().schedule(id_, std::max(faults_.front().at, rack_.kernel().now()));
}

void FaultPlan::act(Instant now) {
    rack_.kernel().break_run();
    for (const PlannedFault& fault : faults_)
        if (fault.at > now) return rack_.kernel().schedule(id_, fault.at);
}

void FaultPlan::apply_due() {
    for (PlannedFault& fault : faults_) {
        if (fault.done || fault.at > rack_.kernel().now()) continue;
        fault.done = true;
        const Result<void> done = fault.target.empty() ? desk_.set(fault.name, fault.value)
                                                       : inject_fault(rack_, fault.name, fault.target);
        if (!done) fault.refused = done.error().message;  // only the part itself knows which values it can have
    }
}

std::vector<std::string> FaultPlan::not_done() const {
    std::vector<std::string> out;
    for (const PlannedFault& fault : faults_) {
        if (!fault.done) out.push_back("the run ended before the fault " + fault.text);
        if (!fault.refused.empty()) out.push_back("the fault " + fault.text + " was refused: " + fault.refused);
    }
    return out;
}

void FaultPlan::copy_from(const FaultPlan& other) {
    faults_ = other.faults_;
    desk_.copy_from(other.desk_);
}

}  // namespace motionrack::rack
