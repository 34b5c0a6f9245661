// Makes the report page of a marking job.
#include <fmt/format.h>

#include <motionrack/mark/plot.hpp>
#include <motionrack/mark/render.hpp>

namespace motionrack::mark {

namespace {

std::string verdict_text(const MarkingOutcome& out) {
    if (!out.on.overflows.empty())
        return fmt::format(
            "The correction left the field {} times, first at {:.5f} s ({}); the mirrors stayed at its edge during "
            "that time.",
            out.on.overflows.size() + out.on.lost_overflows, out.on.overflows.front().from_s,
            out.on.overflows.front().name);
    if (out.on.parts_lost() > 0)
        return fmt::format("{} of {} parts were not marked, because their starts were lost.", out.on.parts_lost(),
                           out.on.parts.size());
    std::string text = fmt::format("Marked within {} of the drawing", shown_length(out.on.deviation.max_mm));
    if (out.on.deviation.missing_mm > 0)
        text += fmt::format("; {} of it were not marked", shown_length(out.on.deviation.missing_mm));
    return text + ".";
}

std::vector<std::string> row_of(const char* name, const Marked& m) {
    const parts::Deviation& d = m.deviation;
    return {name,
            fmt::format("{:.4f} mm at {:.3f}, {:.3f} mm", d.max_mm, d.max_at.x, d.max_at.y),
            fmt::format("{:.4f} mm", d.rms_mm),
            fmt::format("{:.3f} mm", d.missing_mm),
            fmt::format("{:.3f} mm", m.marked_mm),
            fmt::format("{:.4f} s", m.seconds),
            fmt::format("{:.1f} %", m.duty * 100),
            fmt::format("{:.3f} J", m.energy_j)};
}

trace::ReportTable deviations(const MarkingOutcome& out) {
    trace::ReportTable t{"Deviations",
                         "Marks on the part against the drawing",
                         {"", "Max deviation", "RMS", "Not marked", "Marked", "Time", "Laser on", "Energy"},
                         {}};
    t.rows.push_back(row_of(out.off ? "With correction" : "Without correction", out.on));
    if (out.off) t.rows.push_back(row_of("Without correction", *out.off));
    return t;
}

trace::ReportTable overflows(const Marked& m) {
    trace::ReportTable t{"Overflows",
                         "Intervals in which the corrected position was outside the field",
                         {"Flag", "Meaning", "From", "To", "At most beyond", "On the drawing", "Laser"},
                         {}};
    for (const Overflow& o : m.overflows)
        t.rows.push_back({o.name, o.meaning, fmt::format("{:.5f} s", o.from_s), fmt::format("{:.5f} s", o.to_s),
                          fmt::format("{:.3f} mm", o.beyond_mm), fmt::format("{:.3f}, {:.3f} mm", o.part.x, o.part.y),
                          o.marking ? "on" : "off"});
    return t;
}

trace::ReportTable parts_table(const Marked& m) {
    trace::ReportTable t{"Parts",
                         "Result of each part, in their order",
                         {"Part", "Number", "Outcome", "From", "To", "Max deviation", "RMS", "Not marked"},
                         {}};
    for (std::size_t i = 0; i < m.parts.size(); ++i) {
        const PartMarked& p = m.parts[i];
        t.rows.push_back({fmt::format("{}", i + 1), p.fate == PartOutcome::marked ? fmt::format("{}", p.number) : "",
                          name_of(p.fate), fmt::format("{:.5f} s", p.begin_s), fmt::format("{:.5f} s", p.end_s),
                          fmt::format("{:.4f} mm", p.deviation.max_mm), fmt::format("{:.4f} mm", p.deviation.rms_mm),
                          fmt::format("{:.3f} mm", p.deviation.missing_mm)});
    }
    return t;
}

void add_numbers(const MarkingJob& job, const MarkingOutcome& out, trace::ReportData& data) {
    const auto add = [&](const char* label, std::string value, const char* unit) {
        data.numbers.push_back({label, std::move(value), unit});
    };
    add("Max deviation", fmt::format("{:.4f}", out.on.deviation.max_mm), "mm");
    if (out.off) add("The marks without correction", fmt::format("{:.4f}", out.off->deviation.max_mm), "mm");
    add("RMS deviation", fmt::format("{:.4f}", out.on.deviation.rms_mm), "mm");
    add("Time", fmt::format("{:.4f}", out.on.seconds), "s");
    add("Laser on", fmt::format("{:.1f}", out.on.duty * 100), "%");
    add("Energy", fmt::format("{:.3f}", out.on.energy_j), "J");
    add("Minimum margin in the field", fmt::format("{:.2f}", margin_of(out, out.on).mm), "mm");
    if (!out.fits_factor) return;
    if (job.belt.profile.empty() && !out.fits_any)
        add("It just fits at", fmt::format("{:.5g}", *out.fits_factor * job.belt.velocity),
            job.belt.rotary ? "degrees/s" : "mm/s");
    else
        add("It fits up to", fmt::format("{:.4g}", *out.fits_factor), "times the velocity");
}

void add_series(const MarkingOutcome& out, trace::ReportData& data) {
    trace::ReportSeries x{"X of the spot in the field, mm", "x", {}, "field", {out.field.low.x, out.field.high.x}};
    trace::ReportSeries y{"Y of the spot in the field, mm", "z", {}, "field", {out.field.low.y, out.field.high.y}};
    trace::ReportSeries gate{"Laser on, %", "b", {}, "", {}};
    for (const FieldSample& s : out.on.course) {
        data.seconds.push_back(s.at_s);
        x.values.push_back(static_cast<float>(s.at.x));
        y.values.push_back(static_cast<float>(s.at.y));
        gate.values.push_back(static_cast<float>(s.gate * 100));
    }
    data.series = {std::move(x), std::move(y), std::move(gate)};
}

}  // namespace

trace::ReportData report_of(const MarkingJob& job, const Prepared& prepared, const MarkingOutcome& out,
                            std::string_view text) {
    trace::ReportData data;
    data.title = "Marking job";
    data.program_kind = "Job";
    data.program_name = job.file;
    data.verdict = {out.on.good(), verdict_text(out)};
    add_numbers(job, out, data);
    data.pictures = pictures_of(prepared, out);
    data.pictures_hint =
        "Wide and pale: the drawing; thin: the marks; ring: the maximum deviation; cross: an overflow of the "
        "field.";
    data.tables.push_back(deviations(out));
    if (job.parts) data.tables.push_back(parts_table(out.on));
    if (!out.on.overflows.empty()) data.tables.push_back(overflows(out.on));
    trace::ReportTable known{"Warnings and notes", "Notes on this job", {""}, {}};
    for (const std::string& warning : warnings_of(out)) known.rows.push_back({"Warning: " + warning});
    if (out.on.lost_overflows > 0)
        known.rows.push_back({fmt::format("{} more overflows were not kept.", out.on.lost_overflows)});
    if (out.on.lost_points > 0)
        known.rows.push_back({fmt::format("{} marked points exceed the limit of the pictures.", out.on.lost_points)});
    for (const std::string& note : out.notes) known.rows.push_back({note});
    if (!known.rows.empty()) data.tables.push_back(std::move(known));
    add_series(out, data);
    data.source = trace::ReportSource{"The job file", std::string(text)};
    return data;
}

}  // namespace motionrack::mark
