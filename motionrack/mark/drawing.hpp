// Drawing to be marked: strokes of straight lines and circular arcs in mm, independent of the file format.
#pragma once

#include <cstddef>
#include <motionrack/base/result.hpp>
#include <motionrack/sim/parts/workpiece.hpp>
#include <vector>

namespace motionrack::mark {

using sim::Spot;

/// Element of a stroke from the end of the previous one: straight if `sweep` is 0, else an arc around `centre`.
struct Element {
    Spot to;
    Spot centre{};
    double sweep = 0;  ///< radians, counter-clockwise is positive
};

struct Stroke {
    Spot from;
    std::vector<Element> elements;
};

struct Drawing {
    std::vector<Stroke> strokes;
};

/// x' = a x + c y + e, y' = b x + d y + f.
struct Affine {
    double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;

    Spot operator()(Spot p) const { return {a * p.x + c * p.y + e, b * p.x + d * p.y + f}; }
    /// Returns the composition: first `first`, then this.
    Affine after(const Affine& first) const;
    double determinant() const { return a * d - b * c; }
    /// Returns true if circles remain circles.
    bool keeps_circles() const;
    /// Returns an upper bound of the factor by which a length grows.
    double max_scale() const;
};

inline constexpr double default_tolerance_mm = 0.001;
inline constexpr std::size_t max_elements = 1'000'000;

/// Draws figures in their own coordinates into a drawing in mm. Converts curves other than circular arcs to lines
/// within the tolerance.
class Pen {
  public:
    Pen(Drawing& drawing, double tolerance_mm) : drawing_(drawing), tolerance_(tolerance_mm) {}

    void use(const Affine& to_mm) { to_mm_ = to_mm; }
    void move_to(Spot p);
    void line_to(Spot p);
    void quadratic_to(Spot control, Spot p);
    void cubic_to(Spot control1, Spot control2, Spot p);
    /// Draws a part of the ellipse with radii rx, ry, rotated by `turn`, from angle `begin` over `sweep` (radians, from
    /// the ellipse's x to its y). Requires the pen at its start; `p` is its end.
    void ellipse_to(Spot centre, double rx, double ry, double turn, double begin, double sweep, Spot p);
    /// Closes the stroke.
    void close();
    Spot at() const { return at_; }
    /// Returns false if the drawing exceeds `max_elements` and was truncated.
    bool complete() const { return elements_ <= max_elements; }

  private:
    void add(const Element& element);

    Drawing& drawing_;
    double tolerance_;
    Affine to_mm_;
    Spot at_, begin_;
    bool down_ = false;
    std::size_t elements_ = 0;
};

/// Transforms a drawing; arcs stay arcs if circles remain circles, else become lines within the tolerance.
Drawing transformed(const Drawing& drawing, const Affine& transform, double tolerance_mm = default_tolerance_mm);
inline constexpr double fine_tolerance_mm = 0.0002;  ///< tolerance for the comparison of a drawing with its marks
/// Returns the drawing as straight segments, with arcs within the tolerance.
std::vector<parts::DrawnSegment> segments_of(const Drawing& drawing, double tolerance_mm = fine_tolerance_mm);
/// Returns the number of segments that segments_of() would return.
std::size_t segment_count(const Drawing& drawing, double tolerance_mm = fine_tolerance_mm);

struct Box {
    Spot low, high;
};
/// Returns the bounding box of all strokes; 0, 0 without strokes.
Box box_of(const Drawing& drawing);
double length_of(const Drawing& drawing);
std::size_t element_count(const Drawing& drawing);

}  // namespace motionrack::mark
