// Result of a marking job as a table.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <motionrack/mark/render.hpp>
#include <motionrack/rack/count_noun.hpp>

namespace motionrack::mark {

namespace {

using Out = std::back_insert_iterator<std::string>;

void row(Out to, const char* name, const Marked& m) {
    fmt::format_to(to, "{:<20} {:>10.4f} {:>10.4f} {:>18} {:>10.3f} {:>10.3f} {:>9.4f} {:>6.1f} {:>9.3f}\n", name,
                   m.deviation.max_mm, m.deviation.rms_mm,
                   fmt::format("{:.3f}, {:.3f}", m.deviation.max_at.x, m.deviation.max_at.y), m.deviation.missing_mm,
                   m.marked_mm, m.seconds, m.duty * 100, m.energy_j);
}

void overflows(Out to, const Marked& m) {
    constexpr std::size_t shown = 20;
    for (std::size_t i = 0; i < std::min(m.overflows.size(), shown); ++i) {
        const Overflow& o = m.overflows[i];
        fmt::format_to(to,
                       "{} at {:.5f} to {:.5f} s: {}, by {:.3f} mm, at {:.3f}, {:.3f} mm of the drawing{}; the mirrors "
                       "stayed at the edge\n",
                       o.name, o.from_s, o.to_s, o.meaning, o.beyond_mm, o.part.x, o.part.y,
                       o.marking ? "" : ", with the laser off");
    }
    if (m.overflows.size() > shown)
        fmt::format_to(to, "{} more overflows are in --json and in the report.\n", m.overflows.size() - shown);
    if (m.lost_overflows > 0) fmt::format_to(to, "{} more overflows were not kept.\n", m.lost_overflows);
}

void fit(Out to, const MarkingJob& job, const MarkingOutcome& out) {
    if (!out.fits_factor) return;
    const char* what = out.starts_limit ? "the time between two parts" : "the field";
    const char* unit = job.belt.rotary ? "degrees/s" : "mm/s";
    if (*out.fits_factor == 0 && out.starts_limit) {
        fmt::format_to(to, "Starts are lost at any velocity of the parts. Increase their spacing.\n");
    } else if (*out.fits_factor == 0) {
        fmt::format_to(to, "The drawing does not fit the field even while the part is at rest. Make it smaller.\n");
    } else if (out.fits_any) {
        fmt::format_to(to, "It fits the field at any velocity up to {:g} times this one.\n", *out.fits_factor);
    } else if (job.belt.profile.empty()) {
        fmt::format_to(to, "It just fits {} at {:.5g} {}; this job has {:g} {}.\n", what,
                       *out.fits_factor * job.belt.velocity, unit, job.belt.velocity, unit);
    } else {
        fmt::format_to(to, "It just fits {} at {:.4g} times the velocities of the profile.\n", what, *out.fits_factor);
    }
}

}  // namespace

FieldMargin margin_of(const MarkingOutcome& out, const Marked& marked) {
    const Box &field = out.field, &reach = marked.reach;
    return std::min(
        {FieldMargin{reach.low.x - field.low.x, "left"}, FieldMargin{field.high.x - reach.high.x, "right"},
         FieldMargin{reach.low.y - field.low.y, "lower"}, FieldMargin{field.high.y - reach.high.y, "upper"}},
        [](const FieldMargin& a, const FieldMargin& b) { return a.mm < b.mm; });
}

std::vector<std::string> warnings_of(const MarkingOutcome& out) {
    std::vector<std::string> warnings;
    const FieldMargin margin = margin_of(out, out.on);
    const double wanted = min_margin_share * (out.field.high.x - out.field.low.x);
    if (!out.waits && margin.mm >= 0 && margin.mm < wanted)
        warnings.push_back(
            fmt::format("only {:.3f} mm are left at the {} edge of the field, less than {:.3g} mm ({:g} % of its "
                        "width): a slightly higher velocity or a slightly later start overflows the correction",
                        margin.mm, margin.edge, wanted, min_margin_share * 100));
    if (!out.in_field())
        warnings.push_back(
            "a part of the drawing is outside the field, and was marked on its edge; move the drawing or make it "
            "smaller");
    return warnings;
}

std::string outcome_text(const MarkingJob& job, const MarkingOutcome& out) {
    std::string text;
    const Out to(text);
    fmt::format_to(to, "drawing: {}, {}, {:.3f} mm\n", rack::count_noun(out.strokes, "stroke"),
                   rack::count_noun(out.elements, "line or arc", "lines and arcs"), out.drawing_mm);
    for (const std::string& note : out.notes) fmt::format_to(to, "note: {}\n", note);
    fmt::format_to(to, "{:<20} {:>10} {:>10} {:>18} {:>10} {:>10} {:>9} {:>6} {:>9}\n", "", "max mm", "rms mm",
                   "at x, y mm", "missing mm", "marked mm", "time s", "duty %", "energy J");
    row(to, out.off ? "with correction" : "without correction", out.on);
    if (out.off) row(to, "without correction", *out.off);
    text += parts_text(job, out.on);
    overflows(to, out.on);
    const FieldMargin margin = margin_of(out, out.on);
    if (margin.mm >= 0) fmt::format_to(to, "margin: {:.3f} mm to the {} edge of the field\n", margin.mm, margin.edge);
    if (!out.drawing_in_field)
        fmt::format_to(to, "A part of the drawing is outside the field at the start position of the part.\n");
    if (out.on.lost_points > 0)
        fmt::format_to(to, "{} marked points exceed the limit of the picture.\n", out.on.lost_points);
    fit(to, job, out);
    return text;
}

}  // namespace motionrack::mark
