// Part programs and homing of a session: read and checked first, then executed as by the command line.
#include <fmt/format.h>

#include <cctype>
#include <filesystem>
#include <motionrack/base/read_whole_file.hpp>
#include <motionrack/control/gcode/program_reader.hpp>
#include <motionrack/rack/count_noun.hpp>
#include <motionrack/rack/job_report.hpp>
#include <motionrack/rack/problems_text.hpp>
#include <motionrack/rack/raised_flag.hpp>
#include <motionrack/rack/session.hpp>
#include <motionrack/rack/subprogram_files.hpp>

namespace motionrack::rack {

namespace {

constexpr std::size_t max_problems = 20;
constexpr std::size_t max_warnings = 12;
constexpr Duration homing_slice = milliseconds(50);
/// Longer than any day-long program and any homing of all axes.
constexpr Duration max_drive_time = whole_seconds(86'400);

/// Lists the problems, one per line, and their number.
std::string problems_text(const control::gcode::ProgramCheck& check, const std::string& name) {
    std::string out;
    for (const control::gcode::Problem& problem : check.problems) out += problem.text() + '\n';
    return out + problems_verdict(check, name);
}

/// Describes the result of the program, with one message per line.
std::string drive_text(const std::string& verdict, const JobOutcome& outcome) {
    std::string out = verdict;
    for (std::size_t i = 0; i < outcome.warnings.size() && i < max_warnings; ++i)
        out += '\n' + outcome.warnings[i].text;
    if (outcome.warnings.size() > max_warnings)
        out += fmt::format("\n{} more were left out.", count_noun(outcome.warnings.size() - max_warnings, "warning"));
    return out;
}

}  // namespace

std::unique_ptr<Job> Session::make_job(Programs programs) {
    if (programs == Programs::no || rack_.axes().empty()) return nullptr;
    JobSettings settings;
    settings.stop = &stop_;
    settings.on_slice = [this] { between(); };
    settings.progress = [this](const JobProgress& progress) {
        if (progress_ && !progress_(progress)) stop_ = true;
    };
    return std::make_unique<Job>(rack_, std::move(settings));
}

Result<control::gcode::Settings> Session::read_program(const ProgramRequest& request, std::string& name) {
    control::gcode::Settings reading = reader_settings(rack_.config(), request.block_delete);
    if (request.path_or_text.find('\n') != std::string_view::npos) {
        name = "program";
        program_ = request.path_or_text;
    } else {
        name = request.path_or_text;
        MOTIONRACK_TRY(program_, read_whole_file(name, read_limits::program));
        reading.subprogram = subprograms_in(std::filesystem::path(name).parent_path());
    }
    if (!request.tools.empty()) {
        MOTIONRACK_TRY(const std::string tools, read_whole_file(request.tools, read_limits::table));
        MOTIONRACK_TRY(reading.tools, control::gcode::read_tool_table(tools, request.tools));
    }
    MOTIONRACK_CHECK(control::gcode::check_settings(reading));
    return reading;
}

Result<void> Session::drive_program(const ProgramRequest& request, ProgramReport& report) {
    MOTIONRACK_CHECK(check_free());
    if (!job_)
        return fail(ErrorKind::refused,
                    "The rack has no axes, so no program can run on it. Nothing was moved; give it "
                    "some in its rack file.");
    MOTIONRACK_CHECK(check_time_left(max_drive_time));
    MOTIONRACK_TRY(const control::Point start, job_->start());
    std::string name;
    MOTIONRACK_TRY(control::gcode::Settings reading, read_program(request, name));
    reading.start = start;
    const control::gcode::ProgramCheck check = control::gcode::check_program(program_, reading, max_problems, name);
    if (!check.problems.empty()) {
        report.location = check.problems.front().location;
        return fail(has_unreadable(check) ? ErrorKind::io : ErrorKind::invalid_input, problems_text(check, name));
    }
    const RaisedFlag driving(driving_);
    stop_ = false;
    progress_ = request.progress;
    job_->give(program_, name, std::move(reading));
    report.outcome = job_->run();
    progress_ = {};
    rack_.set_stop_flag(nullptr);
    between();
    if (report.outcome.axes.empty()) return report.outcome.ended;  // its axes were not available
    report.summary = summary_of(rack_.config(), report.outcome);
    const JobOutcome& outcome = report.outcome;
    if (!outcome.ended) {
        Error why = outcome.ended.error();
        report.location = why.location;
        why.file = name;
        return tl::unexpected<Error>(std::move(why));
    }
    report.sentence = drive_text(report.summary.substr(0, report.summary.find('\n')), outcome);
    if (!outcome.good()) return fail(ErrorKind::machine, report.sentence);
    return {};
}

ProgramReport Session::run_program(const ProgramRequest& request) {
    ProgramReport report;
    report.ended = drive_program(request, report);
    if (!report.ended) report.sentence = report.ended.error().text();
    return report;
}

HomingOutcome Session::home(std::string_view axes) {
    HomingOutcome out;
    out.ended = check_free();
    if (out.ended) out.ended = check_time_left(max_drive_time);
    if (!out.ended) return out;
    HomingSettings settings;
    for (const char c : axes)
        if (c != ',' && c != ' ') settings.axes += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    const RaisedFlag driving(driving_);
    rack_.on_slice(homing_slice, [this] { between(); });
    out = job_ ? job_->home(settings) : home_axes(rack_, settings);
    rack_.on_slice(homing_slice, {});
    between();
    return out;
}

}  // namespace motionrack::rack
