// Waveforms as a picture.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/trace/svg_parts.hpp>
#include <motionrack/trace/svg_waves.hpp>
#include <motionrack/trace/text.hpp>

namespace motionrack::trace {

namespace {

constexpr double waves_left = 96, waves_right = 16, waves_heading = 44, each = 26, swing = 14, foot = 26;

/// Converts seconds to pixels.
struct Scale {
    double from, to, width;
    double x(double s) const { return waves_left + (std::clamp(s, from, to) - from) / (to - from) * width; }
};

std::string line_of_wave(const SvgWave& wave, const Scale& scale, double low) {
    std::string points;
    const auto put = [&](double x, double y) { points += fmt::format("{},{} ", coordinate(x), coordinate(y)); };
    double y = low;
    for (std::size_t i = 0; i < wave.changes.size(); ++i) {
        const auto& [at, value] = wave.changes[i];
        const double x = scale.x(at);
        if (i > 0) put(x, y);
        y = value != 0 ? low - swing : low;
        put(x, y);
    }
    put(scale.x(scale.to), y);
    return fmt::format("<polyline class=\"line\" points=\"{}\"/>\n", points);
}

std::string bands_of(const SvgWave& wave, const Scale& scale, double low) {
    std::string out;
    for (std::size_t i = 0; i < wave.changes.size(); ++i) {
        const auto& [at, value] = wave.changes[i];
        const double end = i + 1 < wave.changes.size() ? wave.changes[i + 1].first : scale.to;
        const double a = scale.x(at), b = scale.x(end), middle = low - swing / 2, slope = std::min(3.0, (b - a) / 2);
        if (b - a < 0.3) continue;
        const bool pale = value == wave.rest;
        out += fmt::format(
            "<path d=\"M{} {}L{} {}L{} {}L{} {}L{} {}L{} {}Z\" style=\"stroke:{};stroke-width:1.2;fill:{}\"/>\n",
            coordinate(a), coordinate(middle), coordinate(a + slope), coordinate(low - swing), coordinate(b - slope),
            coordinate(low - swing), coordinate(b), coordinate(middle), coordinate(b - slope), coordinate(low),
            coordinate(a + slope), coordinate(low), pale ? "#c3ccd5" : "#0b5cab", pale ? "none" : "#e8f0f9");
        const std::string text = wave.text ? wave.text(value) : fmt::format("{:X}h", value);
        if (!pale && static_cast<double>(text.size()) * letter_width < b - a - 2)
            out += svg_text((a + b) / 2, low - 3, "middle", text);
    }
    return out;
}

std::string unit_of(double span, double& factor) {
    static constexpr std::pair<double, const char*> units[] = {{1e-6, "ns"}, {1e-3, "us"}, {1, "ms"}};
    for (const auto& [max_span, unit] : units)
        if (span < 2 * max_span) return factor = 1e3 / max_span, unit;
    return factor = 1, "s";
}

}  // namespace

std::string svg_waves(const std::string& title, const std::vector<SvgWave>& waves, const std::vector<SvgMark>& marks,
                      double from_s, double to_s, const SvgStyle& style) {
    const double bottom = waves_heading + each * static_cast<double>(waves.size());
    SvgStyle own = style;
    own.height = static_cast<int>(bottom + foot);
    const Scale scale{from_s, to_s, style.width - waves_left - waves_right};
    std::string out = svg_head(own, title);
    out += fmt::format("<text class=\"title\" x=\"{}\" y=\"15\">{}</text>\n", coordinate(waves_left), escaped(title));
    double factor = 1;
    const std::string unit = unit_of(to_s - from_s, factor);
    const double step = nice_step((to_s - from_s) * factor, 10);
    for (double t = std::ceil(from_s * factor / step) * step; t <= to_s * factor + step * 1e-6; t += step) {
        const double x = scale.x(t / factor);
        out += fmt::format("<path class=\"grid\" d=\"M{} {}V{}\"/>\n", coordinate(x), coordinate(waves_heading),
                           coordinate(bottom));
        out += svg_text(x, bottom + 16, "middle", fmt::format("{:g}", t == 0 ? 0 : t));
    }
    out += svg_text(waves_left - 8, bottom + 16, "end", "time, " + unit);
    for (const SvgMark& mark : marks) {
        const double x = scale.x(mark.at_s);
        out += fmt::format("<path class=\"limit\" d=\"M{} {}V{}\"/>\n", coordinate(x), coordinate(waves_heading - 8),
                           coordinate(bottom));
        out += svg_text(x, waves_heading - 12, "middle", mark.name);
    }
    for (std::size_t i = 0; i < waves.size(); ++i) {
        const double low = waves_heading + each * static_cast<double>(i + 1) - 6;
        out += svg_text(waves_left - 8, low - 2, "end", waves[i].name);
        out += waves[i].band ? bands_of(waves[i], scale, low) : line_of_wave(waves[i], scale, low);
    }
    return out + "</svg>\n";
}

}  // namespace motionrack::trace
