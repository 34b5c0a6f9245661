// What an element of an SVG file says of its look, as far as it changes what is drawn: whether it shows, and what would
// change its lines.
#pragma once

#include <optional>
#include <pugixml.hpp>
#include <string_view>
#include <vector>

namespace motionrack::mark {

/// The value of a property: the declaration in the element's style, else its attribute of that name; without blanks
/// around. Empty: neither.
std::string_view property(const pugi::xml_node& node, std::string_view name);

/// Something that would change the lines of a drawing and is not drawn here.
struct Unsupported {
    std::string_view name;
    bool in_style = false;  ///< of the element, else its attribute
};
std::optional<Unsupported> unsupported(const pugi::xml_node& node);

/// The first property in a style sheet's text that decides what shows or where its lines are; empty: none.
std::string_view deciding_property(std::string_view sheet);

/// Whether the element shows, its parent's visibility being `inherited`.
struct Showing {
    bool displayed = true;  ///< it and what is in it
    bool visible = true;
};
Showing showing(const pugi::xml_node& node, bool inherited);

/// The element's name if it is one of SVG, whatever prefix the file has for SVG; empty: it is of another language.
std::string_view svg_name(const pugi::xml_node& node);

}  // namespace motionrack::mark
