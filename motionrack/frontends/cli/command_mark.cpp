// mark JOB: marks a drawing on a simulated moving part with the virtual RTC5; shows the result as a table and a
// picture.
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <motionrack/frontends/cli/commands.hpp>
#include <motionrack/frontends/cli/exit_codes.hpp>
#include <motionrack/frontends/cli/interrupt_signal.hpp>
#include <motionrack/frontends/cli/png.hpp>
#include <motionrack/frontends/cli/program_files.hpp>
#include <motionrack/frontends/cli/terminal.hpp>
#include <motionrack/mark/render.hpp>
#include <motionrack/trace/report.hpp>
#include <nlohmann/json.hpp>
#include <vector>

namespace motionrack::cli {

namespace {

struct MarkOptions {
    std::string job, report;
    std::vector<std::string> pictures = {"mark.svg"};
    bool json = false, quiet = false;
};

nlohmann::ordered_json mark_json(const mark::Marked& m) {
    nlohmann::ordered_json out = {{"max_deviation_mm", m.deviation.max_mm},
                                  {"rms_mm", m.deviation.rms_mm},
                                  {"max_deviation_at_mm", {m.deviation.max_at.x, m.deviation.max_at.y}},
                                  {"max_deviation_at_s", m.deviation.max_s},
                                  {"missing_mm", m.deviation.missing_mm},
                                  {"marked_mm", m.marked_mm},
                                  {"duration_s", m.seconds},
                                  {"duty", m.duty},
                                  {"energy_j", m.energy_j},
                                  {"overflows", nlohmann::ordered_json::array()}};
    for (const mark::Overflow& o : m.overflows)
        out["overflows"].push_back({{"name", o.name},
                                    {"meaning", o.meaning},
                                    {"from_s", o.from_s},
                                    {"to_s", o.to_s},
                                    {"field_mm", {o.field.x, o.field.y}},
                                    {"part_mm", {o.part.x, o.part.y}},
                                    {"beyond_mm", o.beyond_mm},
                                    {"marking", o.marking}});
    out["parts"] = nlohmann::ordered_json::array();
    for (const mark::PartMarked& p : m.parts)
        out["parts"].push_back({{"outcome", mark::name_of(p.fate)},
                                {"number", p.number},
                                {"from_s", p.begin_s},
                                {"to_s", p.end_s},
                                {"max_deviation_mm", p.deviation.max_mm},
                                {"rms_mm", p.deviation.rms_mm},
                                {"missing_mm", p.deviation.missing_mm},
                                {"marked_mm", p.marked_mm}});
    return out;
}

std::string json_text(const mark::MarkingOutcome& out) {
    nlohmann::ordered_json all = {{"drawing_mm", out.drawing_mm},
                                  {"strokes", out.strokes},
                                  {"elements", out.elements},
                                  {"marked", mark_json(out.on)}};
    if (out.off) all["without_correction"] = mark_json(*out.off);
    if (out.fits_factor) all["fits_times_the_velocity"] = *out.fits_factor;
    const mark::FieldMargin margin = mark::margin_of(out, out.on);
    all["field_margin"] = {{"mm", margin.mm}, {"edge", margin.edge}};
    all["warnings"] = mark::warnings_of(out);
    all["notes"] = out.notes;
    return all.dump(2);
}

/// Returns the problem with the picture's file name; empty if its extension is valid.
std::string picture_trouble(const std::string& path) {
    const auto ends_in = [&](std::string_view end) {
        return path.size() > end.size() && std::string_view(path).substr(path.size() - end.size()) == end;
    };
    return path.empty() || ends_in(".svg") || ends_in(".png")
               ? std::string()
               : fmt::format("the picture {} is neither .svg nor .png", path);
}

bool is_png(const std::string& path) {
    return path.size() > 4 && path.compare(path.size() - 4, 4, ".png") == 0;
}

/// Writes all requested files; returns the first error.
Result<void> write_files(const MarkOptions& options, const mark::MarkingJob& job, const mark::Prepared& prepared,
                         const mark::MarkingOutcome& outcome, std::string_view text) {
    const std::string svg = options.pictures.empty() ? std::string() : mark::picture_svg(prepared, outcome);
    for (const std::string& path : options.pictures) {
        if (!is_png(path)) {
            MOTIONRACK_CHECK(write_text(path, svg));
            continue;
        }
        MOTIONRACK_TRY(const std::string png, png_of(svg));
        MOTIONRACK_CHECK(write_text(path, png));
    }
    if (!options.report.empty())
        MOTIONRACK_CHECK(write_text(options.report, trace::report_html(mark::report_of(job, prepared, outcome, text))));
    return {};
}

int run_mark(const MarkOptions& options) {
    const Result<std::string> text = read_text(options.job, read_limits::toml);
    if (!text) return report(text.error());
    const mark::JobRead read = mark::read_job(*text, options.job);
    for (const Error& error : read.errors) print_error(error.text());
    if (!read.job) return exit_invalid_input;
    const std::size_t slash = options.job.rfind('/');
    const std::string folder = slash == std::string::npos ? "" : options.job.substr(0, slash + 1);
    std::vector<std::string> inputs = {options.job};
    const auto load = [&](const std::string& path) {
        inputs.push_back(!path.empty() && path[0] == '/' ? path : folder + path);
        return read_text(inputs.back(), read_limits::drawing);
    };
    const Result<mark::Prepared> prepared = mark::prepare(*read.job, load);
    if (!prepared) return report(prepared.error());
    std::vector<std::string> files = options.pictures;
    if (!options.report.empty()) files.push_back(options.report);
    if (!may_write(inputs, files)) return exit_refused;
    for (const std::string& file : files)
        if (const Result<void> good = check_writable(file); !good) return report(good.error());
    stop_on_signals();
    ProgressLine progress(options.quiet || options.json);
    const mark::RunObserver watch{[&](double part) { progress.show(part, "marking"); },
                                  [] { return stop_asked.load(); }};
    const Result<mark::MarkingOutcome> outcome = mark::run_job(*read.job, *prepared, watch);
    progress.clear();
    if (!outcome) return report(outcome.error());
    if (stop_asked) return report(Error{ErrorKind::stopped, "Stopped; nothing was written."});
    fmt::print("{}", options.json ? json_text(*outcome) + "\n" : mark::outcome_text(*read.job, *outcome));
    if (!options.json)
        for (const std::string& warning : mark::warnings_of(*outcome)) print_warning(warning);
    if (const Result<void> done = write_files(options, *read.job, *prepared, *outcome, *text); !done)
        return report(done.error());
    if (!options.json && !options.quiet && !files.empty()) fmt::print("written: {}\n", fmt::join(files, ", "));
    return outcome->on.good() && outcome->in_field() ? exit_done : exit_machine;
}

}  // namespace

void add_mark(CLI::App& app, Action& chosen) {
    auto options = std::make_shared<MarkOptions>();
    CLI::App* command = app.add_subcommand(
        "mark", "Mark a drawing on a moving part with the virtual RTC5 and report the marks and their deviation");
    command
        ->add_option("JOB", options->job,
                     "job file (TOML), '-': standard input; its files are searched for in its folder")
        ->required();
    command
        ->add_option("--picture", options->pictures,
                     "NAME.svg or NAME.png: the part as drawn, with and without correction; repeatable; '': none")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->check(CLI::Validator(picture_trouble, "FILE"))
        ->capture_default_str();
    command->add_option("--report", options->report, "page with the pictures, tables, charts and the job (HTML)");
    command->add_flag("--json", options->json, "print the table as JSON");
    command->add_flag("-q,--quiet", options->quiet, "no progress");
    command->footer(
        "Example: motionrack mark square.toml --picture square.png --report square.html\n"
        "Nothing is written if the job is refused or stopped.\n"
        "Exit code 4: the drawing or the correction left the field, or the start of a part was lost: marks are missing "
        "or displaced.");
    command->callback([options, &chosen] {
        std::erase(options->pictures, std::string());
        chosen = [options] { return run_mark(*options); };
    });
}

}  // namespace motionrack::cli
