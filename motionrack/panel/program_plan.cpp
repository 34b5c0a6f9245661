// The dry run: the reader and the planner of the machine, with nothing behind them.
#include <motionrack/panel/program_plan.hpp>

#include <algorithm>
#include <cmath>
#include <motionrack/control/geometry.hpp>
#include <motionrack/control/path.hpp>

namespace motionrack::panel {

using nlohmann::json;

namespace {

constexpr std::size_t most_points = 20'000, most_problems = 100;
constexpr double radians_a_chord = 0.15;

void add_move(Polyline& line, const control::PlannedMove& planned) {
    const bool feed = planned.move.kind != control::MoveKind::traverse;
    const control::Geometry path = control::geometry_of(planned.move, planned.start);
    const int chords = path.shape == control::PathShape::arc ? std::clamp(static_cast<int>(std::fabs(path.sweep) / radians_a_chord) + 1, 1, 1000) : 1;
    for (int i = 1; i <= chords; ++i) line.add({control::position_at(path, path.length * i / chords), planned.move.line, feed});
}

/// Plans moves and sums them up.
class Sums {
  public:
    Sums(ProgramPlan& plan, const control::gcode::Settings& settings, const control::MachineLimits& limits)
        : plan_(plan), planner_(limits, settings.start), line_(most_points) {
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
            if (plan_.seconds_before.size() <= line) plan_.seconds_before.resize(line + 1, static_cast<float>(sum_.seconds));
            sum_.add(planned);
            if (planned.move.kind != control::MoveKind::dwell) add_move(line_, planned);
        }
    }
    ProgramPlan& plan_;
    control::Planner planner_;
    control::PlanSummary sum_;
    Polyline line_;
};

}  // namespace

double ProgramPlan::after(std::int32_t line) const {
    if (seconds_before.empty()) return seconds;
    const auto at = std::min(static_cast<std::size_t>(std::max(0, line)), seconds_before.size() - 1);
    return seconds - static_cast<double>(seconds_before[at]);
}

ProgramPlan plan_program(const std::string& text, const std::string& name, const control::gcode::Settings& settings, double kept_back) {
    ProgramPlan plan;
    plan.name = name;
    plan.check = control::gcode::check_program(text, settings, most_problems, name);
    if (!plan.check.problems.empty()) return plan;
    control::MachineLimits limits = settings.limits;
    for (control::AxisLimits& axis : limits) axis.max_accel *= 1 - kept_back;
    Sums sums(plan, settings, limits);
    control::gcode::Reader reader(text, settings, name);
    for (;;) {
        const auto step = reader.next();
        if (!step || *step == nullptr) break;
        if ((*step)->kind == control::gcode::StepKind::move && !sums.push((*step)->move)) break;
    }
    sums.finish();
    return plan;
}

json path_json(const std::vector<PathPoint>& path, const std::string& letters) {
    json points = json::array(), lines = json::array(), feeds = json::array();
    for (const PathPoint& point : path) {
        json place = json::array();
        for (const char letter : letters) {
            const auto axis = std::find(control::axis_letters.begin(), control::axis_letters.end(), letter) - control::axis_letters.begin();
            place.push_back(std::round(point.at[static_cast<std::size_t>(axis)] * 1e4) / 1e4);
        }
        points.push_back(std::move(place));
        lines.push_back(point.line);
        feeds.push_back(point.feed ? 1 : 0);
    }
    return {{"axes", letters}, {"points", std::move(points)}, {"lines", std::move(lines)}, {"feed", std::move(feeds)}};
}

json to_json(const ProgramPlan& plan, const std::string& letters) {
    json problems = json::array();
    for (const auto& problem : plan.check.problems)
        problems.push_back({{"line", problem.place.line}, {"column", problem.place.column}, {"message", problem.message}, {"word", problem.word}});
    json out = {{"name", plan.name}, {"good", plan.check.problems.empty()}, {"problems", std::move(problems)}, {"more_problems", plan.check.more_problems},
                {"lines", plan.check.lines}, {"moves", plan.check.moves}, {"dwells", plan.check.dwells}};
    if (!plan.check.problems.empty()) return out;
    json extents = json::object();
    for (const char letter : letters) {
        const auto axis = static_cast<std::size_t>(std::find(control::axis_letters.begin(), control::axis_letters.end(), letter) - control::axis_letters.begin());
        extents[std::string(1, letter)] = {plan.check.least[axis], plan.check.greatest[axis]};
    }
    out["extents"] = std::move(extents);
    out["seconds"] = plan.seconds;
    out["path_mm"] = plan.path_mm;
    out["thinned"] = plan.thinned;
    out["path"] = path_json(plan.path, letters);
    return out;
}

}  // namespace motionrack::panel
