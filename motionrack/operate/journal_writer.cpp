#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <motionrack/operate/journal_writer.hpp>
#include <nlohmann/json.hpp>
#include <utility>

namespace motionrack::operate {

namespace {

using nlohmann::json;

constexpr const char* kept_key = "machine";
constexpr Duration keep_every = milliseconds(100);
constexpr double min_shift = 0.02;  ///< mm or degrees; a servo in position hold oscillates by a count
constexpr Duration again_within = whole_seconds(1);
constexpr Duration repeat_every = whole_seconds(10);
constexpr std::int64_t max_repeats = 20;
constexpr std::size_t max_sources = 20;  ///< maximum number of entries about one stop in force

std::string places(const std::vector<AxisStatus>& axes) {
    std::string out;
    for (const AxisStatus& axis : axes)
        out += fmt::format("{}{} {:.4f} {}{}", out.empty() ? "" : ", ", axis.letter, axis.commanded,
                           axis.rotary ? "deg" : "mm", axis.position_valid ? "" : " (not valid)");
    return out;
}

json axes_json(const std::vector<AxisStatus>& axes) {
    json out = json::array();
    for (const AxisStatus& axis : axes)
        out.push_back({{"letter", std::string(1, axis.letter)},
                       {"true_position", axis.true_position},
                       {"commanded", axis.commanded},
                       {"position_valid", axis.position_valid}});
    return out;
}

/// Ends `text` with a full stop, unless it has one. Requires a text that is not empty.
std::string sentence(std::string text) {
    if (text.back() != '.') text += '.';
    return text;
}

}  // namespace

void JournalWriter::see(const Status& status) {
    if (std::exchange(first_, false)) {
        state_ = status.state;
        feed_ = status.feed_override;
        rapid_ = status.rapid_override;
        for (const AxisStatus& axis : status.axes) positions_valid_.push_back(axis.position_valid);
        keep(status);
    }
    if (status.state != MachineState::stopping) stopped_by_.clear();
    see_alarms(status);
    see_job(status);
    see_settings(status);
    see_positions(status);
    see_state(status);
    const bool is_due = status.ended || status.at - kept_ >= keep_every;
    if (is_due && (!is_stationary(status.state) || has_shifted(status))) keep(status);
}

void JournalWriter::stopped(const StopReport& report) {
    const std::optional<StopReport> before = std::exchange(stopped_, report);
    if (report.releases) return;  // written as an ordinary command
    const bool again = before && !before->releases && before->source == report.source;
    if (again && report.at - before->at < again_within) return;
    if (idle(report.state) && !may_repeat(report.at)) return;
    if (!is_first_of_its_source(report)) return;
    write(report.at, "stop", report.text,
          json{{"who", report.source.who},
               {"address", report.source.address},
               {"kind", report.source.kind},
               {"state", name_of(report.state)}}
              .dump());
}

/// Counts no time: with a paused clock a machine is stopping as long as clients send stops.
bool JournalWriter::is_first_of_its_source(const StopReport& report) {
    if (report.state != MachineState::stopping) stopped_by_.clear();
    if (stopped_by_.size() >= max_sources) return false;
    if (std::find(stopped_by_.begin(), stopped_by_.end(), report.source) != stopped_by_.end()) return false;
    stopped_by_.push_back(report.source);
    return true;
}

bool JournalWriter::may_repeat(Instant at) {
    if (repeats_ > 0 && at - repeated_ >= repeat_every) {
        repeats_ -= std::min<std::int64_t>(repeats_, (at - repeated_) / repeat_every);
        repeated_ = at;
    }
    if (repeats_ == 0) repeated_ = at;
    if (repeats_ >= max_repeats) return false;
    ++repeats_;
    return true;
}

void JournalWriter::write(Instant at, const std::string& kind, const std::string& text, const std::string& data) {
    if (journal_ != nullptr) journal_->write(at, kind, text, data);
    if (reported_) reported_(at, kind, text, data);
}

void JournalWriter::see_state(const Status& status) {
    const MachineState before = std::exchange(state_, status.state);
    if (before == state_) return;
    write(status.at, "state",
          sentence(fmt::format("{}{}{}", name_of(state_), status.reason.empty() ? "" : ": ", status.reason)),
          json{{"state", name_of(state_)}, {"before", name_of(before)}}.dump());
    if (is_stationary(state_) && !is_stationary(before))
        write(status.at, "position", fmt::format("Stands at {}.", places(status.axes)),
              json{{"axes", axes_json(status.axes)}}.dump());
    keep(status);
}

void JournalWriter::see_job(const Status& status) {
    const bool ran = std::exchange(program_runs_, status.program_runs);
    if (ran == program_runs_) return;
    const char* event = "began";
    std::string text = fmt::format("{} began: {} lines.", status.program, status.lines);
    if (!program_runs_ && status.state == MachineState::error_stop) {
        event = "broken off";
        text = sentence(
            fmt::format("{} failed at line {} of {}: {}", status.program, status.line, status.lines, status.reason));
    } else if (!program_runs_ && status.state == MachineState::stopping) {
        event = "stopped";
        text = fmt::format("{} was stopped at line {} of {}.", status.program, status.line, status.lines);
    } else if (!program_runs_) {
        event = "ended";
        text = fmt::format("{} ended.", status.program);
    }
    write(status.at, "job", text,
          json{{"name", status.program}, {"event", event}, {"line", status.line}, {"lines", status.lines}}.dump());
    keep(status);
}

void JournalWriter::see_alarms(const Status& status) {
    const auto record = [&](const Alarm& alarm, const char* event, const std::string& text) {
        write(status.at, "alarm", text, json{{"number", alarm.number}, {"event", event}}.dump());
    };
    for (const Alarm& alarm : status.alarms) {
        if (alarm.number > last_alarm_) {
            last_alarm_ = alarm.number;
            active_.insert(alarm.number);
            open_.insert(alarm.number);
            record(alarm, "raised", alarm.text);
        }
        if (!alarm.active && active_.erase(alarm.number) == 1)
            record(alarm, "returned", fmt::format("Over: {}", alarm.text));
        if (alarm.acknowledged && open_.erase(alarm.number) == 1)
            record(alarm, "acknowledged", fmt::format("Acknowledged: {}", alarm.text));
    }
}

void JournalWriter::see_settings(const Status& status) {
    const auto percent = [&](const char* what, double& before, double value) {
        if (std::exchange(before, value) == value) return;
        write(status.at, "setting", fmt::format("{} override {:g} %.", what, value * 100),
              json{{"name", what}, {"value", value}}.dump());
    };
    percent("Feed", feed_, status.feed_override);
    percent("Rapid", rapid_, status.rapid_override);
    if (std::exchange(single_block_, status.single_block) != status.single_block)
        write(status.at, "setting", fmt::format("Single block {}.", single_block_ ? "on" : "off"),
              json{{"name", "single block"}, {"value", single_block_}}.dump());
}

void JournalWriter::see_positions(const Status& status) {
    const std::size_t count = std::min(status.axes.size(), positions_valid_.size());
    for (std::size_t i = 0; i < count; ++i) {
        const AxisStatus& axis = status.axes[i];
        if (axis.position_valid == positions_valid_[i]) continue;
        positions_valid_[i] = axis.position_valid;
        write(status.at, "position",
              fmt::format("Axis {}: its position, {:.4f} {}, is {}.", axis.letter, axis.commanded,
                          axis.rotary ? "deg" : "mm", axis.position_valid ? "valid" : "not valid any more"),
              json{{"axes", axes_json({axis})}}.dump());
        keep(status);
    }
}

/// Returns true if an axis has moved at standstill, as a servo does that is pushed or settles late.
bool JournalWriter::has_shifted(const Status& status) const {
    const std::size_t count = std::min(status.axes.size(), kept_axes_.size());
    for (std::size_t i = 0; i < count; ++i)
        if (std::fabs(status.axes[i].commanded - kept_axes_[i]) > min_shift) return true;
    return false;
}

void JournalWriter::keep(const Status& status) {
    kept_ = status.at;
    kept_axes_.clear();
    for (const AxisStatus& axis : status.axes) kept_axes_.push_back(axis.commanded);
    if (journal_ == nullptr) return;
    journal_->keep(kept_key, json{{"state", name_of(status.state)},
                                  {"program", status.program_runs ? status.program : ""},
                                  {"line", status.line},
                                  {"axes", axes_json(status.axes)}}
                                 .dump());
}

namespace {

/// Returns the stored machine state of the last run; empty if nothing readable was stored.
json kept_of(const journal::LastRun& last) {
    const auto found = last.kept.find(kept_key);
    json kept = json::parse(found == last.kept.end() ? "{}" : found->second, nullptr, false);
    return kept.is_object() ? kept : json::object();
}

/// Describes the end of an interrupted run: "; the machine's state was 'moving', 'part.ngc' ran and was at line 12,
/// near X 3.000".
std::string at_the_end(const json& kept, const std::string& where) {
    const auto text = [&](const char* key) {
        return kept.contains(key) && kept[key].is_string() ? kept[key].get<std::string>() : std::string();
    };
    const std::string program = text("program"), state = text("state");
    const double line = kept.contains("line") && kept["line"].is_number() ? kept["line"].get<double>() : 0;
    return fmt::format("{}{}{}", state.empty() ? "" : fmt::format("; the machine's state was '{}'", state),
                       program.empty() ? "" : fmt::format(", '{}' ran and was at line {}", program, line),
                       where.empty() ? "" : fmt::format(", near {}", where));
}

std::vector<InitialAxisState> standings_of(const json& kept, const rack::RackConfig& config, bool intact) {
    std::vector<InitialAxisState> out;
    if (!kept.contains("axes") || !kept["axes"].is_array()) return out;
    for (const json& one : kept["axes"]) {
        if (!one.is_object() || one.value("letter", json()).type() != json::value_t::string) continue;
        const std::string letter = one["letter"];
        const rack::RackAxis* axis = letter.size() == 1 ? config.axis(letter[0]) : nullptr;
        // Journals of former versions name them place and trusted.
        const json place = one.value("true_position", one.value("place", json())),
                   valid = one.value("position_valid", one.value("trusted", json())),
                   commanded = one.value("commanded", json());
        if (axis == nullptr || !place.is_number() || !commanded.is_number()) continue;
        out.push_back({letter[0], place, commanded, intact && valid == true});
    }
    return out;
}

}  // namespace

LastKnownPositions read_last(const journal::LastRun& last, const rack::RackConfig& config) {
    LastKnownPositions out;
    const json kept = kept_of(last);
    std::vector<std::string> doubts = last.doubts;
    if (last.clean && doubts.empty() && kept.empty() && !config.axes.empty())
        doubts.push_back("it has no axis positions");
    const bool intact = last.clean && doubts.empty();
    out.axes = standings_of(kept, config, intact);
    std::string where;
    for (const InitialAxisState& one : out.axes)
        where += fmt::format("{}{} {:.3f}", where.empty() ? "" : ", ", one.letter, one.commanded);
    // An axis without a record may also have moved.
    for (const rack::RackAxis& axis : config.axes)
        if (!intact && std::none_of(out.axes.begin(), out.axes.end(),
                                    [&](const InitialAxisState& one) { return one.letter == axis.letter; }))
            out.axes.push_back({axis.letter, axis.initial_position, axis.initial_position, false});
    const auto add_note = [&](const std::string& sentence) {
        out.sentence += fmt::format("{}{}", out.sentence.empty() ? "" : " ", sentence);
    };
    if (!last.clean)
        add_note(fmt::format("The previous run was interrupted ({:%Y-%m-%d %H:%M:%S} UTC at the latest){}.",
                             fmt::gmtime(static_cast<std::time_t>(last.last_ms / 1000)), at_the_end(kept, where)));
    for (const std::string& doubt : doubts) add_note(fmt::format("The journal is invalid: {}.", doubt));
    if (!intact && !config.axes.empty()) add_note("No position is valid: home the machine, or set its position.");
    if (!last.damage.empty()) add_note(last.damage);
    return out;
}

}  // namespace motionrack::operate
