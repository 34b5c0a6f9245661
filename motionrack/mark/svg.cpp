// Reads the element tree of an SVG file: draws its elements with their transforms, and reports errors with positions.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <motionrack/base/trig.hpp>
#include <motionrack/mark/svg.hpp>
#include <motionrack/mark/svg_style.hpp>
#include <optional>
#include <pugixml.hpp>

namespace motionrack::mark {

namespace {

constexpr int max_groups = 64;
constexpr double max_scale = 1e9;
constexpr std::array<std::string_view, 13> passed_over = {
    "title",   "desc",   "metadata",       "defs",           "symbol", "clipPath", "mask",
    "pattern", "marker", "linearGradient", "radialGradient", "filter", "script"};

/// Properties inherited from the enclosing groups.
struct Around {
    Affine to_mm;
    bool visible = true;
    int depth = 1;
};

class SvgReader {
  public:
    SvgReader(std::string_view text, const std::string& file, Drawing& drawing, double tolerance)
        : text_(text), file_(file), pen_(drawing, tolerance) {}

    Result<void> read() {
        if (text_.size() > max_svg_bytes)
            return fail(ErrorKind::invalid_input,
                        fmt::format("{} bytes; a drawing may have at most {}. Nothing was marked.", text_.size(),
                                    max_svg_bytes),
                        {}, file_);
        pugi::xml_document document;
        const pugi::xml_parse_result parsed =
            document.load_buffer(text_.data(), text_.size(), pugi::parse_default, pugi::encoding_utf8);
        if (!parsed)
            return wrong(static_cast<std::size_t>(std::max<std::ptrdiff_t>(parsed.offset, 0)),
                         fmt::format("this is not XML: {}", parsed.description()));
        const pugi::xml_node root = document.document_element();
        if (svg_name(root) != "svg")
            return wrong(offset(root), fmt::format("the outermost element is '{}', not svg", short_of(root.name())));
        MOTIONRACK_TRY(const Affine to_mm, size_of(root));
        MOTIONRACK_CHECK(drawable(root));
        MOTIONRACK_CHECK(sheets(root, 0));
        const Visibility seen = visibility_of(root, true);
        for (const pugi::xml_node child : root.children())
            if (seen.displayed) MOTIONRACK_CHECK(element(child, {to_mm, seen.visible, 1}));
        return {};
    }

  private:
    tl::unexpected<Error> wrong(std::size_t at, const std::string& what) const {
        at = std::min(at, text_.size());
        const std::string_view before = text_.substr(0, at);
        const std::size_t line_begin = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
        const TextPosition location{static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1,
                                    static_cast<int>(at - line_begin) + 1};
        return fail(ErrorKind::invalid_input, what + ". Nothing was marked.", location, file_);
    }
    static std::string short_of(std::string_view text) {
        std::string out;
        for (const char c : text.substr(0, 40)) out += c >= ' ' && c < 127 ? c : '?';
        return out;
    }
    static std::size_t offset(const pugi::xml_node& node) {
        return static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0));
    }

    /// Returns the index of an attribute's value in the text; that of the element if the value is not found.
    std::size_t value_of(const pugi::xml_node& node, std::string_view name) const {
        const std::size_t begin = offset(node);
        char quote = '\0';
        std::size_t word = begin;
        for (std::size_t i = begin; i < text_.size(); ++i) {
            const char c = text_[i];
            if (quote != '\0') {
                if (c == quote) quote = '\0', word = i + 1;
            } else if (c == '"' || c == '\'') {
                std::string_view key = text_.substr(word, i - word);
                while (!key.empty() && (key.back() == '=' || key.back() <= ' ')) key.remove_suffix(1);
                while (!key.empty() && key.front() <= ' ') key.remove_prefix(1);
                if (key.size() >= name.size() && key.substr(key.size() - name.size()) == name &&
                    (key.size() == name.size() || key[key.size() - name.size() - 1] <= ' '))
                    return i + 1;
                quote = c;
            } else if (c == '>') {
                break;
            }
        }
        return begin;
    }
    tl::unexpected<Error> wrong_in(const pugi::xml_node& node, const char* attribute, const DataError& error) const {
        return wrong(value_of(node, attribute) + error.at,
                     fmt::format("{} of {}: {}", attribute, short_of(node.name()), error.message));
    }

    /// A length with its unit, as read by length(), which returns nullopt if the attribute is missing.
    struct Length {
        double value = 0;
        double mm = 0;  ///< mm per unit; 0: no unit given
    };
    Result<std::optional<Length>> length(const pugi::xml_node& node, const char* name) const {
        const pugi::xml_attribute attribute = node.attribute(name);
        if (!attribute) return std::optional<Length>{};
        Scan scan(attribute.value());
        scan.skip();
        const auto number = scan.number();
        if (!number) return wrong_in(node, name, number.error());
        std::string_view unit = std::string_view(attribute.value()).substr(scan.at());
        while (!unit.empty() && unit.back() <= ' ') unit.remove_suffix(1);
        static constexpr std::pair<std::string_view, double> units[] = {
            {"", 0}, {"mm", 1}, {"cm", 10}, {"in", 25.4}, {"pt", 25.4 / 72}, {"pc", 25.4 / 6}, {"px", 25.4 / 96}};
        for (const auto& [known, mm] : units)
            if (unit == known) return std::optional<Length>(Length{*number, mm});
        return wrong_in(
            node, name,
            {scan.at(), fmt::format("the unit '{}' is not known; mm, cm, in, pt, pc and px are", short_of(unit))});
    }
    /// Returns a length in user units, `otherwise` if the attribute is missing.
    Result<double> number(const pugi::xml_node& node, const char* name, double otherwise = 0) const {
        MOTIONRACK_TRY(const std::optional<Length> found, length(node, name));
        if (!found) return otherwise;
        return found->mm == 0 ? found->value : found->value * found->mm / unit_mm_;
    }

    /// Returns the transform from user units to mm, Y up, with the lower left corner of the picture at 0, 0. Sets
    /// unit_mm_, the mm of a user unit.
    Result<Affine> size_of(const pugi::xml_node& root) {
        MOTIONRACK_TRY(const std::optional<Length> width, length(root, "width"));
        MOTIONRACK_TRY(const std::optional<Length> height, length(root, "height"));
        double low_x = 0, low_y = 0, wide = width ? width->value : 0, high = height ? height->value : 0;
        unit_mm_ = width && width->mm > 0 ? width->mm : 1;
        if (const pugi::xml_attribute box = root.attribute("viewBox")) {
            Scan scan(box.value());
            for (double* value : {&low_x, &low_y, &wide, &high}) {
                scan.skip();
                const auto number = scan.number();
                if (!number) return wrong_in(root, "viewBox", number.error());
                *value = *number;
            }
            if (!(wide > 0 && high > 0)) return wrong_in(root, "viewBox", {0, "its width and height must be above 0"});
            const double by_width = width && width->mm > 0 ? width->value * width->mm / wide : 0;
            const double by_height = height && height->mm > 0 ? height->value * height->mm / high : 0;
            // The picture keeps its aspect ratio; the smaller scale applies.
            unit_mm_ = by_width > 0 && by_height > 0 ? std::min(by_width, by_height) : std::max(by_width, by_height);
            if (unit_mm_ == 0) unit_mm_ = 1;
        }
        if (!(unit_mm_ > 0)) return wrong(offset(root), "the drawing's width and height must be above 0");
        return Affine{unit_mm_, 0, 0, -unit_mm_, -low_x * unit_mm_, (low_y + high) * unit_mm_};
    }

    /// Rejects an element with a property that would change its lines but is not supported.
    Result<void> drawable(const pugi::xml_node& node) const {
        const std::optional<Unsupported> found = unsupported(node);
        if (!found) return {};
        const std::string what = found->in_style ? fmt::format("{} in a style", found->name) : std::string(found->name);
        return wrong(value_of(node, found->in_style ? std::string_view("style") : found->name),
                     fmt::format("{} of {}: this is not supported; make plain paths of it in the editor", what,
                                 short_of(node.name())));
    }
    /// Rejects a style sheet that could change the lines: selectors are not supported.
    Result<void> sheets(const pugi::xml_node& node, int depth) const {
        if (depth > max_groups) return {};
        for (const pugi::xml_node child : node.children()) {
            if (svg_name(child) == "style") {
                if (const std::string_view found = deciding_property(child.text().get()); !found.empty())
                    return wrong(offset(child),
                                 fmt::format("the style sheet sets {}, and style sheets are not supported; write it "
                                             "into the elements, or make plain paths in the editor",
                                             found));
            }
            MOTIONRACK_CHECK(sheets(child, depth + 1));
        }
        return {};
    }

    Result<void> element(const pugi::xml_node& node, const Around& around) {
        if (node.type() != pugi::node_element) return {};
        const std::string_view name = svg_name(node);
        if (name.empty() || name == "style" ||
            std::find(passed_over.begin(), passed_over.end(), name) != passed_over.end())
            return {};
        if (around.depth > max_groups)
            return wrong(offset(node), fmt::format("more than {} nested groups", max_groups));
        const Visibility seen = visibility_of(node, around.visible);
        if (!seen.displayed) return {};
        MOTIONRACK_CHECK(drawable(node));
        Affine to_mm = around.to_mm;
        if (const pugi::xml_attribute transform = node.attribute("transform")) {
            const auto own = read_transform(transform.value());
            if (!own) return wrong_in(node, "transform", own.error());
            to_mm = to_mm.after(*own);
            if (!(to_mm.max_scale() <= max_scale && std::fabs(to_mm.e) <= max_scale && std::fabs(to_mm.f) <= max_scale))
                return wrong_in(node, "transform", {0, "this and the groups around it make the drawing too large"});
        }
        if (name == "g" || name == "a") {
            for (const pugi::xml_node child : node.children())
                MOTIONRACK_CHECK(element(child, {to_mm, seen.visible, around.depth + 1}));
            return {};
        }
        if (!seen.visible) return {};
        pen_.use(to_mm);
        MOTIONRACK_CHECK(shape(node, name));
        if (!pen_.complete())
            return wrong(offset(node), fmt::format("the drawing has more than {} lines and arcs", max_elements));
        return {};
    }

    Result<void> shape(const pugi::xml_node& node, std::string_view name) {
        if (name == "path") {
            if (const auto done = draw_path(node.attribute("d").value(), pen_); !done)
                return wrong_in(node, "d", done.error());
            return {};
        }
        if (name == "polyline" || name == "polygon") return points(node, name == "polygon");
        if (name == "rect") return rect(node);
        if (name == "circle" || name == "ellipse") return round(node, name == "circle");
        if (name == "line") {
            std::array<double, 4> v{};
            static constexpr const char* names[] = {"x1", "y1", "x2", "y2"};
            for (std::size_t i = 0; i < 4; ++i) {
                MOTIONRACK_TRY(v[i], number(node, names[i]));
            }
            pen_.move_to({v[0], v[1]});
            pen_.line_to({v[2], v[3]});
            return {};
        }
        return wrong(offset(node),
                     fmt::format("the element '{}' is not supported; make a path of it in the editor", short_of(name)));
    }

    Result<void> points(const pugi::xml_node& node, bool closed) {
        Scan scan(node.attribute("points").value());
        bool first = true;
        for (scan.skip(); !scan.done(); scan.skip()) {
            const auto x = scan.number();
            if (!x) return wrong_in(node, "points", x.error());
            scan.skip();
            const auto y = scan.number();
            if (!y) return wrong_in(node, "points", y.error());
            first ? pen_.move_to({*x, *y}) : pen_.line_to({*x, *y});
            first = false;
        }
        if (closed && !first) pen_.close();
        return {};
    }

    Result<void> rect(const pugi::xml_node& node) {
        std::array<double, 4> v{};
        static constexpr const char* names[] = {"x", "y", "width", "height"};
        for (std::size_t i = 0; i < 4; ++i) {
            MOTIONRACK_TRY(v[i], number(node, names[i]));
        }
        if (v[2] < 0 || v[3] < 0) return wrong(offset(node), "a rect with a negative width or height");
        MOTIONRACK_TRY(double rx, number(node, "rx", -1));
        MOTIONRACK_TRY(double ry, number(node, "ry", -1));
        if (rx < 0) rx = std::max(ry, 0.0);
        if (ry < 0) ry = rx;
        rx = std::min(rx, v[2] / 2), ry = std::min(ry, v[3] / 2);
        const double x0 = v[0], y0 = v[1], x1 = x0 + v[2], y1 = y0 + v[3];
        const auto corner = [&](double cx, double cy, double begin, Spot to) {
            if (rx > 0 && ry > 0) pen_.ellipse_to({cx, cy}, rx, ry, 0, begin, pi / 2, to);
        };
        pen_.move_to({x0 + rx, y0});
        pen_.line_to({x1 - rx, y0});
        corner(x1 - rx, y0 + ry, -pi / 2, {x1, y0 + ry});
        pen_.line_to({x1, y1 - ry});
        corner(x1 - rx, y1 - ry, 0, {x1 - rx, y1});
        pen_.line_to({x0 + rx, y1});
        corner(x0 + rx, y1 - ry, pi / 2, {x0, y1 - ry});
        pen_.line_to({x0, y0 + ry});
        corner(x0 + rx, y0 + ry, pi, {x0 + rx, y0});
        pen_.close();
        return {};
    }

    Result<void> round(const pugi::xml_node& node, bool circle) {
        MOTIONRACK_TRY(const double x, number(node, "cx"));
        MOTIONRACK_TRY(const double y, number(node, "cy"));
        MOTIONRACK_TRY(const double rx, number(node, circle ? "r" : "rx"));
        MOTIONRACK_TRY(const double ry, number(node, circle ? "r" : "ry"));
        if (rx < 0 || ry < 0) return wrong(offset(node), "a radius below 0");
        if (rx == 0 || ry == 0) return {};
        pen_.move_to({x + rx, y});
        pen_.ellipse_to({x, y}, rx, ry, 0, 0, pi, {x - rx, y});
        pen_.ellipse_to({x, y}, rx, ry, 0, pi, pi, {x + rx, y});
        return {};
    }

    std::string_view text_;
    const std::string& file_;
    Pen pen_;
    double unit_mm_ = 1;
};

}  // namespace

Result<Drawing> read_svg(std::string_view text, const std::string& file, double tolerance_mm) {
    Drawing out;
    MOTIONRACK_CHECK(SvgReader(text, file, out, tolerance_mm).read());
    return out;
}

}  // namespace motionrack::mark
