// Names, changes and lines of a TOML tree.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/rack/toml_edit.hpp>

namespace motionrack::rack {

namespace {

bool is_bare(std::string_view key) {
    return !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    });
}

std::string toml_quoted(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\')
            out.append(1, '\\').append(1, c);
        else if (byte < 0x20 || byte == 0x7F)
            out += fmt::format("\\u{:04X}", byte);
        else
            out += c;
    }
    return out + '"';
}

std::string key_text(std::string_view key) {
    return is_bare(key) ? std::string(key) : toml_quoted(key);
}

/// Writes whole numbers without a point, which every number field accepts.
std::string value_text(const TomlNode& node) {
    std::string out;
    switch (node.type) {
        case TomlType::text:
            return toml_quoted(node.text);
        case TomlType::integer:
            return std::to_string(node.integer);
        case TomlType::number:
            return number_text(node.number);
        case TomlType::flag:
            return node.flag ? "true" : "false";
        case TomlType::date:
            return "1970-01-01";  // no reader in this library accepts a date
        case TomlType::array:
            for (const TomlNode& child : node.children) out += (out.empty() ? "" : ", ") + value_text(child);
            return fmt::format("[{}]", out);
        case TomlType::table:
            for (const TomlNode& child : node.children)
                out += (out.empty() ? "" : ", ") + key_text(child.key) + " = " + value_text(child);
            return fmt::format("{{{}}}", out);
    }
    return out;
}

void add_lines(const TomlNode& table, const std::string& prefix, std::vector<TomlLine>& out) {
    for (const TomlNode& child : table.children) {
        const std::string name = prefix + key_text(child.key);
        if (child.type == TomlType::table && !child.children.empty())
            add_lines(child, name + '.', out);
        else
            out.push_back({name, value_text(child)});
    }
}

}  // namespace

std::vector<std::string> toml_path(std::string_view text) {
    std::vector<std::string> out;
    while (true) {
        const bool quotes = !text.empty() && text.front() == '"';
        if (quotes) text.remove_prefix(1);
        const std::size_t end = std::min(text.find(quotes ? '"' : '.'), text.size());
        if (end == 0 || (quotes && end == text.size())) return {};
        out.emplace_back(text.substr(0, end));
        if (!quotes && !is_bare(out.back())) return {};
        text.remove_prefix(end + (quotes ? 1 : 0));
        if (text.empty()) return out;
        if (text.front() != '.') return {};
        text.remove_prefix(1);
    }
}

std::string toml_name(std::span<const std::string> path) {
    std::string out;
    for (const std::string& key : path) out += (out.empty() ? "" : ".") + key_text(key);
    return out;
}

bool put_value(TomlNode& root, std::span<const std::string> path, const TomlNode& value) {
    TomlNode* at = &root;
    std::size_t depth = 0;
    const auto child_of = [](TomlNode& table, std::string_view key) {
        const auto found = std::find_if(table.children.begin(), table.children.end(),
                                        [&](const TomlNode& child) { return child.key == key; });
        return found == table.children.end() ? nullptr : &*found;
    };
    for (TomlNode* next = at; depth < path.size(); ++depth, at = next) {
        if (at->type != TomlType::table) return false;
        next = child_of(*at, path[depth]);
        if (next == nullptr) break;
    }
    if (depth == path.size() && at->type == TomlType::table) return false;
    for (; depth < path.size(); ++depth) {
        at->children.emplace_back().key = path[depth];
        at = &at->children.back();
    }
    std::string key = std::move(at->key);
    *at = value;
    at->key = std::move(key);
    return true;
}

std::vector<TomlLine> toml_lines(const TomlNode& root) {
    std::vector<TomlLine> out;
    add_lines(root, {}, out);
    return out;
}

std::string toml_of(std::span<const TomlLine> lines) {
    std::string out;
    for (const TomlLine& line : lines) out += line.name + " = " + line.value + "\n";
    return out;
}

}  // namespace motionrack::rack
