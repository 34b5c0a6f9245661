// Report page: inserts its parts into the template in one pass, so that run data is never taken for a placeholder.
#include <algorithm>
#include <cmath>
#include <motionrack/trace/report.hpp>
#include <motionrack/trace/report_assets.hpp>
#include <motionrack/trace/report_parts.hpp>
#include <motionrack/trace/text.hpp>
#include <string_view>
#include <utility>

namespace motionrack::trace {

namespace {

using Parts = std::vector<std::pair<std::string_view, std::string>>;

/// Replaces each {{name}} of the template.
std::string filled(std::string_view page, const Parts& parts) {
    std::string out;
    while (true) {
        const std::size_t open = page.find("{{");
        const std::size_t close = open == std::string_view::npos ? open : page.find("}}", open);
        if (close == std::string_view::npos) return out.append(page);
        const std::string_view name = page.substr(open + 2, close - open - 2);
        const auto part = std::find_if(parts.begin(), parts.end(), [&](const auto& p) { return p.first == name; });
        MOTIONRACK_ASSERT(part != parts.end());
        out.append(page.substr(0, open)).append(part->second);
        page.remove_prefix(close + 2);
    }
}

std::string path_svg(const ReportData& data, PathView view) {
    SvgStyle style;
    style.width = 680;
    style.height = 480;
    return svg_path(data, view, style);
}

std::string script() {
    return std::string(report_script_base) + report_script_charts + report_script_path + report_script_page;
}

}  // namespace

std::string report_html(const ReportData& data) {
    const std::vector<PageChart> charts = charts_of(data);
    const bool path = extent_of_path(data).some;
    const Parts parts = {
        {"title", shown(data.title.empty() ? "Motionrack run" : data.title)},
        {"style", report_style},
        {"header", header_html(data)},
        {"path_hidden", path ? "" : " hidden"},
        {"stop_hidden", data.stop ? "" : " hidden"},
        {"charts_hidden", charts.empty() ? " hidden" : ""},
        {"plan", path ? path_svg(data, PathView::plan) : ""},
        {"perspective", path ? path_svg(data, PathView::perspective) : ""},
        {"pictures", pictures_html(data)},
        {"tables", tables_html(data)},
        {"series", series_html(charts)},
        {"charts", charts_html(data, charts)},
        {"axes", axes_html(data)},
        {"moves", moves_html(data)},
        {"warnings", warnings_html(data)},
        {"source", source_html(data)},
        {"notes", notes_html(data)},
        {"drawing", drawing_json(data, charts)},
        {"script", script()},
    };
    return filled(report_page, parts);
}

Result<void> write_report(const ReportData& data, const std::string& path) {
    return write_text(report_html(data), path);
}

}  // namespace motionrack::trace
