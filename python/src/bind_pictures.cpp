// Built-in pictures of values over time, for notebooks without matplotlib.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <motionrack/trace/svg.hpp>
#include <python/src/bindings.hpp>
#include <python/src/python_error.hpp>

namespace motionrack::python {

namespace {

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;
/// A line: its name, its style ("x" .. "d") and its values.
using Line = std::tuple<std::string, std::string, Floats>;
/// A chart: its title and its lines.
using Chart = std::tuple<std::string, std::vector<Line>>;

std::string timeline(const std::string& title, const Doubles& seconds, const std::vector<Chart>& charts,
                     const std::vector<std::tuple<std::string, double, double>>& spans, int width, int height) {
    const std::span<const double> time(seconds.data(), static_cast<std::size_t>(seconds.size()));
    std::vector<trace::SvgChart> drawn;
    for (const auto& [name, lines] : charts) {
        trace::SvgChart& chart = drawn.emplace_back(trace::SvgChart{name, {}, {}});
        for (const auto& [line, style, values] : lines) {
            if (values.size() != seconds.size())
                refuse("Every line of a picture must have one value per instant. Nothing was drawn.");
            chart.series.push_back({line, style, time, {values.data(), static_cast<std::size_t>(values.size())}});
        }
    }
    std::vector<trace::SvgSpan> bands;
    for (const auto& [name, from, to] : spans) bands.push_back({name, from, to});
    if (width < 100 || width > 10'000 || height < 100 || height > 10'000)
        refuse("Width and height must be 100 to 10000 pixels; nothing was drawn.");
    return trace::svg_timeline(title, drawn, bands, {.width = width, .height = height, .standalone = true});
}

}  // namespace

void bind_pictures(py::module_& m) {
    m.def("svg_timeline", &timeline, py::arg("title"), py::arg("seconds"), py::arg("charts"), py::arg("spans"),
          py::arg("width"), py::arg("height"));
}

}  // namespace motionrack::python
