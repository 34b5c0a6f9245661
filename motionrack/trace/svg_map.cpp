// A value over two variables, as colour.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/trace/svg_parts.hpp>
#include <motionrack/trace/svg_scatter.hpp>
#include <motionrack/trace/text.hpp>
#include <set>

namespace motionrack::trace {

namespace {

constexpr double map_left = chart_left + 10, map_right = chart_right, map_top = 46, map_bottom = 38;
constexpr int scale_steps = 20;

class Map {
  public:
    Map(const SvgMap& map, const SvgStyle& style) : map_(map), style_(style) {
        std::set<double> xs, ys;
        std::set<std::pair<double, double>> places;
        bool some = false;
        for (const SvgSpot& spot : map.spots) {
            xs.insert(spot.x);
            ys.insert(spot.y);
            places.insert({spot.x, spot.y});
            if (!std::isfinite(spot.value) || spot.bad) continue;
            low_ = some ? std::min(low_, spot.value) : spot.value;
            high_ = some ? std::max(high_, spot.value) : spot.value;
            some = true;
        }
        xs_.assign(xs.begin(), xs.end());
        ys_.assign(ys.begin(), ys.end());
        cells_ = !places.empty() && places.size() == xs_.size() * ys_.size();
        for (digits_ = 4; digits_ > 1 && !all_fit(); --digits_) {
        }
    }

    std::string draw() const {
        std::string out = svg_head(style_, map_.title + " over " + map_.x_name + " and " + map_.y_name);
        out += fmt::format("<text class=\"title\" x=\"{}\" y=\"16\">{}</text>\n", coordinate(map_left),
                           escaped(map_.title)) +
               scale();
        const std::size_t every = cells_ ? 1 : 1 + map_.spots.size() / (max_dots + 1);
        if (!map_.spots.empty()) out += ticks();
        for (std::size_t i = 0; i < map_.spots.size(); i += every)
            out += cells_ ? cell(map_.spots[i]) : dot(map_.spots[i]);
        out += svg_text((map_left + style_.width - map_right) / 2, style_.height - 5, "middle", map_.x_name);
        out += fmt::format("<text transform=\"translate(12 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                           coordinate((map_top + style_.height - map_bottom) / 2), escaped(map_.y_name));
        return out + "</svg>\n";
    }

  private:
    double wide() const { return style_.width - map_left - map_right; }
    double tall() const { return style_.height - map_top - map_bottom; }
    double cell_width() const { return wide() / static_cast<double>(xs_.size()); }
    double cell_height() const { return tall() / static_cast<double>(ys_.size()); }
    static std::size_t index(const std::vector<double>& all, double one) {
        return static_cast<std::size_t>(std::lower_bound(all.begin(), all.end(), one) - all.begin());
    }
    /// Centre of a cell.
    double x(double value) const {
        if (cells_) return map_left + (static_cast<double>(index(xs_, value)) + 0.5) * cell_width();
        return map_left + (0.03 + 0.94 * part_of(value, xs_.front(), xs_.back())) * wide();
    }
    double y(double value) const {
        if (cells_) return map_top + tall() - (static_cast<double>(index(ys_, value)) + 0.5) * cell_height();
        return map_top + tall() - (0.03 + 0.94 * part_of(value, ys_.front(), ys_.back())) * tall();
    }
    static double part_of(double value, double low, double high) {
        return high > low ? (value - low) / (high - low) : 0.5;
    }

    std::string cell_text(double value) const { return fmt::format("{:.{}g}", value, digits_); }
    /// Returns true if all numbers fit into their cells.
    bool all_fit() const {
        return cells_ && cell_height() >= 14 &&
               std::all_of(map_.spots.begin(), map_.spots.end(), [this](const SvgSpot& spot) {
                   return spot.bad || !std::isfinite(spot.value) ||
                          letter_width * static_cast<double>(cell_text(spot.value).size()) + 4 <= cell_width();
               });
    }

    std::string ticks() const {
        std::string out;
        const auto along = [](const std::vector<double>& all, double each, double width, bool cells) {
            std::vector<double> at;
            if (cells) {
                const auto every = static_cast<std::size_t>(std::max(1.0, std::ceil(width / each)));
                for (std::size_t i = 0; i < all.size(); i += every) at.push_back(all[i]);
            } else {
                const double step = nice_step(all.back() - all.front(), 5);
                for (double k = std::ceil(all.front() / step - 1e-9);
                     k * step <= all.back() + step * 1e-9 && at.size() < 20; k += 1)
                    at.push_back(k * step);
            }
            return at;
        };
        for (const double value : along(xs_, cell_width(), 44, cells_))
            out += svg_text(x(value), style_.height - map_bottom + 15, "middle", number(value));
        for (const double value : along(ys_, cell_height(), 14, cells_))
            out += svg_text(map_left - 6, y(value) + 4, "end", number(value));
        return out;
    }

    std::string cell(const SvgSpot& spot) const {
        const double w = cell_width(), h = cell_height(), cx = x(spot.x), cy = y(spot.y),
                     part = part_of(spot.value, low_, high_);
        const bool bad = spot.bad || !std::isfinite(spot.value);
        std::string out = fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n",
                                      coordinate(cx - w / 2), coordinate(cy - h / 2), coordinate(w - 0.6),
                                      coordinate(h - 0.6), bad ? "#dde3e8" : svg_shade(part));
        if (bad) return out + cross(cx, cy);
        if (digits_ < 2) return out;
        const std::string text = cell_text(spot.value);
        return out + fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\" style=\"fill:{}\">{}</text>\n",
                                 coordinate(cx), coordinate(cy + 4), svg_ink(part), text);
    }

    std::string dot(const SvgSpot& spot) const {
        if (spot.bad || !std::isfinite(spot.value)) return cross(x(spot.x), y(spot.y));
        return fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"4\" fill=\"{}\"/>\n", coordinate(x(spot.x)),
                           coordinate(y(spot.y)), svg_shade(part_of(spot.value, low_, high_)));
    }

    static std::string cross(double x, double y) {
        return fmt::format("<path style=\"stroke:#b3261e;stroke-width:2\" d=\"M{} {}m-4-4l8 8m-8 0l8-8\"/>\n",
                           coordinate(x), coordinate(y));
    }

    /// Colour scale from minimum to maximum, with both numbers, below the title.
    std::string scale() const {
        const double from = map_left + letter_width * static_cast<double>(number(low_).size()) + 6, step = 6, at = 25;
        std::string out = svg_text(map_left, at + 9, "start", number(low_));
        for (int i = 0; i < scale_steps; ++i)
            out += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"10\" fill=\"{}\"/>\n",
                               coordinate(from + step * i), coordinate(at), coordinate(step + 0.3),
                               svg_shade(static_cast<double>(i) / (scale_steps - 1)));
        return out + svg_text(from + step * scale_steps + 5, at + 9, "start", number(high_));
    }

    const SvgMap& map_;
    const SvgStyle style_;
    std::vector<double> xs_, ys_;
    bool cells_ = false;
    int digits_ = 0;  ///< decimals of the numbers in cells; below 2: no numbers
    double low_ = 0, high_ = 0;
};

}  // namespace

std::string svg_map(const SvgMap& map, const SvgStyle& style) {
    return Map(map, style).draw();
}

}  // namespace motionrack::trace
