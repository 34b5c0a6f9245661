// SVG drawings: outlines of path, line, polyline, polygon, rect, circle and ellipse, in groups with transforms.
//
// Millimetres: width or height in mm (cm, in, pt, pc, px = 1/96 in) together with a viewBox defines the user unit.
// Without a unit, a user unit is a millimetre. Y is converted to point up. Ignores fills, colours and widths; skips
// definitions, titles, editor-specific elements, and elements that are not displayed or not visible. Rejects any other
// visible content with its position: text (convert it to paths), use, image, nested svg, clipping, masks, dashes,
// markers, filters, percentages, and style sheets that set one of these.
#pragma once

#include <motionrack/mark/drawing.hpp>
#include <string>
#include <string_view>

namespace motionrack::mark {

inline constexpr std::size_t max_svg_bytes = 50'000'000;

/// Reads an SVG file. Errors: invalid_input, with line and column of the element or of the character in its data.
Result<Drawing> read_svg(std::string_view text, const std::string& file, double tolerance_mm = default_tolerance_mm);

/// Error in path data or a transform, with its character index.
struct DataError {
    std::size_t at = 0;
    std::string message;
};
/// Draws path data ("M 0 0 L 10 0 ..."). Supports all commands of SVG 1.1, absolute and relative.
tl::expected<void, DataError> draw_path(std::string_view data, Pen& pen);
/// Reads a transform attribute, such as "translate(1 2) rotate(30)".
tl::expected<Affine, DataError> read_transform(std::string_view data);

/// Reads numbers from attribute text.
class Scan {
  public:
    explicit Scan(std::string_view text) : text_(text) {}
    /// Skips blanks and one comma among them.
    void skip();
    bool done() const { return at_ >= text_.size(); }
    char peek() const { return done() ? '\0' : text_[at_]; }
    char take() { return text_[at_++]; }
    std::size_t at() const { return at_; }
    /// Returns true if a number starts here.
    bool number_next() const;
    /// Reads a finite number up to 1e9.
    tl::expected<double, DataError> number();
    tl::expected<bool, DataError> arc_flag();

  private:
    std::string_view text_;
    std::size_t at_ = 0;
};

}  // namespace motionrack::mark
