// Header, tables and lists of the report page.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/trace/report_parts.hpp>
#include <motionrack/trace/text.hpp>
#include <sstream>

namespace motionrack::trace {

namespace {

std::string cell(const std::string& html, const char* kind = "n") {
    return fmt::format("<td class=\"{}\">{}</td>", kind, html);
}

/// Truncates at a character boundary.
std::string cut_text(const std::string& text, std::size_t max_bytes) {
    if (text.size() <= max_bytes) return text;
    std::size_t end = max_bytes;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
    return text.substr(0, end) + "...";
}

/// Shows a value, its limit and a bar of the ratio; marks an exceeded limit in red and with a word.
std::string against(double value, double limit, const std::string& unit) {
    std::string out = number(value) + " <small>" + unit + "</small>";
    if (!(limit > 0) || !std::isfinite(limit) || !std::isfinite(value)) return out;
    const double percent = std::abs(value) / limit * 100;
    const bool over = percent > 100.05;
    out += fmt::format("<div class=\"bar{}\"><i style=\"width:{}%\"></i></div><small>{}&nbsp;% of {}{}</small>",
                       over ? " over" : "", number(std::min(percent, 100.0), 1), number(percent, percent < 10 ? 1 : 0),
                       number(limit), over ? " &mdash; <b>above the limit</b>" : "");
    return out;
}

std::string pair(long long first, long long second) {
    std::string out = grouped(first) + "<br><small>of " + grouped(second) + "</small>";
    return first == second ? out : "<b class=\"bad\">" + out + "</b>";
}

std::string axis_row(const ReportAxis& axis) {
    const std::string unit = shown(axis.unit, 20);
    const bool same = axis.pulses_net == axis.pulse_counter;
    const std::string lost =
        axis.lost_steps == 0 ? "none" : "<b class=\"bad\">" + grouped(axis.lost_steps) + " lost</b>";
    std::string out = "<tr><th scope=\"row\">" + shown(axis.name, 40) + "</th>";
    if (axis.servo)
        out += cell("servo<br><small>no pulses</small>");
    else
        out +=
            cell(grouped(axis.pulses_sent) + (same ? "<br><small>card counts the same</small>"
                                                   : "<br><b class=\"bad\">net " + grouped(axis.pulses_net) +
                                                         ", the card counts " + grouped(axis.pulse_counter) + "</b>"));
    out += cell(pair(axis.encoder_counts, axis.expected_counts)) + cell(axis.servo ? "-" : lost);
    out += cell(against(axis.peak_velocity, axis.max_velocity, unit + "/s")) +
           cell(against(axis.peak_accel, axis.max_accel, unit + "/s\xC2\xB2"));
    out += cell(number(axis.peak_velocity_step) + " <small>" + unit + "/s</small>");
    out += cell(number(axis.actual_end, 4) + " <small>" + unit + "</small><br><small>planned " +
                number(axis.planned_end, 4) + "</small>");
    return out + "</tr>\n";
}

std::string move_row(const ReportMove& move, std::size_t index) {
    const std::string unit = shown(move.unit, 20);
    std::string out = fmt::format("<tr data-move=\"{}\">", index);
    out += cell(move.line > 0 ? std::to_string(move.line) : "");
    out += cell("<code>" + shown(move.text, 100) + "</code>", "t") + cell(shown(move.kind, 40), "t");
    out += cell(number(move.length, 3) + " <small>" + unit + "</small>");
    out += cell(number(move.start, 3)) + cell(number(move.duration, 3));
    out += cell(number(move.entry_velocity, 2)) + cell(number(move.peak_velocity, 2)) +
           cell(number(move.exit_velocity, 2));
    return out + cell(number(move.deviation_mm, 4)) + "</tr>\n";
}

std::string place_html(const Xyz& at) {
    return "X&nbsp;" + number(at[0], 3) + " Y&nbsp;" + number(at[1], 3) + " Z&nbsp;" + number(at[2], 3);
}

std::string table(const char* id, const char* caption, const std::vector<std::string>& heads, const std::string& rows) {
    std::string out = fmt::format(
        "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{}\"><table id=\"{}\">"
        "<caption>{}</caption><thead><tr>",
        caption, id, caption);
    for (const std::string& head : heads) out += "<th scope=\"col\">" + head + "</th>";
    return out + "</tr></thead><tbody>\n" + rows + "</tbody></table></div>\n";
}

std::string section(const char* id, const char* title, const std::string& inside) {
    return fmt::format("<section id=\"{}\"><h2>{}</h2>\n{}</section>\n", id, title, inside);
}

}  // namespace

std::string shown(const std::string& text, std::size_t max_bytes) {
    return escaped(cut_text(text, max_bytes));
}

std::optional<Xyz> driven_at(const ReportData& data, double seconds) {
    const std::size_t count = std::min(data.driven.size(), data.seconds.size());
    if (!std::isfinite(seconds)) return {};
    const auto end = data.seconds.begin() + static_cast<std::ptrdiff_t>(count);
    const auto after = std::upper_bound(data.seconds.begin(), end, seconds);
    if (after == data.seconds.begin() || (after == end && (count == 0 || seconds > data.seconds[count - 1]))) return {};
    const auto i = static_cast<std::size_t>(after - data.seconds.begin()) - 1, next = std::min(i + 1, count - 1);
    const double span = data.seconds[next] - data.seconds[i];
    const double part = span > 0 ? (seconds - data.seconds[i]) / span : 0;
    Xyz at{};
    for (std::size_t c = 0; c < 3; ++c) {
        at[c] = data.driven[i][c] + part * (data.driven[next][c] - data.driven[i][c]);
        if (!std::isfinite(at[c])) return {};
    }
    return at;
}

std::string header_html(const ReportData& data) {
    std::string out = "<h1>" + shown(data.title.empty() ? "Motionrack run" : data.title) + "</h1>\n<p class=\"from\">";
    if (!data.program_name.empty()) out += shown(data.program_kind) + " <b>" + shown(data.program_name) + "</b>";
    if (!data.program_name.empty() && !data.rack_name.empty()) out += " on ";
    if (!data.rack_name.empty()) out += "rack <b>" + shown(data.rack_name) + "</b>";
    out += fmt::format(
        "</p>\n<p class=\"verdict {}\"><span class=\"sign\" aria-hidden=\"true\">{}</span><span>{}</span></p>\n",
        data.verdict.ok ? "good" : "wrong", data.verdict.ok ? "&#10003;" : "!", shown(data.verdict.text));
    if (!data.warnings.empty()) {
        out += fmt::format("<p class=\"from\"><a href=\"#warnings\">{} {}</a></p>\n", data.warnings.size(),
                           data.warnings.size() == 1 ? "warning" : "warnings");
    }
    if (data.numbers.empty()) return out;
    out += "<dl class=\"numbers\">\n";
    for (std::size_t i = 0; i < std::min<std::size_t>(data.numbers.size(), 40); ++i) {
        const ReportNumber& n = data.numbers[i];
        out += "<div><dt>" + shown(n.label, 200) + "</dt><dd>" + shown(n.value, 200);
        if (!n.unit.empty()) out += "&nbsp;<small>" + shown(n.unit, 40) + "</small>";
        out += "</dd></div>\n";
    }
    return out + "</dl>\n";
}

std::string axes_html(const ReportData& data) {
    if (data.axes.empty()) return {};
    std::string rows;
    for (std::size_t i = 0; i < std::min<std::size_t>(data.axes.size(), 64); ++i) rows += axis_row(data.axes[i]);
    const std::vector<std::string> heads = {"Axis",          "Pulses sent",       "Encoder counts", "Steps lost",
                                            "Peak velocity", "Peak acceleration", "Velocity step",  "Ends at"};
    return section("axes", "Axes", table("axis-table", "Commanded and actual motion of each axis", heads, rows));
}

std::string moves_html(const ReportData& data) {
    if (data.moves.empty()) return {};
    std::string rows;
    const std::size_t count = std::min(data.moves.size(), max_moves);
    for (std::size_t i = 0; i < count; ++i) rows += move_row(data.moves[i], i);
    std::string note;
    if (count < data.moves.size()) {
        note = "<p class=\"hint\">The first " + grouped(static_cast<long long>(count)) + " of " +
               grouped(static_cast<long long>(data.moves.size())) +
               " moves are listed; the path and the charts show all.</p>\n";
    }
    const std::vector<std::string> heads = {"Line",        "Program",   "Kind",     "Length",   "Start, s",
                                            "Duration, s", "Entry, /s", "Peak, /s", "Exit, /s", "Deviation, mm"};
    return section("moves", "Moves", note + table("move-table", "Executed moves", heads, rows));
}

std::string warnings_html(const ReportData& data) {
    if (data.warnings.empty()) return {};
    std::string rows;
    const std::size_t count = std::min(data.warnings.size(), max_warnings);
    for (std::size_t i = 0; i < count; ++i) {
        const ReportWarning& warning = data.warnings[i];
        const bool instant = warning.seconds >= 0 && std::isfinite(warning.seconds);
        rows += instant ? fmt::format("<tr data-time=\"{}\">", warning.seconds) : "<tr>";
        rows += cell(instant ? number(warning.seconds, 4) : "") +
                cell(warning.line > 0 ? std::to_string(warning.line) : "");
        const std::optional<Xyz> at = instant ? driven_at(data, warning.seconds) : std::nullopt;
        rows += cell(at ? place_html(*at) : "") + cell(shown(warning.text, 400), "t") + "</tr>\n";
    }
    std::string note;
    if (count < data.warnings.size()) {
        note = "<p class=\"hint\">The first " + grouped(static_cast<long long>(count)) + " of " +
               grouped(static_cast<long long>(data.warnings.size())) + " warnings are listed.</p>\n";
    }
    return section("warnings", "Warnings",
                   note + table("warning-table", "Warnings, in their order",
                                {"Time, s", "Line", "Machine at, mm", "What happened"}, rows));
}

std::string pictures_html(const ReportData& data) {
    if (data.pictures.empty()) return {};
    std::string inside =
        data.pictures_hint.empty() ? std::string() : "<p class=\"hint\">" + shown(data.pictures_hint) + "</p>\n";
    inside += "<div class=\"pictures\">\n";
    for (const ReportPicture& p : data.pictures) {
        inside += fmt::format("<figure class=\"card{}\"><figcaption><span class=\"name\">{}</span>",
                              p.wide ? " wide" : "", shown(p.title));
        for (const std::string& line : p.words) inside += "<span>" + shown(line) + "</span>";
        inside += "</figcaption>\n<div class=\"picture\">" + p.svg + "</div></figure>\n";
    }
    return section("pictures", "Pictures", inside + "</div>\n");
}

std::string tables_html(const ReportData& data) {
    std::string out;
    for (std::size_t i = 0; i < data.tables.size(); ++i) {
        const ReportTable& t = data.tables[i];
        std::vector<std::string> heads;
        for (const std::string& head : t.heads) heads.push_back(shown(head));
        std::string rows;
        for (std::size_t r = 0; r < std::min(t.rows.size(), max_rows); ++r) {
            rows += "<tr>";
            for (const std::string& text : t.rows[r]) rows += cell(shown(text), "t");
            rows += "</tr>\n";
        }
        if (t.rows.size() > max_rows)
            rows += fmt::format("<tr><td colspan=\"{}\">and {} more</td></tr>\n", heads.size(),
                                grouped(static_cast<long long>(t.rows.size() - max_rows)));
        const std::string id = fmt::format("table-{}", i);
        out += section(id.c_str(), shown(t.title).c_str(),
                       table((id + "-rows").c_str(), shown(t.caption).c_str(), heads, rows));
    }
    return out;
}

std::string source_html(const ReportData& data) {
    if (!data.source) return {};
    std::string lines;
    std::istringstream in(cut_text(data.source->text, max_source_bytes));
    in.exceptions(std::ios::badbit);  // otherwise a failed allocation would look like the end of the text
    for (std::string line; std::getline(in, line);) lines += escaped(line) + "\n";
    return section("source", shown(data.source->title).c_str(), "<pre class=\"card\">" + lines + "</pre>\n");
}

std::string notes_html(const ReportData& data) {
    std::string items;
    for (std::size_t i = 0; i < std::min<std::size_t>(data.notes.size(), 50); ++i) {
        items += "<li>" + shown(data.notes[i]) + "</li>\n";
    }
    items +=
        "<li>Lines in the pictures are drawn from fewer points than were recorded; the minimum and maximum values "
        "stay. The tables hold the numbers as recorded.</li>\n";
    return section("notes", "Limits of this report", "<ul class=\"card\">\n" + items + "</ul>\n");
}

}  // namespace motionrack::trace
