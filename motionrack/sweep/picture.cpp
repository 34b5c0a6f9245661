// Selects the axes of the charts.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <motionrack/base/numbers.hpp>
#include <motionrack/rack/count_noun.hpp>
#include <motionrack/sweep/picture.hpp>
#include <motionrack/trace/csv_rows.hpp>
#include <motionrack/trace/svg_scatter.hpp>
#include <set>

namespace motionrack::sweep {

namespace {

constexpr int width = 760, chart_height = 210, map_height = 300, heading_height = 22;
constexpr std::size_t max_lines = 6, max_maps = 12;
constexpr std::array<const char*, max_lines> looks = {"z", "x", "y", "a", "b", "c"};

/// A varied parameter with more than one value.
struct Varied {
    std::size_t at = 0;  ///< index in the parameters
    std::string name;
    bool number = false;
    std::vector<std::string> names;  ///< values of a non-numeric parameter, in file order
};

struct Measure {
    std::string title;
    std::vector<double> values;  ///< one per point
};

class Picture {
  public:
    Picture(const Sweep& sweep, const Results& results) : sweep_(sweep), results_(results) {
        for (std::int64_t i = 0; i < sweep.points(); ++i) values_.push_back(sweep.values(i));
        for (std::size_t p = 0; p < sweep.parameters().size(); ++p) look_at(p);
        measures_ = {{"time, s", column("time_s")}, {"max deviation, mm", column("max_deviation_mm")}};
        std::vector<double> lost = lost_pulses();
        if (std::any_of(lost.begin(), lost.end(), [](double one) { return one > 0; }))
            measures_.push_back({"lost pulses", std::move(lost)});
    }

    std::string draw() {
        std::vector<const Varied*> numbers, rest;
        for (const Varied& one : varied_) (one.number ? numbers : rest).push_back(&one);
        group(rest);
        if (numbers.size() == 1 && groups_.size() <= max_lines)
            draw_lines(*numbers[0]);
        else if (numbers.size() == 2 && groups_.size() <= max_maps)
            draw_maps(*numbers[0], *numbers[1]);
        else
            draw_each();
        return trace::svg_column(title(), parts_, width);
    }

  private:
    void look_at(std::size_t p) {
        Varied out{p, sweep_.parameters()[p].name, sweep_.parameters()[p].numeric(), {}};
        std::set<std::string> seen;
        for (const auto& values : values_) seen.insert(value_text(values[p]));
        for (const rack::TomlNode& value : sweep_.parameters()[p].values)
            if (const std::string name = value_text(value);
                !out.number && seen.count(name) != 0 &&
                std::find(out.names.begin(), out.names.end(), name) == out.names.end())
                out.names.push_back(name);
        if (seen.size() > 1) varied_.push_back(std::move(out));
    }

    std::vector<double> column(std::string_view name) const {
        std::vector<double> out;
        for (std::int64_t i = 0; i < sweep_.points(); ++i) out.push_back(number_of(cell_of(results_.row(i), name)));
        return out;
    }

    std::vector<double> lost_pulses() const {
        std::vector<double> out(values_.size(), 0);
        for (const ResultColumn& result : result_columns()) {
            if (!result.name.ends_with("_lost_pulses")) continue;
            const std::vector<double> axis = column(result.name);
            for (std::size_t i = 0; i < out.size(); ++i) out[i] += std::isfinite(axis[i]) ? std::fabs(axis[i]) : 0;
        }
        return out;
    }

    bool bad(std::size_t point) const {
        return cell_of(results_.row(static_cast<std::int64_t>(point)), "ended") != "ok";
    }
    double number(const Varied& varied, std::size_t point) const {
        const rack::TomlNode& value = values_[point][varied.at];
        if (varied.number)
            return value.type == rack::TomlType::integer ? static_cast<double>(value.integer) : value.number;
        return static_cast<double>(std::find(varied.names.begin(), varied.names.end(), value_text(value)) -
                                   varied.names.begin());
    }

    static std::string shown(const std::string& text) { return text.empty() ? "none" : text; }

    /// Groups points by the combination of these values.
    void group(const std::vector<const Varied*>& by) {
        for (std::size_t i = 0; i < values_.size(); ++i) {
            std::string name;
            for (const Varied* one : by) {
                const std::string value = shown(value_text(values_[i][one->at]));
                name += by.size() == 1 ? value : fmt::format("{}{} {}", name.empty() ? "" : ", ", one->name, value);
            }
            auto found =
                std::find_if(groups_.begin(), groups_.end(), [&](const auto& group) { return group.first == name; });
            if (found == groups_.end()) found = groups_.insert(groups_.end(), {name, {}});
            found->second.push_back(i);
            if (groups_.size() > max_maps) return;
        }
    }

    std::string title() const {
        std::size_t ok = 0;
        for (std::size_t i = 0; i < values_.size(); ++i) ok += !bad(i);
        const auto file = [](const std::string& path) { return std::filesystem::path(path).filename().string(); };
        std::string out = fmt::format("{} on {}: {}", file(sweep_.program_name()), file(sweep_.rack_name()),
                                      rack::count_noun(values_.size(), "point"));
        if (ok < values_.size()) out += fmt::format(", {} failed (crosses)", values_.size() - ok);
        return out;
    }

    /// Points over x, one series per group; a single series if there are too many groups.
    trace::SvgScatter scatter(const Measure& measure, const Varied& x, bool joined) const {
        trace::SvgScatter out{measure.title, x.name, {}, {}};
        for (const std::string& name : x.names) out.x_names.push_back(shown(name));
        const bool grouped = x.number && groups_.size() <= max_lines;
        for (std::size_t g = 0; grouped && g < groups_.size(); ++g) {
            trace::SvgDots dots{groups_[g].first, looks[g], {}, joined};
            for (const std::size_t i : groups_[g].second) dots.dots.push_back(dot(measure, x, i));
            out.series.push_back(std::move(dots));
        }
        if (grouped) return out;
        out.series.push_back({"", looks[0], {}, false});
        for (std::size_t i = 0; i < values_.size(); ++i) out.series[0].dots.push_back(dot(measure, x, i));
        return out;
    }
    trace::SvgDot dot(const Measure& measure, const Varied& x, std::size_t point) const {
        return {number(x, point), measure.values[point], bad(point)};
    }

    void draw_lines(const Varied& x) {
        for (const Measure& measure : measures_)
            parts_.push_back(
                {trace::svg_scatter(scatter(measure, x, true), {width, chart_height, false}), chart_height});
    }

    void draw_maps(const Varied& x, const Varied& y) {
        for (const auto& [name, points] : groups_) {
            std::vector<std::string> row;
            for (const Measure& measure : measures_) {
                trace::SvgMap map{measure.title, x.name, y.name, {}};
                for (const std::size_t i : points)
                    map.spots.push_back({number(x, i), number(y, i), measure.values[i], bad(i)});
                row.push_back(trace::svg_map(map, {width / static_cast<int>(measures_.size()), map_height, false}));
            }
            add_row(name, row, map_height);
        }
    }

    void draw_each() {
        if (varied_.empty()) varied_.push_back({0, sweep_.parameters()[0].name, false, {value_text(values_[0][0])}});
        for (const Varied& x : varied_) {
            std::vector<std::string> row;
            for (const Measure& measure : measures_) {
                trace::SvgScatter one = scatter(measure, x, false);
                // A row has space for the names once.
                for (trace::SvgDots& series : one.series)
                    if (!row.empty()) series.name.clear();
                row.push_back(
                    trace::svg_scatter(one, {width / static_cast<int>(measures_.size()), chart_height, false}));
            }
            add_row({}, row, chart_height);
        }
    }

    /// Places pictures of the same size side by side, below a name.
    void add_row(const std::string& name, const std::vector<std::string>& pictures, int height) {
        const int heading = name.empty() ? 0 : heading_height, each = width / static_cast<int>(pictures.size());
        std::vector<trace::SvgPart> row;
        for (const std::string& picture : pictures) row.push_back({picture, height});
        parts_.push_back({trace::svg_row(name, row, each, heading), height + heading});
    }

    const Sweep& sweep_;
    const Results& results_;
    std::vector<std::vector<rack::TomlNode>> values_;
    std::vector<Varied> varied_;
    std::vector<Measure> measures_;
    std::vector<std::pair<std::string, std::vector<std::size_t>>> groups_;
    std::vector<trace::SvgPart> parts_;
};

}  // namespace

std::string picture_of(const Sweep& sweep, const Results& results) {
    return Picture(sweep, results).draw();
}

}  // namespace motionrack::sweep
