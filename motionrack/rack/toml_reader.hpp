// TOML reader with types, units, ranges and locations. A text becomes a small tree. A single table of fields describes
// each key for reading, range checks, templates and reference pages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <motionrack/base/result.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace motionrack::rack {

// ---- The tree

enum class TomlType : std::uint8_t { table, text, integer, number, flag, array, date };

/// A key with its value; tables keep their entries in the order of the file.
struct TomlNode {
    std::string key;
    TextPosition key_location;    ///< location of the key or of the table's header
    TextPosition value_location;  ///< location of the value's first character
    TomlType type = TomlType::table;
    std::string text;
    std::int64_t integer = 0;
    double number = 0;  ///< NaN and infinity are possible here; fields reject them
    bool flag = false;
    std::vector<TomlNode> children;  ///< entries of a table, or values of an array (without keys)

    /// Returns the entry of that name, or nullptr.
    const TomlNode* find(std::string_view name) const;
    /// Location of that entry's value; location of this node if the entry is missing.
    TextPosition location_of(std::string_view name) const;
};

/// Limits of file size and nesting.
inline constexpr std::size_t max_toml_bytes = 1'000'000;
inline constexpr int max_toml_depth = 16;

/// Reads TOML 1.0. Never throws and never overruns the stack, for any text. `file` is used in errors only. Errors: more
/// than `max_toml_bytes`, nesting deeper than `max_toml_depth`, syntax (with its location).
Result<TomlNode> parse_toml(std::string_view text, std::string_view file);

/// "text", "whole number", "table" ...: the type's name in a sentence.
std::string_view type_name(TomlType type);

// ---- Problems

/// Collects all errors of one file, so that the user sees them together.
class Problems {
  public:
    explicit Problems(std::string file) : file_(std::move(file)) {}
    void error(TextPosition location, std::string message) { add(errors_, location, std::move(message)); }
    void warn(TextPosition location, std::string message) { add(warnings_, location, std::move(message)); }
    bool any_errors() const { return !errors_.empty(); }
    /// Returns false once the list exceeds the displayed length; hints, which cost time, are unnecessary then.
    bool wants_hints() const { return errors_.size() < max_listed; }
    /// Returns the errors sorted by location: at most `max_listed`, then one sentence with the number of further ones.
    std::vector<Error> take_errors() { return take(errors_); }
    std::vector<Error> take_warnings() { return take(warnings_); }

    static constexpr std::size_t max_listed = 200;

  private:
    void add(std::vector<Error>& list, TextPosition location, std::string message);
    std::vector<Error> take(std::vector<Error>& list);
    std::string file_;
    std::vector<Error> errors_;
    std::vector<Error> warnings_;
};

/// Formats an external text for a message: without control characters, cut after `max_bytes` bytes.
std::string printable(std::string_view text, std::size_t max_bytes);
/// Quotes the user's text for a message: printable, cut after 60 bytes.
std::string in_quotes(std::string_view text);

/// Returns "; did you mean 'max_limit_mm'?" if a candidate is close to `text` (edit distance), else an empty string.
std::string did_you_mean(std::string_view text, std::span<const std::string_view> candidates);

/// Formats a number as the shortest text that reads back to the same double.
std::string number_text(double value);

// ---- Fields

/// Value of a field; monostate: absent (optional fields only). Choices are stored by name.
using FieldValue = std::variant<std::monostate, bool, std::int64_t, double, std::string>;

enum class FieldType : std::uint8_t { flag, integer, number, text, choice };

/// Description of one key for the reader, the template and the reference page. In `key` and `unit`, "{u}" stands for
/// the section's own unit (mm for a linear axis, deg for a rotary one).
struct Field {
    std::string_view key;
    FieldType type = FieldType::number;
    double min = 0;  ///< minimum value, or minimum length of a text
    double max = 0;  ///< maximum value, or maximum length of a text (bytes)
    std::string_view unit;
    std::string_view doc;  ///< one sentence without a full stop
    std::span<const std::string_view> choices = {};
    std::string_view only = {};         ///< section unit to which the key is limited ("mm", "deg"); empty: all
    bool lines = false;                 ///< a text that may contain line ends
    bool required = false;              ///< the key must be present
    bool optional = false;              ///< may be absent; `default_doc` describes the effect
    std::string_view default_doc = {};  ///< replaces the default in pages if it has no value
    std::string_view old_key = {};      ///< name of the key in earlier versions; empty: the same
    FieldValue (*get)(const void* object, const Field& field) = nullptr;
    void (*set)(void* object, const FieldValue& value, const Field& field) = nullptr;
};

namespace detail {

template <class T>
struct Member;
template <class Object, class T>
struct Member<T Object::*> {
    using object = Object;
    using type = T;
};

template <class T>
struct OptionalTraits {
    using type = T;
    static constexpr bool optional = false;
};
template <class T>
struct OptionalTraits<std::optional<T>> {
    using type = T;
    static constexpr bool optional = true;
};

std::size_t choice_index(const Field& field, const FieldValue& value);

template <class T>
FieldValue to_value(const T& member, const Field& field) {
    if constexpr (std::is_enum_v<T>) {
        return std::string(field.choices[static_cast<std::size_t>(member)]);
    } else if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>) {
        return static_cast<std::int64_t>(member);
    } else {
        return member;
    }
}

template <auto member>
FieldValue get_member(const void* object, const Field& field) {
    using M = Member<decltype(member)>;
    const auto& value = static_cast<const typename M::object*>(object)->*member;
    if constexpr (OptionalTraits<typename M::type>::optional) {
        return value ? to_value(*value, field) : FieldValue{};
    } else {
        return to_value(value, field);
    }
}

template <auto member>
void set_member(void* object, const FieldValue& value, const Field& field) {
    using M = Member<decltype(member)>;
    using T = typename OptionalTraits<typename M::type>::type;
    auto& target = static_cast<typename M::object*>(object)->*member;
    if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, double> || std::is_same_v<T, std::string>) {
        target = std::get<T>(value);
    } else if constexpr (std::is_enum_v<T>) {
        target = static_cast<T>(choice_index(field, value));
    } else {
        target = static_cast<T>(std::get<std::int64_t>(value));
    }
}

template <class T>
constexpr FieldType field_type() {
    if (std::is_same_v<T, bool>) return FieldType::flag;
    if (std::is_enum_v<T>) return FieldType::choice;
    if (std::is_same_v<T, double>) return FieldType::number;
    return std::is_integral_v<T> ? FieldType::integer : FieldType::text;
}

}  // namespace detail

/// Declares the key that is read into `member` (a pointer to a bool, integer, double, enum, std::string or an optional
/// of those). Enums need `choices` in the order of their values, from 0; texts may have choices.
template <auto member>
constexpr Field field(std::string_view key, double min, double max, std::string_view unit, std::string_view doc) {
    using Traits = detail::OptionalTraits<typename detail::Member<decltype(member)>::type>;
    Field out;
    out.key = key;
    out.type = detail::field_type<typename Traits::type>();
    out.min = min;
    out.max = max;
    out.unit = unit;
    out.doc = doc;
    out.optional = Traits::optional;
    out.get = &detail::get_member<member>;
    out.set = &detail::set_member<member>;
    return out;
}

constexpr Field formerly(std::string_view old_key, Field f) {
    return f.old_key = old_key, f;
}
constexpr Field with_choices(Field f, std::span<const std::string_view> choices) {
    f.type = FieldType::choice;
    f.choices = choices;
    return f;
}
constexpr Field only_in(Field f, std::string_view unit) {
    return f.only = unit, f;
}
constexpr Field with_lines(Field f) {
    return f.lines = true, f;
}
constexpr Field required(Field f, std::string_view instead) {
    return f.required = true, f.default_doc = instead, f;
}
constexpr Field absent_means(Field f, std::string_view meaning) {
    return f.default_doc = meaning, f;
}

/// Returns `text` with "{u}" replaced by `unit`.
std::string with_unit(std::string_view text, std::string_view unit);
/// Returns the permitted values of the field: "0.001 .. 1000 mm", "linear or rotary", "true or false".
std::string range_text(const Field& field, std::string_view unit);
/// Returns the default as written in a file, or its substitute ("required", "none").
std::string default_text(const Field& field, const void* defaults);
/// Formats a value as TOML.
std::string toml_text(const FieldValue& value);

/// A key read elsewhere whose name was another in earlier versions.
struct FormerKey {
    std::string_view old_key, key;  ///< with "{u}" as in Field
};

/// One table of a file, as input of read_fields.
struct Section {
    std::string name;                             ///< for messages: "axis X"
    std::string unit;                             ///< for "{u}": "mm", "deg" or empty
    std::string kind;                             ///< noun in messages about keys of other units: "a linear axis"
    std::span<const std::string_view> also = {};  ///< further permitted keys (read elsewhere)
    std::span<const FormerKey> former = {};       ///< former names of those
};

/// Reads every field of `table` into `object` (of the type that the fields were declared for). Missing or wrong values
/// leave the member unchanged; each wrong, unknown or missing key is one error. Returns the `key` of each field that
/// was rejected, or missing though required.
std::vector<std::string_view> read_fields(const TomlNode& table, std::span<const Field> fields, void* object,
                                          const Section& section, Problems& problems);

}  // namespace motionrack::rack
