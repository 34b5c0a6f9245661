// Formats a job's results: report data, summary, JSON, CSV.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/control/probing.hpp>
#include <motionrack/rack/count_noun.hpp>
#include <motionrack/rack/job_report.hpp>
#include <motionrack/rack/report_segment.hpp>
#include <nlohmann/json.hpp>

namespace motionrack::rack {

namespace {

constexpr std::size_t max_segments = 20'000;

const char* kind_text(control::MoveKind kind) {
    switch (kind) {
        case control::MoveKind::rapid:
            return "traverse";
        case control::MoveKind::feed:
            return "line";
        case control::MoveKind::arc:
            return "arc";
        case control::MoveKind::dwell:
            return "dwell";
    }
    return "";
}

/// Finds the lines of a text by their numbers.
class LineIndex {
  public:
    explicit LineIndex(std::string_view text) {
        std::size_t begin = 0;
        for (std::size_t i = 0; i <= text.size(); ++i) {
            if (i < text.size() && text[i] != '\n') continue;
            std::string_view line = text.substr(begin, i - begin);
            while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
            lines_.push_back(line.substr(0, 120));
            begin = i + 1;
        }
    }
    std::string operator[](int line) const {
        return line >= 1 && static_cast<std::size_t>(line) <= lines_.size()
                   ? std::string(lines_[static_cast<std::size_t>(line) - 1])
                   : "";
    }

  private:
    std::vector<std::string_view> lines_;
};

void add_axes(trace::ReportData& data, const Job& job, const JobOutcome& outcome) {
    const std::vector<MonitorSample>& samples = job.monitor().samples();
    for (const AxisOutcome& axis : outcome.axes) {
        trace::ReportAxis out;
        const auto i = static_cast<std::size_t>(axis.index);
        out.name = std::string(1, control::axis_letters[i]);
        out.unit = axis.unit;
        out.servo = axis.servo;
        out.min_position = axis.limits.min_position;
        out.max_position = axis.limits.max_position;
        out.max_velocity = axis.limits.max_velocity;
        out.max_accel = axis.limits.max_accel;
        out.pulses_sent = axis.pulses_sent;
        out.pulses_net = axis.pulses_net;
        out.pulse_counter = axis.pulse_position - axis.pulse_start;
        out.encoder_counts = axis.encoder_counts;
        out.expected_counts = axis.expected_counts;
        out.lost_steps = axis.lost_pulses;
        out.peak_velocity = axis.top.peak_velocity;
        out.peak_accel = axis.top.peak_accel;
        out.peak_velocity_step = axis.top.peak_velocity_step;
        out.planned_end = axis.planned_end;
        out.actual_end = axis.actual_end;
        for (std::size_t s = 0; s < samples.size(); ++s) {
            out.position.push_back(static_cast<float>(samples[s].position[i]));
            out.velocity.push_back(static_cast<float>(samples[s].velocity[i]));
            out.accel.push_back(samples[s].accel[i]);
            if (axis.servo) out.volts.push_back(samples[s].volts[i]);
        }
        data.axes.push_back(std::move(out));
    }
}

std::string verdict_text(const JobOutcome& outcome) {
    if (!outcome.ended) return outcome.ended.error().message;
    if (!outcome.position_valid)
        return "The program ended, but motors lost steps: the true positions differ from the commanded ones. "
               "Lower velocity or acceleration.";
    if (const std::vector<Breach>& breaches = outcome.breaches.all(); !breaches.empty())
        return fmt::format("The program ended, but motors may have lost steps: {}{}.", sentence_of(breaches.front()),
                           breaches.size() > 1 ? ". Other limits were broken too; see the warnings" : "");
    if (outcome.rest_axis < 0) return "The program ended; every axis is exactly at its commanded position.";
    return fmt::format("The program ended; servos are at most {:.3f} {} ({}) from their commanded positions.",
                       outcome.rest_off, outcome.rest_axis < 3 ? "mm" : "deg",
                       control::axis_letters[static_cast<std::size_t>(outcome.rest_axis)]);
}

/// Returns the number of planned moves; for jerk-limited trajectories, planned in many short lines, that of the
/// programmed ones.
std::int64_t moves_of(const RackConfig& config, const JobOutcome& outcome) {
    return config.jerk_limited() ? outcome.run.moves : outcome.run.plan.moves;
}

}  // namespace

trace::ReportData report_of(Rack& rack, const Job& job, const JobOutcome& outcome, std::string_view program,
                            const std::string& program_name) {
    trace::ReportData data;
    data.title = program_name;
    data.program_name = program_name;
    data.rack_name = rack.config().name;
    data.verdict = {outcome.good(), verdict_text(outcome)};
    // Of a job that ended early, moves and path are those of the plan, not those that were driven.
    const bool whole = outcome.ended.has_value();
    data.numbers = {{"Time of the job", fmt::format("{:.3f}", to_seconds(outcome.time)), "s"},
                    {whole ? "Path" : "Planned path", fmt::format("{:.1f}", outcome.path_mm), "mm"},
                    {whole ? "Moves" : "Planned moves", fmt::format("{}", moves_of(rack.config(), outcome)), ""},
                    {"Max deviation", fmt::format("{:.4f}", outcome.max_deviation.mm), "mm"}};
    if (!rack.config().point_to_point())
        data.numbers.push_back({"Chip segments", fmt::format("{}", outcome.chip_segments), ""});
    add_axes(data, job, outcome);
    const std::vector<MonitorSample>& samples = job.monitor().samples();
    const Instant began = samples.empty() ? Instant{0} : samples.front().at;
    for (const MonitorSample& sample : samples) {
        data.seconds.push_back(to_seconds(sample.at - began));
        data.driven.push_back({sample.position[0], sample.position[1], sample.position[2]});
    }
    for (const double off : job.monitor().deviations()) data.deviation_mm.push_back(static_cast<float>(off));
    data.tolerance_mm = outcome.tolerance_mm;
    for (const control::PlannedMove& planned : job.planned())
        if (data.planned.size() < max_segments && planned.move.kind != control::MoveKind::dwell)
            data.planned.push_back(path_segment(planned.move, planned.start));
    if (outcome.max_deviation.mm > 0)
        data.max_deviation =
            trace::ReportMaxDeviation{outcome.max_deviation.mm, to_seconds(outcome.max_deviation.at - began),
                                      outcome.max_deviation.line, outcome.max_deviation.position};
    if (!outcome.ended && !samples.empty())
        data.stop = trace::ReportStop{data.seconds.back(), outcome.ended.error().location.line, data.driven.back(),
                                      outcome.ended.error().message};
    const LineIndex lines(program);
    for (const ExecutedMove& move : job.monitor().blocks())
        data.moves.push_back({move.line, lines[move.line], kind_text(move.kind), move.length, "mm",
                              to_seconds(move.start - began), to_seconds(move.end - move.start), move.entry_velocity,
                              move.cruise_velocity, move.exit_velocity, move.deviation_mm});
    for (const JobWarning& warning : outcome.warnings)
        data.warnings.push_back({to_seconds(warning.at - began), warning.line, warning.text});
    data.notes = {
        fmt::format("Positions are those of the motors' rotors, sampled every {:.3g} ms; motion between two samples is "
                    "not drawn.",
                    to_seconds(job.monitor().period()) * 1e3),
        "Velocities are those of the pulse train; acceleration is computed over four samples. Where the velocity jumps "
        "(at a start, a stop, a corner) no acceleration is drawn; the table has the maximum jump, less the part that "
        "comes from rounding to whole pulses in short segments.",
        "The machine is stiff: no vibration, no bending, no play unless the rack file says so.",
        "Deviation is the distance of X, Y, Z from the program as it is written: before corners are cut, short moves "
        "are merged and positions rounded to pulses. It does not include the lag of a rotary axis."};
    if (outcome.rest_axis >= 0)
        data.notes.push_back(
            "The velocity of a servo follows its voltage after the card's relay, with its lag, current limit and "
            "friction; the duration of a move follows from the card's slope table, not from the plan. The table has 24 "
            "steps of velocity up and 24 down, each a jump of the voltage, so the acceleration alternates above and "
            "below its limit.");
    return data;
}

// ---- summary

std::string summary_of(const RackConfig& config, const JobOutcome& outcome) {
    std::string out = fmt::format("{}\n", verdict_text(outcome));
    out += fmt::format("  rack        {}\n", config.name);
    const bool whole = outcome.ended.has_value();
    const std::string counts =
        fmt::format("{}, {}, {}", count_noun(moves_of(config, outcome), "move"),
                    count_noun(outcome.run.plan.dwells, "dwell"), count_noun(outcome.run.plan.stops, "stop"));
    out += fmt::format("  time        {:.3f} s (planned {:.3f} s{}{}{}\n", to_seconds(outcome.time),
                       outcome.run.plan.seconds, whole ? "), " : " with ", counts, whole ? "" : ")");
    out += fmt::format("  path        {:.3f} mm{}, max deviation from the program {:.4f} mm", outcome.path_mm,
                       whole ? "" : " planned", outcome.max_deviation.mm);
    if (outcome.max_deviation.line > 0)
        out += fmt::format(" in line {} at {:.3f} s", outcome.max_deviation.line, to_seconds(outcome.max_deviation.at));
    if (outcome.tolerance_mm > 0) out += fmt::format(" (tolerance {:.4f} mm)", outcome.tolerance_mm);
    for (const control::ProgramProbe& probe : outcome.run.probes)
        out += fmt::format("\n  line {:<6} {}", probe.line, control::probe_text(probe.probe, probe.outcome));
    out += fmt::format("\n\n  {:<5}{:>12}{:>12}{:>12}{:>8}{:>10}{:>26}{:>24}\n", "axis", "pulses", "counts", "expected",
                       "lost", "ends at", "peak velocity / limit", "peak accel / limit");
    const auto of_pulses = [](const AxisOutcome& axis, std::int64_t count) {
        return axis.servo ? std::string("-") : fmt::format("{}", count);
    };
    for (const AxisOutcome& axis : outcome.axes)
        out += fmt::format("  {:<5}{:>12}{:>12}{:>12}{:>8}{:>10.4f} {:<3}{:>13.3f} /{:>7.4g}{:>15.1f} /{:>7.4g}\n",
                           control::axis_letters[static_cast<std::size_t>(axis.index)],
                           of_pulses(axis, axis.pulses_sent), axis.encoder_counts, axis.expected_counts,
                           of_pulses(axis, axis.lost_pulses), axis.actual_end, axis.unit, axis.top.peak_velocity,
                           axis.limits.max_velocity, axis.top.peak_accel, axis.limits.max_accel);
    return out;
}

std::string summary_json(const RackConfig& config, const JobOutcome& outcome) {
    nlohmann::ordered_json json;
    json["ok"] = outcome.good();
    json["verdict"] = verdict_text(outcome);
    if (!outcome.ended)
        json["error"] = {{"message", outcome.ended.error().message}, {"line", outcome.ended.error().location.line}};
    json["rack"] = config.name;
    json["duration_s"] = to_seconds(outcome.time);
    json["planned_duration_s"] = outcome.run.plan.seconds;
    json["path_mm"] = outcome.path_mm;
    json["moves"] = moves_of(config, outcome);
    json["lines"] = outcome.run.lines;
    json["chip_segments"] = outcome.chip_segments;
    json["events"] = outcome.events;
    json["trace_hash"] = fmt::format("{:016x}", outcome.trace_hash);
    json["position_valid"] = outcome.position_valid;
    json["max_deviation"] = {{"from", "program"},
                             {"mm", outcome.max_deviation.mm},
                             {"line", outcome.max_deviation.line},
                             {"time_s", to_seconds(outcome.max_deviation.at)}};
    if (!outcome.run.probes.empty()) json["probes"] = nlohmann::ordered_json::array();
    for (const control::ProgramProbe& probe : outcome.run.probes)
        json["probes"].push_back({{"line", probe.line}, {"hit", probe.outcome.hit}, {"at", probe.outcome.at}});
    for (const Breach& breach : outcome.breaches.all())
        json["breaches"].push_back(
            {{"kind", name_of(breach.kind)},
             {"axis",
              breach.axis < 0 ? "" : std::string(1, control::axis_letters[static_cast<std::size_t>(breach.axis)])},
             {"value", breach.value},
             {"limit", breach.limit},
             {"time_s", to_seconds(breach.at)},
             {"line", breach.line},
             {"position", breach.position},
             {"times", breach.times}});
    json["axes"] = nlohmann::ordered_json::array();
    for (const AxisOutcome& axis : outcome.axes)
        json["axes"].push_back({{"axis", std::string(1, control::axis_letters[static_cast<std::size_t>(axis.index)])},
                                {"unit", axis.unit},
                                {"pulses_sent", axis.pulses_sent},
                                {"pulse_position", axis.pulse_position},
                                {"encoder_counts", axis.encoder_counts},
                                {"expected_counts", axis.expected_counts},
                                {"lost_pulses", axis.lost_pulses},
                                {"servo", axis.servo},
                                {"actual_end", axis.actual_end},
                                {"peak_velocity", axis.top.peak_velocity},
                                {"max_velocity", axis.limits.max_velocity},
                                {"peak_accel", axis.top.peak_accel},
                                {"max_accel", axis.limits.max_accel},
                                {"peak_velocity_step", axis.top.peak_velocity_step}});
    json["warnings"] = nlohmann::ordered_json::array();
    for (const JobWarning& warning : outcome.warnings)
        json["warnings"].push_back(
            {{"time_s", to_seconds(warning.at)}, {"line", warning.line}, {"text", warning.text}});
    return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace motionrack::rack
