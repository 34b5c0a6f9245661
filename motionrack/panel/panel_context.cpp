// Functions shared by the handlers of commands and queries.
#include <algorithm>
#include <cmath>
#include <motionrack/panel/panel_context.hpp>

namespace motionrack::panel {

using nlohmann::json;

Reply::PendingCall::~PendingCall() {
    if (call) call(refused_answer(503, "machine", "The machine was shut down before the command was executed."));
}

const Event& EventLog::add(Event event) {
    event.number = next_++;
    if (events_.size() >= max_events) events_.pop_front();
    events_.push_back(std::move(event));
    for (const auto& call : listeners_) call(events_.back());
    return events_.back();
}

void ActualPath::add(const operate::Status& status) {
    ActualPoint point;
    point.at = status.at;
    double linear = 0, rotary = 0;
    for (const operate::AxisStatus& axis : status.axes) {
        const auto i = static_cast<std::size_t>(
            std::find(control::axis_letters.begin(), control::axis_letters.end(), axis.letter) -
            control::axis_letters.begin());
        const double error = axis.commanded - axis.actual;
        point.position[i] = axis.actual;
        (axis.rotary ? rotary : linear) += error * error;
    }
    point.error = std::sqrt(linear > 0 ? linear : rotary);
    if (!points_.empty()) {
        double far = 0;
        for (std::size_t i = 0; i < point.position.size(); ++i)
            far = std::max(far, std::fabs(point.position[i] - points_.back().position[i]));
        if (far < apart) return;
    }
    if (points_.size() >= max_points) points_.pop_front();
    points_.push_back(point);
}

Result<json> accepted(const Result<void>& result) {
    if (!result) return tl::unexpected<Error>(result.error());
    return json::object();
}

double number_of(const json& fields, std::string_view name, double otherwise) {
    const auto found = fields.find(name);
    return found == fields.end() ? otherwise : found->get<double>();
}

}  // namespace motionrack::panel
