// Dots over numbers or categories.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/trace/svg_parts.hpp>
#include <motionrack/trace/svg_scatter.hpp>
#include <motionrack/trace/text.hpp>

namespace motionrack::trace {

namespace {

constexpr double scatter_left = chart_left, scatter_right = chart_right, scatter_top = 28, scatter_bottom = 38;

struct Span {
    double low = 0, high = 0;
    bool some = false;
    void add(double value) {
        if (!std::isfinite(value)) return;
        low = some ? std::min(low, value) : value;
        high = some ? std::max(high, value) : value;
        some = true;
    }
    /// Widens the range by `part` on both sides; gives a single value a nonzero range.
    void widen(double part) {
        const double air = high > low ? part * (high - low) : std::max(1e-9, 0.1 * std::fabs(high));
        low -= air;
        high += air;
    }
};

class Scatter {
  public:
    Scatter(const SvgScatter& scatter, const SvgStyle& style) : scatter_(scatter), style_(style) {
        for (const SvgDots& series : scatter.series)
            for (const SvgDot& dot : series.dots) x_.add(dot.x), y_.add(dot.y);
        if (named())
            x_.add(-0.5), x_.add(static_cast<double>(scatter.x_names.size()) - 0.5);
        else
            x_.widen(0.03);
        const bool from_zero = y_.low >= 0 && y_.low < 0.4 * y_.high;
        y_.widen(0.07);
        if (from_zero) y_.low = 0;
    }

    std::string draw() const {
        std::string out = svg_head(style_, scatter_.title + " over " + scatter_.x_name) + grid();
        for (const SvgDots& series : scatter_.series) out += line(series);
        for (const SvgDots& series : scatter_.series) out += dots(series);
        out +=
            fmt::format("<text class=\"title\" x=\"{}\" y=\"16\">{}</text>\n", scatter_left, escaped(scatter_.title));
        return out + names() +
               svg_text((scatter_left + style_.width - scatter_right) / 2, style_.height - 5, "middle",
                        scatter_.x_name) +
               "</svg>\n";
    }

  private:
    bool named() const { return !scatter_.x_names.empty(); }
    double x(double value) const {
        return scatter_left + (value - x_.low) / (x_.high - x_.low) * (style_.width - scatter_left - scatter_right);
    }
    double y(double value) const {
        return !std::isfinite(value)
                   ? style_.height - scatter_bottom - 6
                   : style_.height - scatter_bottom -
                         (value - y_.low) / (y_.high - y_.low) * (style_.height - scatter_top - scatter_bottom);
    }

    static std::string straight(double x1, double y1, double x2, double y2) {
        return fmt::format("<polyline class=\"grid\" points=\"{},{} {},{}\"/>\n", coordinate(x1), coordinate(y1),
                           coordinate(x2), coordinate(y2));
    }

    std::string grid() const {
        std::string out;
        const double step = nice_step(
            y_.high - y_.low, std::max(2, static_cast<int>((style_.height - scatter_top - scatter_bottom) / 26)));
        for (const double value : marks(y_, step))
            out += straight(scatter_left, y(value), style_.width - scatter_right, y(value)) +
                   svg_text(scatter_left - 6, y(value) + 4, "end", number(value));
        const double below = style_.height - scatter_bottom + 15;
        if (named()) {
            const double each =
                (style_.width - scatter_left - scatter_right) / static_cast<double>(scatter_.x_names.size());
            for (std::size_t i = 0; i < scatter_.x_names.size(); ++i)
                out += svg_text(x(static_cast<double>(i)), below, "middle", fitted(scatter_.x_names[i], each));
            return out;
        }
        const double across = nice_step(x_.high - x_.low, std::max(2, static_cast<int>(style_.width / 80)));
        for (const double value : marks(x_, across))
            out += straight(x(value), scatter_top, x(value), style_.height - scatter_bottom) +
                   svg_text(x(value), below, "middle", number(value));
        return out;
    }

    /// Multiples of `step`.
    static std::vector<double> marks(const Span& span, double step) {
        std::vector<double> out;
        for (int i = 0; i < 100; ++i) {
            const double value = (std::ceil(span.low / step - 1e-9) + i) * step;
            if (value > span.high + step * 1e-9) break;
            out.push_back(value);
        }
        return out;
    }

    /// Truncates a name to the available space.
    static std::string fitted(const std::string& name, double width) {
        const auto max_letters = static_cast<std::size_t>(std::max(3.0, width / letter_width));
        return name.size() <= max_letters ? name : name.substr(0, max_letters - 2) + "..";
    }

    std::string line(const SvgDots& series) const {
        if (!series.joined) return {};
        std::vector<SvgDot> sorted = series.dots;
        std::stable_sort(sorted.begin(), sorted.end(), [](const SvgDot& a, const SvgDot& b) { return a.x < b.x; });
        std::string out, points;
        const auto end_piece = [&] {
            if (points.find(' ') != points.rfind(' '))
                out += fmt::format("<polyline class=\"line {}\" points=\"{}\"/>\n", escaped(series.style),
                                   points.substr(0, points.size() - 1));
            points.clear();
        };
        for (const SvgDot& dot : sorted) {
            if (dot.bad || !std::isfinite(dot.y))
                end_piece();
            else
                points += coordinate(x(dot.x)) + ',' + coordinate(y(dot.y)) + ' ';
        }
        end_piece();
        return out;
    }

    std::string dots(const SvgDots& series) const {
        std::string out;
        const std::size_t every = 1 + series.dots.size() / (max_dots + 1);
        for (std::size_t i = 0; i < series.dots.size(); i += every) {
            const SvgDot& dot = series.dots[i];
            const std::string at = coordinate(x(dot.x)), up = coordinate(y(dot.y));
            out += dot.bad ? fmt::format(
                                 "<path class=\"line {}\" style=\"stroke-width:2\" d=\"M{} {}m-4-4l8 8m-8 0l8-8\"/>\n",
                                 escaped(series.style), at, up)
                           : fmt::format("<circle class=\"line {}\" fill=\"#fff\" cx=\"{}\" cy=\"{}\" r=\"3\"/>\n",
                                         escaped(series.style), at, up);
        }
        return out;
    }

    std::string names() const {
        SvgChart chart;
        for (const SvgDots& series : scatter_.series) chart.series.push_back({series.name, series.style, {}, {}});
        return series_names(chart, style_.width - scatter_right, 16);
    }

    const SvgScatter& scatter_;
    const SvgStyle style_;
    Span x_, y_;
};

}  // namespace

std::string svg_scatter(const SvgScatter& scatter, const SvgStyle& style) {
    return Scatter(scatter, style).draw();
}

}  // namespace motionrack::trace
