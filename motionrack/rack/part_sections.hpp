// Sections of the rack file that describe parts: each kind has its tables of keys, and reads and checks its parts.
#pragma once

#include <array>
#include <cstddef>
#include <motionrack/rack/config.hpp>
#include <motionrack/rack/toml_reader.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace motionrack::rack {

/// A table of keys, with its heading in the reference page.
struct PartSection {
    std::string_view title;  ///< "[stage.NAME.scale]"
    std::string_view doc;    ///< paragraph below the title; may be empty
    /// A function, because a table that names types of card asks the catalogue for them.
    std::span<const Field> (*fields)();
    /// Returns the object of a part's defaults; a rotary part may have different ones.
    const void* (*defaults)(bool rotary);
    std::string (*doc_of_cards)() = nullptr;  ///< replaces `doc` if the paragraph names card types
};

/// The sections of a kind of part.
struct PartSections {
    std::span<const std::string_view> keys;  ///< at the top level of the file: "belt", "table"
    std::span<const PartSection> sections;
    /// Names of its parts that no other part may have; nullptr: its parts have no name of their own.
    std::vector<std::string_view> (*names)(const RackConfig& config);
    /// Reads the table of one key into the config and checks it against the cards and the parts before. nullptr: the
    /// reader of the file does.
    void (*read)(const TomlNode& table, RackConfig& config, Problems& problems);
};

extern const PartSections axis_sections;
extern const PartSections probe_sections;
extern const PartSections stage_sections;
extern const PartSections conveyor_sections;
extern const PartSections scanner_sections;
extern const PartSections lamp_sections;

/// Returns a table that names no type of card.
template <const auto& table>
std::span<const Field> rows_of() {
    return table;
}

/// Returns the table with `doc` as the description of row `key`, for descriptions that name card types.
template <std::size_t n>
std::array<Field, n> with_doc(std::array<Field, n> table, std::string_view key, std::string_view doc) {
    for (Field& field : table)
        if (field.key == key) field.doc = doc;
    return table;
}

/// Returns the defaults of a section for parts without other defaults for rotary ones.
template <class T>
const void* default_object(bool) {
    static const T object;
    return &object;
}

/// Returns the names of the parts in a list of the config.
template <auto list>
std::vector<std::string_view> names_in(const RackConfig& config) {
    std::vector<std::string_view> out;
    for (const auto& part : config.*list) out.push_back(part.name);
    return out;
}

/// Returns the keys of the section with that header, such as "axis.NAME.motor"; empty if no kind has it.
std::span<const Field> part_fields(std::string_view header);
/// Returns true if a part can have that name: 2 to 32 letters, digits and '_', and no card or other part has it.
bool is_free_name(const RackConfig& config, std::string_view name);

/// Reads the section of one part.
class PartReader {
  public:
    /// `section`: the part's name for messages ("belt line"), with its unit and kind. `subject`: begins the sentence
    /// about a conflict.
    PartReader(const TomlNode& node, Section section, std::string subject, Problems& problems)
        : node_(node), section_(std::move(section)), subject_(std::move(subject)), problems_(problems) {}

    const TomlNode& node() const { return node_; }
    const std::string& name() const { return section_.name; }
    /// Reads the part's own keys. `tables`: further entries of the section. Returns false after an error.
    bool read(std::span<const Field> fields, void* object, std::span<const std::string_view> tables = {});
    /// Reads a sub-table of the part's section. Returns false after an error.
    bool read_table(const TomlNode& table, std::span<const Field> fields, void* object);
    /// Reports a conflict at that key of the part's table, or of one of its tables.
    void refuse(std::string_view key, const std::string& text) { refuse(node_, key, text); }
    void refuse(const TomlNode& table, std::string_view key, const std::string& text) {
        refuse_at(table.location_of(key), text);
    }
    void refuse_at(TextPosition location, const std::string& text);

  private:
    const TomlNode& node_;
    Section section_;
    std::string subject_;
    Problems& problems_;
};

// ---- shared by belts, tables and scan heads

/// Reports a name that such a part cannot have; returns true for one that it can.
bool is_marking_name(const TomlNode& node, const RackConfig& config, Problems& problems);
/// Reports a card that does not exist or does not mark; returns true for one that does.
bool is_marking_card(const std::string& name, const RackConfig& config, PartReader& reader);

}  // namespace motionrack::rack
