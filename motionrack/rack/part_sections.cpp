// Steps of reading that kinds of part share.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/rack/config_parts.hpp>
#include <motionrack/rack/part_catalogue.hpp>
#include <motionrack/rack/part_sections.hpp>

namespace motionrack::rack {

std::span<const Field> part_fields(std::string_view header) {
    const std::string title = fmt::format("[{}]", header);
    for (const PartKind* kind : part_kinds()) {
        if (kind->sections == nullptr) continue;
        for (const PartSection& section : kind->sections->sections)
            if (section.title.starts_with(title)) return section.fields();
    }
    return {};
}

bool is_name(std::string_view name) {
    const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
    const auto allowed = [&](char c) { return letter(c) || (c >= '0' && c <= '9'); };
    return !name.empty() && name.size() <= 32 && letter(name[0]) && std::all_of(name.begin(), name.end(), allowed);
}

bool is_free_name(const RackConfig& config, std::string_view name) {
    if (!is_name(name) || name == "estop" || name.size() == 1 || config.card(name) != nullptr) return false;
    for (const PartKind* kind : part_kinds()) {
        if (kind->sections == nullptr || kind->sections->names == nullptr) continue;
        const std::vector<std::string_view> names = kind->sections->names(config);
        if (std::find(names.begin(), names.end(), name) != names.end()) return false;
    }
    return true;
}

bool is_table(const TomlNode& node, const std::string& path, Problems& problems) {
    if (node.type == TomlType::table) return true;
    problems.error(node.value_location,
                   fmt::format("{} is {}, but must be a table; write [{}] on a line of its own and its keys below.",
                               path, type_name(node.type), path));
    return false;
}

bool PartReader::read(std::span<const Field> fields, void* object, std::span<const std::string_view> tables) {
    Section own = section_;
    own.also = tables;
    return read_fields(node_, fields, object, own, problems_).empty();
}

bool PartReader::read_table(const TomlNode& table, std::span<const Field> fields, void* object) {
    Section own = section_;
    own.name = fmt::format("{} of {}", table.key, section_.name);
    return is_table(table, own.name, problems_) && read_fields(table, fields, object, own, problems_).empty();
}

void PartReader::refuse_at(TextPosition location, const std::string& text) {
    problems_.error(location, fmt::format("{}: {}", subject_, text));
}

}  // namespace motionrack::rack
