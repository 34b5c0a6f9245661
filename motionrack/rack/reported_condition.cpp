#include <algorithm>
#include <motionrack/rack/reported_condition.hpp>
#include <utility>

namespace motionrack::rack {

std::vector<ReportedCondition> reported_conditions(Rack& rack, std::uint64_t since) {
    const sim::Kernel& kernel = rack.kernel();
    std::vector<ReportedCondition> out;
    std::uint64_t number = std::max(since, kernel.dropped_conditions());
    for (const sim::Condition& one : kernel.conditions(since)) {
        std::string source = one.device == sim::no_device ? "rack" : kernel.device_name(one.device);
        out.push_back({++number, one.at, std::move(source), one.code, rack.describe(one)});
    }
    return out;
}

}  // namespace motionrack::rack
