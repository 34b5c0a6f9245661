// Rectangle of a picture that shows a part of the plane in mm, Y up: clips lines to it and simplifies them to visible
// detail.
#pragma once

#include <motionrack/mark/drawing.hpp>
#include <span>
#include <string>
#include <vector>

namespace motionrack::mark {

/// Point of a row of strokes.
struct StrokePoint {
    Spot at;
    bool first = false;  ///< a stroke starts here
};
std::vector<StrokePoint> nodes_of(std::span<const parts::DrawnSegment> segments);
std::vector<StrokePoint> nodes_of(std::span<const parts::MarkedPoint> points);

/// Returns the bounding box of both.
Box joined(const Box& a, const Box& b);
Box box_of(std::span<const StrokePoint> nodes);  ///< requires at least one node

class Plot {
  public:
    /// Shows `box` and its surroundings, centred in `width` x `height` px.
    Plot(const Box& box, int width, int height, double margin = 18);

    double x(double mm) const { return (mm - low_.x) * scale_; }
    double y(double mm) const { return height_ - (mm - low_.y) * scale_; }
    int width() const { return width_; }
    int height() const { return height_; }
    double width_mm() const { return width_ / scale_; }

    /// Returns grid lines at steps of 1, 2 or 5 times a power of ten, with labels in mm.
    std::string grid() const;
    std::string strokes(std::span<const StrokePoint> nodes, const char* style) const;
    std::string outline(const Box& box, const char* style) const;
    std::string line(Spot from, Spot to, const char* style) const;
    std::string ring(Spot at) const;
    std::string cross(Spot at, const std::string& title) const;
    std::string scale_bar() const;

  private:
    std::vector<StrokePoint> clipped(std::span<const StrokePoint> nodes) const;

    Spot low_;  // mm at the lower left corner
    int width_, height_;
    double scale_ = 1;  // px per mm
};

/// Formats a length in mm with a readable unit, such as "12 mm" or "40 µm".
std::string shown_length(double mm);

}  // namespace motionrack::mark
