// Homing results as text, JSON and picture.
#include <fmt/format.h>

#include <cmath>
#include <motionrack/rack/homing_report.hpp>
#include <motionrack/trace/svg.hpp>
#include <nlohmann/json.hpp>

namespace motionrack::rack {

namespace {

/// Returns true for states that take time or are final.
bool shown(const control::HomingStateVisit& stay) {
    return stay.state.size() < 6 || stay.state.compare(stay.state.size() - 6, 6, "_START") != 0;
}

/// Turns "-0.0000" into 0.
double plain(double value) {
    return std::fabs(value) < 5e-5 ? 0 : value;
}

/// Rounds for JSON: to a nanosecond, a nanometre.
double rounded(double value) {
    return std::round(value * 1e9) / 1e9;
}

std::string head_line(const HomedAxis& axis) {
    const control::HomingResult& o = axis.outcome;
    std::string out = fmt::format("axis {}  method {}, {} direction, search at {:.4g} {}/s, latch at {:.4g} {}/s\n",
                                  axis.letter, static_cast<int>(axis.order.method), axis.order.towards_plus ? "+" : "-",
                                  axis.order.search_velocity, axis.unit, axis.order.latch_velocity, axis.unit);
    if (!axis.begun) return out + "  not begun\n";
    return out + fmt::format("  {} after {:.3f} s, {}\n", o.homed ? "homed" : "not homed", o.took_s,
                             o.homed ? "the position is valid" : "the position is not valid");
}

std::string axis_text(const HomedAxis& axis) {
    const control::HomingResult& o = axis.outcome;
    std::string out = head_line(axis);
    if (!axis.begun) return out;
    out += fmt::format("\n  {:<14} {:>9} {:>9} {:>12} {:>12}\n", "state", "from s", "took s", "from " + axis.unit,
                       "to " + axis.unit);
    for (const control::HomingStateVisit& stay : o.stays)
        if (shown(stay))
            out += fmt::format("  {:<14} {:9.3f} {:9.3f} {:12.4f} {:12.4f}\n", stay.state, stay.from_s, stay.took_s,
                               plain(stay.from), plain(stay.to));
    if (!o.edges.empty())
        out += fmt::format("\n  {:<14} {:>9} {:>9} {:>12} {:>12}   {}\n", "found", "at s", axis.unit + "/s",
                           "at " + axis.unit, "or before", "in");
    for (const control::HomingEdge& edge : o.edges)
        out += fmt::format("  {:<14} {:9.3f} {:9.3f} {:12.4f} {:>12}   {}\n", edge.what, edge.seconds, edge.velocity,
                           plain(edge.position), edge.within > 0 ? fmt::format("{:.4f}", edge.within) : "exact",
                           edge.state);
    out += '\n';
    if (o.switch_to_index)
        out += fmt::format("  from the switch to the index  {:.4f} {}\n", *o.switch_to_index, axis.unit);
    if (o.bounces > 0) out += fmt::format("  bounces of the switch seen    {}\n", o.bounces);
    out += fmt::format("  counter {:.4f}, encoder {:.4f}, machine {:.4f} {}", plain(axis.counter_position),
                       plain(axis.measured_position), plain(axis.machine_position), axis.unit);
    if (axis.lost_pulses != 0) out += fmt::format("; {} pulses lost since the start", axis.lost_pulses);
    out += '\n';
    for (const std::string& note : o.notes) out += fmt::format("  note: {}\n", note);
    return out;
}

nlohmann::ordered_json axis_json(const HomedAxis& axis) {
    const control::HomingResult& o = axis.outcome;
    nlohmann::ordered_json j = {{"axis", std::string(1, axis.letter)},
                                {"unit", axis.unit},
                                {"method", static_cast<int>(axis.order.method)},
                                {"search_direction", axis.order.towards_plus ? "plus" : "minus"},
                                {"search_velocity", axis.order.search_velocity},
                                {"latch_velocity", axis.order.latch_velocity},
                                {"begun", axis.begun},
                                {"homed", o.homed},
                                {"duration_s", rounded(o.took_s)},
                                {"sentence", o.sentence}};
    j["states"] = nlohmann::ordered_json::array();
    for (const control::HomingStateVisit& stay : o.stays)
        j["states"].push_back({{"state", stay.state},
                               {"from_s", rounded(stay.from_s)},
                               {"took_s", rounded(stay.took_s)},
                               {"from", rounded(stay.from)},
                               {"to", rounded(stay.to)}});
    j["edges"] = nlohmann::ordered_json::array();
    for (const control::HomingEdge& edge : o.edges)
        j["edges"].push_back({{"what", edge.what},
                              {"state", edge.state},
                              {"time_s", rounded(edge.seconds)},
                              {"position", rounded(edge.position)},
                              {"within", rounded(edge.within)},
                              {"velocity", rounded(edge.velocity)}});
    j["switch_to_index"] =
        o.switch_to_index ? nlohmann::ordered_json(rounded(*o.switch_to_index)) : nlohmann::ordered_json(nullptr);
    j["bounces"] = o.bounces;
    j["notes"] = o.notes;
    j["counter_position"] = rounded(axis.counter_position);
    j["measured_position"] = rounded(axis.measured_position);
    j["machine_position"] = rounded(axis.machine_position);
    j["lost_pulses"] = axis.lost_pulses;
    return j;
}

}  // namespace

std::string homing_states_text(const std::vector<control::AxisHomingState>& states) {
    std::string out;
    for (const control::AxisHomingState& one : states)
        out += fmt::format("{}{} {}", out.empty() ? "" : ", ", one.letter, one.state);
    return out;
}

std::string homing_text(const HomingOutcome& outcome) {
    std::string out;
    for (const HomedAxis& axis : outcome.axes) out += axis_text(axis) + "\n";
    if (!outcome.axes.empty())
        out += fmt::format("{} in {:.3f} s\n", outcome.all_homed() ? "all homed" : "not all homed", outcome.seconds);
    return out;
}

nlohmann::ordered_json homing_report(const HomingOutcome& outcome) {
    nlohmann::ordered_json j = {{"homed", outcome.all_homed()},
                                {"duration_s", rounded(outcome.seconds)},
                                {"error", outcome.ended ? nlohmann::ordered_json(nullptr)
                                                        : nlohmann::ordered_json(outcome.ended.error().message)}};
    j["axes"] = nlohmann::ordered_json::array();
    for (const HomedAxis& axis : outcome.axes) j["axes"].push_back(axis_json(axis));
    return j;
}

std::string homing_json(const HomingOutcome& outcome) {
    return homing_report(outcome).dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string homing_picture(const HomedAxis& axis) {
    const HomingSamples& s = axis.samples;
    const std::vector<trace::SvgChart> charts = {
        {fmt::format("position, {}", axis.unit), {{"", "z", s.seconds, s.position}}, {}},
        {fmt::format("velocity, {}/s", axis.unit), {{"", "y", s.seconds, s.velocity}}, {}},
    };
    std::vector<trace::SvgSpan> spans;
    for (const control::HomingStateVisit& stay : axis.outcome.stays) {
        if (!shown(stay) || !(stay.took_s > 0)) continue;
        const std::string name = stay.state.substr(0, stay.state.find("_WAIT"));
        spans.push_back({fmt::format("{} {:.3f} s", name, stay.took_s), stay.from_s, stay.from_s + stay.took_s});
    }
    return trace::svg_timeline(
        fmt::format("Axis {} {}, method {}", axis.letter, axis.outcome.homed ? "is homed" : "fails to home",
                    static_cast<int>(axis.order.method)),
        charts, spans, {720, 560, true});
}

}  // namespace motionrack::rack
