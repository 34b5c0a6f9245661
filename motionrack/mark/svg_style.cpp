#include <algorithm>
#include <array>
#include <motionrack/mark/svg_style.hpp>
#include <string>

namespace motionrack::mark {

namespace {

constexpr std::array<std::string_view, 8> changing = {"clip-path", "mask",         "stroke-dasharray", "filter",
                                                      "marker",    "marker-start", "marker-mid",       "marker-end"};
constexpr std::array<std::string_view, 4> hiding = {"display", "visibility", "transform", "d"};
constexpr std::string_view svg_namespace = "http://www.w3.org/2000/svg";

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && text.front() <= ' ') text.remove_prefix(1);
    while (!text.empty() && text.back() <= ' ') text.remove_suffix(1);
    return text;
}

/// Calls `found(name, value)` for each declaration "name: value;" of a style.
template <class Found>
void declarations(std::string_view style, Found&& found) {
    while (!style.empty()) {
        const std::size_t end = std::min(style.find(';'), style.size());
        const std::string_view one = style.substr(0, end);
        if (const std::size_t colon = one.find(':'); colon != std::string_view::npos) {
            std::string_view value = one.substr(colon + 1);
            if (const std::size_t important = value.find('!'); important != std::string_view::npos)
                value = value.substr(0, important);
            found(trimmed(one.substr(0, colon)), trimmed(value));
        }
        style.remove_prefix(std::min(end + 1, style.size()));
    }
}

std::string_view in_style(const pugi::xml_node& node, std::string_view name) {
    std::string_view out;
    declarations(node.attribute("style").value(), [&](std::string_view key, std::string_view value) {
        if (key == name) out = value;
    });
    return out;
}

}  // namespace

std::string_view property(const pugi::xml_node& node, std::string_view name) {
    const std::string_view styled = in_style(node, name);
    return styled.empty() ? trimmed(node.attribute(std::string(name).c_str()).value()) : styled;
}

std::optional<Unsupported> unsupported(const pugi::xml_node& node) {
    for (const std::string_view name : changing) {
        const std::string_view value = property(node, name);
        if (!value.empty() && value != "none" && value != "inherit")
            return Unsupported{name, !in_style(node, name).empty()};
    }
    // A transform is supported as an attribute, but not as a style property.
    if (const std::string_view value = in_style(node, "transform"); !value.empty() && value != "none")
        return Unsupported{"transform", true};
    return std::nullopt;
}

std::string_view deciding_property(std::string_view sheet) {
    std::string_view out;
    while (!sheet.empty() && out.empty()) {
        const std::size_t open = sheet.find('{');
        if (open == std::string_view::npos) break;
        const std::size_t close = std::min(sheet.find('}', open), sheet.size());
        declarations(sheet.substr(open + 1, close - open - 1), [&](std::string_view key, std::string_view value) {
            const auto is_one = [&](const auto& list) {
                return std::find(list.begin(), list.end(), key) != list.end();
            };
            if (out.empty() && value != "none" && value != "inherit" && value != "inline" && value != "visible" &&
                (is_one(changing) || is_one(hiding)))
                out = key;
            if (out.empty() && key == "display" && value == "none") out = key;
        });
        sheet.remove_prefix(std::min(close + 1, sheet.size()));
    }
    return out;
}

Visibility visibility_of(const pugi::xml_node& node, bool inherited) {
    Visibility out;
    out.displayed = property(node, "display") != "none";
    const std::string_view visibility = property(node, "visibility");
    out.visible = visibility.empty() || visibility == "inherit" ? inherited : visibility == "visible";
    return out;
}

std::string_view svg_name(const pugi::xml_node& node) {
    const std::string_view name = node.name();
    const std::size_t colon = name.find(':');
    const std::string declared =
        colon == std::string_view::npos ? "xmlns" : "xmlns:" + std::string(name.substr(0, colon));
    for (pugi::xml_node at = node; at; at = at.parent()) {
        const std::string_view space = at.attribute(declared.c_str()).value();
        if (space.empty()) continue;
        // Some editors write the namespace as an entity.
        const bool svg = space == svg_namespace || space.front() == '&';
        return svg ? name.substr(colon == std::string_view::npos ? 0 : colon + 1) : std::string_view();
    }
    // Many drawings omit the declaration; an undeclared prefix is not SVG.
    return colon == std::string_view::npos ? name : std::string_view();
}

}  // namespace motionrack::mark
