// Dry run of a program: reads and plans it as the machine does, without motion.
#include <algorithm>
#include <cmath>
#include <motionrack/control/geometry.hpp>
#include <motionrack/control/look_ahead_planner.hpp>
#include <motionrack/panel/program_plan.hpp>

namespace motionrack::panel {

using nlohmann::json;

namespace {

constexpr std::size_t max_points = 20'000, max_problems = 100;
constexpr double radians_a_chord = 0.15;

void add_move(Polyline& line, const control::PlannedMove& planned) {
    const bool feed = planned.move.kind != control::MoveKind::rapid;
    const control::Geometry path = control::geometry_of(planned.move, planned.start);
    const int chords = path.shape == control::PathShape::arc
                           ? std::clamp(static_cast<int>(std::fabs(path.sweep) / radians_a_chord) + 1, 1, 1000)
                           : 1;
    for (int i = 1; i <= chords; ++i)
        line.add({control::position_at(path, path.length * i / chords), planned.move.line, feed});
}

std::size_t axis_of(char letter) {
    return static_cast<std::size_t>(std::find(control::axis_letters.begin(), control::axis_letters.end(), letter) -
                                    control::axis_letters.begin());
}

/// Plans moves and sums up their durations, lengths and points.
class Sums {
  public:
    Sums(ProgramPlan& plan, const control::gcode::Settings& settings, const control::MachineLimits& limits)
        : plan_(plan), planner_(limits, settings.start), line_(max_points) {
        line_.add({settings.start, 0, false});
    }
    bool push(const control::Move& move) {
        while (!planner_.has_room()) pull();
        return planner_.push(move).has_value();
    }
    void finish() {
        planner_.flush();
        pull();
        plan_.seconds = sum_.seconds;
        plan_.path_mm = sum_.path_mm;
        plan_.path = line_.points();
        plan_.thinned = line_.step();
    }

  private:
    void pull() {
        control::PlannedMove planned;
        while (planner_.pull(planned)) {
            const auto line = static_cast<std::size_t>(std::max(0, planned.move.line));
            if (plan_.seconds_before.size() <= line)
                plan_.seconds_before.resize(line + 1, static_cast<float>(sum_.seconds));
            sum_.add(planned);
            if (planned.move.kind != control::MoveKind::dwell) add_move(line_, planned);
        }
    }
    ProgramPlan& plan_;
    control::LookAheadPlanner planner_;
    control::PlanSummary sum_;
    Polyline line_;
};

}  // namespace

double ProgramPlan::after(std::int32_t line) const {
    if (seconds_before.empty()) return seconds;
    const auto at = std::min(static_cast<std::size_t>(std::max(0, line)), seconds_before.size() - 1);
    return seconds - static_cast<double>(seconds_before[at]);
}

ProgramPlan plan_program(const std::string& text, const std::string& name, const control::gcode::Settings& settings,
                         double accel_reserve) {
    ProgramPlan plan;
    plan.name = name;
    plan.check = control::gcode::check_program(text, settings, max_problems, name);
    if (!plan.check.problems.empty()) return plan;
    control::MachineLimits limits = settings.limits;
    for (control::AxisLimits& axis : limits) axis.max_accel *= 1 - accel_reserve;
    Sums sums(plan, settings, limits);
    control::gcode::ProgramReader reader(text, settings, name);
    for (;;) {
        const auto step = reader.next();
        if (!step || *step == nullptr) break;
        if ((*step)->kind == control::gcode::CanonCallKind::move && !sums.push((*step)->move)) break;
    }
    sums.finish();
    return plan;
}

json position_json(const control::Point& position, const std::string& letters) {
    json out = json::array();
    for (const char letter : letters) out.push_back(std::round(position[axis_of(letter)] * 1e4) / 1e4);
    return out;
}

json to_json(const ProgramPlan& plan, const std::string& letters) {
    json problems = json::array();
    for (const auto& problem : plan.check.problems)
        problems.push_back({{"line", problem.location.line},
                            {"column", problem.location.column},
                            {"message", problem.message},
                            {"word", problem.word}});
    json out = {{"name", plan.name},
                {"ok", plan.check.problems.empty()},
                {"problems", std::move(problems)},
                {"more_problems", plan.check.more_problems},
                {"lines", plan.check.lines},
                {"moves", plan.check.moves},
                {"dwells", plan.check.dwells},
                {"axes", letters}};
    if (!plan.check.problems.empty()) return out;
    for (const char letter : letters) {
        out["min"][std::string(1, letter)] = plan.check.min[axis_of(letter)];
        out["max"][std::string(1, letter)] = plan.check.max[axis_of(letter)];
    }
    json path = json::array(), lines = json::array(), feeds = json::array();
    for (const PathPoint& point : plan.path) {
        path.push_back(position_json(point.at, letters));
        lines.push_back(point.line);
        feeds.push_back(point.feed ? 1 : 0);
    }
    out["duration_s"] = plan.seconds;
    out["length_mm"] = plan.path_mm;
    out["thinned"] = plan.thinned;
    out["path"] = std::move(path);
    out["path_lines"] = std::move(lines);
    out["path_feed"] = std::move(feeds);
    return out;
}

}  // namespace motionrack::panel
