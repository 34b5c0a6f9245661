// Style of an SVG element, as far as it affects the drawing: visibility, and properties that would change its lines.
#pragma once

#include <optional>
#include <pugixml.hpp>
#include <string_view>
#include <vector>

namespace motionrack::mark {

/// Returns the value of a property from the element's style, else from its attribute, trimmed. Empty: neither is set.
std::string_view property(const pugi::xml_node& node, std::string_view name);

/// A property that would change the lines of a drawing but is not supported.
struct Unsupported {
    std::string_view name;
    bool in_style = false;  ///< set in the style of the element, else as an attribute
};
std::optional<Unsupported> unsupported(const pugi::xml_node& node);

/// Returns the first property of a style sheet that affects visibility or lines; empty: none.
std::string_view deciding_property(std::string_view sheet);

/// Visibility of an element whose parent has the visibility `inherited`.
struct Visibility {
    bool displayed = true;  ///< the element with its content
    bool visible = true;
};
Visibility visibility_of(const pugi::xml_node& node, bool inherited);

/// Returns the element's name if it is in the SVG namespace, with any prefix; empty: another namespace.
std::string_view svg_name(const pugi::xml_node& node);

}  // namespace motionrack::mark
