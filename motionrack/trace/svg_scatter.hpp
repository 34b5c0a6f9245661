// Results over what they depend on: dots, joined where there is an order, and maps of two numbers.
//
//   time ^  o                     y  | [2.1][2.4][2.9]   cells where every x has every y,
//        |    `o-.               ^   | [1.8][2.0][2.2]   else dots; the colour is the value
//        |  x     `o---o         |   | [1.7][1.8][2.0]
//        +--------------> x          +---------------> x    x: it did not end well
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
    std::string name;  ///< empty: not named in the picture
    std::string look;  ///< as of SvgSeries
    std::vector<SvgDot> dots;
    bool joined = false;  ///< by lines, in the order of x, up to dots that are bad
};

struct SvgScatter {
    std::string title, x_name;
    std::vector<std::string> x_names;  ///< of x = 0, 1, 2 ..; none: x is a number
    std::vector<SvgDots> series;
};

/// Dots with a y that is not finite stand at the bottom. At most `max_dots` of each series are drawn.
std::string svg_scatter(const SvgScatter& scatter, const SvgLook& look = {});
inline constexpr std::size_t max_dots = 3000;

struct SvgSpot {
    double x = 0, y = 0, value = 0;
    bool bad = false;  ///< grey, with a cross
};

struct SvgMap {
    std::string title, x_name, y_name;
    std::vector<SvgSpot> spots;
};

/// At most `max_dots` spots are drawn, where they are no cells.
std::string svg_map(const SvgMap& map, const SvgLook& look = {});

}  // namespace motionrack::trace
