// Results over their parameters: dots, joined if ordered, and maps over two numbers.
//
//  time ^  o                     y  | [2.1][2.4][2.9]   cells if every x has every y,
//        |    `o-.               ^   | [1.8][2.0][2.2]   else dots; the colour is the value
//        |  x     `o---o         |   | [1.7][1.8][2.0]
//       +--------------> x          +---------------> x    x: failed
#pragma once

#include <motionrack/trace/svg.hpp>
#include <string>
#include <vector>

namespace motionrack::trace {

struct SvgDot {
    double x = 0, y = 0;
    bool bad = false;  ///< drawn as a cross
};

struct SvgDots {
    std::string name;   ///< empty: not labelled
    std::string style;  ///< as in SvgSeries
    std::vector<SvgDot> dots;
    bool joined = false;  ///< joined by lines in the order of x, up to bad dots
};

struct SvgScatter {
    std::string title, x_name;
    std::vector<std::string> x_names;  ///< names of x = 0, 1, 2 ..; empty: x is a number
    std::vector<SvgDots> series;
};

/// Draws dots with a non-finite y at the bottom. Draws at most `max_dots` per series.
std::string svg_scatter(const SvgScatter& scatter, const SvgStyle& style = {});
inline constexpr std::size_t max_dots = 3000;

struct SvgSpot {
    double x = 0, y = 0, value = 0;
    bool bad = false;  ///< grey, with a cross
};

struct SvgMap {
    std::string title, x_name, y_name;
    std::vector<SvgSpot> spots;
};

/// Draws at most `max_dots` spots if they are not cells.
std::string svg_map(const SvgMap& map, const SvgStyle& style = {});

}  // namespace motionrack::trace
