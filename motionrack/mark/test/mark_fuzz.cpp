// Reads any bytes as drawings and jobs, and checks the invariants.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/mark/gcode_drawing.hpp>
#include <motionrack/mark/render.hpp>
#include <motionrack/mark/stroke_font.hpp>
#include <motionrack/mark/svg.hpp>
#include <motionrack/mark/test/mark_fuzz.hpp>

namespace motionrack::mark::fuzz {

namespace {

// Longer drawings are not run, because sanitizers make a run a hundred times slower.
constexpr double max_run_s = 0.02;  // s of marking

bool finite(Spot p) {
    return std::isfinite(p.x) && std::isfinite(p.y);
}

std::string drawing_problem(const Drawing& drawing) {
    for (const Stroke& stroke : drawing.strokes) {
        if (!finite(stroke.from)) return "a stroke begins nowhere";
        for (const Element& e : stroke.elements)
            if (!finite(e.to) || !finite(e.centre) || !std::isfinite(e.sweep)) return "a line ends nowhere";
    }
    if (element_count(drawing) > max_elements + 10) return "more elements than may be";
    return "";
}

std::string error_problem(const Error& error, std::string_view text) {
    if (error.message.empty()) return "an error without words";
    // G-code also accepts a single carriage return as a line end.
    const auto lines = std::count_if(text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }) + 1;
    if (error.location.line < 0 || error.location.line > lines || error.location.column < 0)
        return fmt::format("the place {}:{} is not in a text of {} lines: {}", error.location.line,
                           error.location.column, lines, error.message);
    return "";
}

std::string picture_problem(const std::string& text) {
    for (const char* wrong : {"nan", "-inf", "\"inf"})
        if (text.find(wrong) != std::string::npos) return fmt::format("a picture has '{}'", wrong);
    return "";
}

/// Runs the job, whose observer stops it at its first poll, and renders its result. Returns the violated invariant, or
/// "".
std::string run_problem(const MarkingJob& job, const Prepared& prepared, std::string_view text) {
    if (length_of(prepared.drawing) > max_run_s * job.pace.mark_speed_mm_s) return "";
    const Result<MarkingOutcome> out = run_job(job, prepared, {{}, [] { return true; }});
    if (!out) return error_problem(out.error(), text);
    for (const Marked* m : {&out->on, out->off ? &*out->off : nullptr}) {
        if (m == nullptr) continue;
        if (!std::isfinite(m->deviation.max_mm) || !std::isfinite(m->deviation.rms_mm) ||
            !(m->duty >= 0 && m->duty <= 1.0001) || !(m->energy_j >= 0))
            return "the table has a number that is none";
    }
    if (outcome_text(job, *out).empty() || warnings_of(*out).size() > 10) return "no table";
    if (const std::string wrong = picture_problem(picture_svg(prepared, *out)); !wrong.empty()) return wrong;
    return trace::report_html(report_of(job, prepared, *out, text)).empty() ? "no page" : "";
}

}  // namespace

std::string check_drawing(std::string_view bytes) {
    if (bytes.empty()) return "";
    const std::string_view text = bytes.substr(1);
    const char kind = bytes[0];
    const Result<Drawing> read = kind == 'g'   ? read_gcode(text, "f")
                                 : kind == 't' ? text_drawing(text, 5)
                                               : read_svg(text, "f");
    return read ? drawing_problem(*read) : error_problem(read.error(), text);
}

std::string check_job(std::string_view text) {
    JobRead read = read_job(text, "f");
    if (read.job.has_value() != read.errors.empty()) return "a job and errors, or neither";
    for (const Error& error : read.errors)
        if (const std::string wrong = error_problem(error, text); !wrong.empty()) return wrong;
    if (!read.job) return "";
    read.job->optics.correction = false;  // generating the table of a lens is slow and always the same
    const Load load = [](const std::string& path) -> Result<std::string> {
        if (path.find("ngc") != std::string::npos) return "G21 G90 G0 X1 Y1\nG1 X5 F100\nG3 X5 Y6 I0 J2.5\nM2\n";
        if (path.find("svg") != std::string::npos)
            return "<svg width='10mm' viewBox='0 0 10 10'><path d='M0 0H10V10'/><circle cx='5' cy='5' r='3'/></svg>";
        return fail(ErrorKind::io, "no such file");
    };
    const Result<Prepared> prepared = prepare(*read.job, load);
    if (!prepared) return prepared.error().message.empty() ? "an error without words" : "";
    if (const std::string wrong = drawing_problem(prepared->drawing); !wrong.empty()) return wrong;
    return run_problem(*read.job, *prepared, text);
}

}  // namespace motionrack::mark::fuzz
