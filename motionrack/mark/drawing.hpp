// What is to be marked: strokes of straight lines and circular arcs in mm, whatever file they came from.
#pragma once

#include <cstddef>
#include <motionrack/base/result.hpp>
#include <motionrack/sim/parts/workpiece.hpp>
#include <vector>

namespace motionrack::mark {

using sim::Spot;

/// A piece of a stroke from where the last one ended: straight if `sweep` is 0, else about `centre`.
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
    /// First `first`, then this one.
    Affine after(const Affine& first) const;
    double determinant() const { return a * d - b * c; }
    /// Circles stay circles.
    bool keeps_circles() const;
    /// The greatest factor by which a length grows, or a little more.
    double max_scale() const;
};

inline constexpr double default_tolerance_mm = 0.001;
inline constexpr std::size_t max_elements = 1'000'000;

/// Draws: takes figures in their own coordinates and adds them to a drawing in mm. Curves that are no circular arcs
/// become lines within the tolerance.
class Pen {
  public:
    Pen(Drawing& drawing, double tolerance_mm) : drawing_(drawing), tolerance_(tolerance_mm) {}

    void use(const Affine& to_mm) { to_mm_ = to_mm; }
    void move_to(Spot p);
    void line_to(Spot p);
    void quadratic_to(Spot control, Spot p);
    void cubic_to(Spot control1, Spot control2, Spot p);
    /// The part of the ellipse with radii rx, ry, turned by `turn`, from the angle `begin` on for `sweep` (radians,
    /// from the ellipse's x to its y). The pen must stand at its begin; `p` is its end.
    void ellipse_to(Spot centre, double rx, double ry, double turn, double begin, double sweep, Spot p);
    /// Back to the begin of the stroke.
    void close();
    Spot at() const { return at_; }
    /// False: the drawing has more than `max_elements` and the rest was left out.
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

/// Everything moved; arcs stay arcs if the transform keeps circles, else they become lines within the tolerance.
Drawing transformed(const Drawing& drawing, const Affine& transform, double tolerance_mm = default_tolerance_mm);
inline constexpr double fine_tolerance_mm = 0.0002;  ///< of what marks are compared with
/// The drawing as straight pieces, arcs within the tolerance.
std::vector<parts::Segment> segments_of(const Drawing& drawing, double tolerance_mm = fine_tolerance_mm);
/// How many those are.
std::size_t segment_count(const Drawing& drawing, double tolerance_mm = fine_tolerance_mm);

struct Box {
    Spot low, high;
};
/// Of all strokes; 0, 0 if there are none.
Box box_of(const Drawing& drawing);
double length_of(const Drawing& drawing);
std::size_t element_count(const Drawing& drawing);

}  // namespace motionrack::mark
