// Typed reading of one table: types, ranges and unknown keys, with a sentence for each error.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::rack {

const TomlNode* TomlNode::find(std::string_view name) const {
    for (const TomlNode& child : children) {
        if (child.key == name) return &child;
    }
    return nullptr;
}

TextPosition TomlNode::location_of(std::string_view name) const {
    const TomlNode* child = find(name);
    return child != nullptr ? child->value_location : key_location;
}

std::string_view type_name(TomlType type) {
    static constexpr std::array<std::string_view, 7> names = {"a table",       "a text",   "a whole number", "a number",
                                                              "true or false", "an array", "a date or time"};
    return names[static_cast<std::size_t>(type)];
}

void Problems::add(std::vector<Error>& list, TextPosition location, std::string message) {
    list.push_back(Error{ErrorKind::invalid_input, std::move(message), file_, location});
}

std::vector<Error> Problems::take(std::vector<Error>& list) {
    std::stable_sort(list.begin(), list.end(), [](const Error& a, const Error& b) {
        return a.location.line != b.location.line ? a.location.line < b.location.line
                                                  : a.location.column < b.location.column;
    });
    if (list.size() > max_listed) {
        const std::size_t more = list.size() - max_listed;
        list.resize(max_listed);
        const TextPosition last = list.back().location;
        list.push_back(Error{ErrorKind::invalid_input,
                             fmt::format("and {} more; correct the first ones and try again.", more), file_, last});
    }
    return std::exchange(list, {});
}

std::string printable(std::string_view text, std::size_t max_bytes) {
    std::string out;
    std::size_t end = text.size();
    if (end > max_bytes) {
        end = max_bytes;
        while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // not inside a character
    }
    for (const char c : text.substr(0, end)) {
        const auto byte = static_cast<unsigned char>(c);
        out += byte < 0x20 || byte == 0x7F ? '?' : c;
    }
    return end < text.size() ? out + "..." : out;
}

std::string in_quotes(std::string_view text) {
    return fmt::format("'{}'", printable(text, 60));
}

namespace {

/// Number of edits (insert, delete, replace, swap neighbours) between a and b.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) above[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replace = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({replace, above[j] + 1, row[j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                row[j] = std::min(row[j], before[j - 2] + 1);
            }
        }
        std::swap(before, above);
        std::swap(above, row);
    }
    return above[b.size()];
}

std::string lower(std::string_view text) {
    std::string out(text);
    for (char& c : out) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return out;
}

/// Formats small numbers without an exponent if the digits stay the same.
std::string small_number_text(double value) {
    const std::string exact_text = fmt::format("{}", value);
    for (int digits = 5; digits <= 12 && std::fabs(value) < 1e-4; ++digits) {
        const std::string plain = fmt::format("{:.{}f}", value, digits);
        double back = 0;
        std::from_chars(plain.data(), plain.data() + plain.size(), back);
        if (back == value) return plain;
    }
    return exact_text;
}

}  // namespace

std::string did_you_mean(std::string_view text, std::span<const std::string_view> candidates) {
    if (text.empty() || text.size() > 64) return {};
    const std::string small = lower(text);
    std::size_t best = std::max<std::size_t>(2, text.size() / 3) + 1;
    std::string_view nearest;
    for (const std::string_view candidate : candidates) {
        const std::size_t distance = edit_distance(small, lower(candidate));
        // A name in which every letter would change is not close.
        if (distance < best && distance < candidate.size()) {
            best = distance;
            nearest = candidate;
        }
    }
    return nearest.empty() ? std::string() : fmt::format("; did you mean '{}'?", nearest);
}

std::string number_text(double value) {
    if (std::isnan(value)) return "nan";
    if (std::isinf(value)) return value < 0 ? "-inf" : "inf";
    if (value == std::floor(value) && std::fabs(value) < 1e15) return fmt::format("{:.0f}", value + 0.0);
    return small_number_text(value);
}

std::size_t detail::choice_index(const Field& field, const FieldValue& value) {
    const auto found = std::find(field.choices.begin(), field.choices.end(), std::get<std::string>(value));
    MOTIONRACK_ASSERT(found != field.choices.end());
    return static_cast<std::size_t>(found - field.choices.begin());
}

std::string with_unit(std::string_view text, std::string_view unit) {
    std::string out(text);
    for (std::size_t at = out.find("{u}"); at != std::string::npos; at = out.find("{u}")) out.replace(at, 3, unit);
    return out;
}

std::string range_text(const Field& field, std::string_view unit) {
    switch (field.type) {
        case FieldType::flag:
            return "true or false";
        case FieldType::text:
            if (field.min == field.max) return fmt::format("a text of {} byte{}", field.min, field.max == 1 ? "" : "s");
            return fmt::format("a text of {} .. {} bytes", field.min, field.max);
        case FieldType::choice: {
            std::string out;
            for (std::size_t i = 0; i < field.choices.size(); ++i) {
                if (i > 0) out += i + 1 == field.choices.size() ? " or " : ", ";
                out += field.choices[i];
            }
            return out;
        }
        case FieldType::integer:
        case FieldType::number:
            break;
    }
    std::string out = field.min == field.max ? "only " + number_text(field.min)
                                             : number_text(field.min) + " .. " + number_text(field.max);
    if (field.unit.empty()) return out;
    return fmt::format("{} {}", out, with_unit(field.unit, unit));
}

std::string toml_text(const FieldValue& value) {
    if (const bool* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
    if (const auto* integer = std::get_if<std::int64_t>(&value)) return std::to_string(*integer);
    if (const double* number = std::get_if<double>(&value)) return number_text(*number);
    const auto* text = std::get_if<std::string>(&value);
    if (text == nullptr) return "none";
    std::string out = "\"";
    for (const char c : *text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + '"';
}

std::string default_text(const Field& field, const void* defaults) {
    return field.default_doc.empty() ? toml_text(field.get(defaults, field)) : std::string(field.default_doc);
}

namespace {

/// Reads one value; every mistake is one error at its location.
class FieldReader {
  public:
    FieldReader(const Field& field, const TomlNode& node, const Section& section, Problems& problems)
        : field_(field), node_(node), section_(section), problems_(problems) {}

    /// Returns false if the value was rejected.
    bool read_into(void* object) {
        const FieldValue value = read();
        if (std::holds_alternative<std::monostate>(value)) return false;
        field_.set(object, value, field_);
        return true;
    }

  private:
    FieldValue read() {
        switch (field_.type) {
            case FieldType::flag:
                if (node_.type == TomlType::flag) return node_.flag;
                break;
            case FieldType::integer:
            case FieldType::number:
                if (node_.type == TomlType::integer || node_.type == TomlType::number) return read_number();
                break;
            case FieldType::text:
            case FieldType::choice:
                if (node_.type == TomlType::text) return read_text();
                break;
        }
        refuse(fmt::format("is {}, but must be {}: {}", type_name(node_.type), wanted(), range()));
        return {};
    }

    std::string_view wanted() const {
        static constexpr std::array<std::string_view, 5> names = {
            "true or false without quotes", "a whole number", "a number", "in quotes", "one of these texts, in quotes"};
        return names[static_cast<std::size_t>(field_.type)];
    }

    FieldValue read_number() {
        const bool whole_given = node_.type == TomlType::integer;
        const double value = whole_given ? static_cast<double>(node_.integer) : node_.number;
        const std::string seen = whole_given ? std::to_string(node_.integer) : number_text(value);
        if (!std::isfinite(value)) {
            refuse(fmt::format("is {}, which is not a finite number; the range is {}", seen, range()));
        } else if (value < field_.min || value > field_.max) {
            const bool one_value = field_.min == field_.max;
            refuse(fmt::format("is {}, {} {}", seen, one_value ? "but it can be" : "outside its range", range()));
        } else if (field_.type == FieldType::number) {
            return value;
        } else if (value != std::floor(value)) {
            refuse(fmt::format("is {}, but must be a whole number in {}", seen, range()));
        } else {
            return whole_given ? node_.integer : static_cast<std::int64_t>(value);
        }
        return {};
    }

    FieldValue read_text() {
        if (field_.type == FieldType::choice) {
            if (std::find(field_.choices.begin(), field_.choices.end(), node_.text) != field_.choices.end())
                return node_.text;
            refuse(fmt::format("is {}, but must be {}{}", in_quotes(node_.text), range(),
                               did_you_mean(node_.text, field_.choices)));
            return {};
        }
        const auto length = static_cast<double>(node_.text.size());
        if (length < field_.min || length > field_.max) {
            refuse(fmt::format("is {}, {} bytes long, but must be {}", in_quotes(node_.text), length, range()));
        } else if (std::any_of(node_.text.begin(), node_.text.end(), [&](char c) {
                       return static_cast<unsigned char>(c) < 0x20 && !(field_.lines && c == '\n');
                   })) {
            refuse(fmt::format("is {}, with a line end or control character in it, which names cannot have",
                               in_quotes(node_.text)));
        } else {
            return node_.text;
        }
        return {};
    }

    std::string range() const { return range_text(field_, section_.unit); }

    void refuse(const std::string& what) {
        const std::string stop = what.back() == '?' ? "" : ".";
        problems_.error(node_.value_location,
                        fmt::format("{} of {} {}{}", with_unit(field_.key, section_.unit), section_.name, what, stop));
    }

    const Field& field_;
    const TomlNode& node_;
    const Section& section_;
    Problems& problems_;
};

/// Returns the error sentence for an unknown key of `section`.
std::string unknown_key(const std::string& key, std::span<const Field> fields, const Section& section,
                        std::span<const std::string_view> known) {
    const auto is_now = [&](std::string_view present) {
        return fmt::format("{} is now {}.", in_quotes(key), in_quotes(with_unit(present, section.unit)));
    };
    for (const FormerKey& former : section.former)
        if (key == with_unit(former.old_key, section.unit)) return is_now(former.key);
    for (const Field& field : fields) {
        if (!field.old_key.empty() && key == with_unit(field.old_key, section.unit)) return is_now(field.key);
        if (!field.only.empty() && field.only != section.unit && key == field.key) {
            return fmt::format("{} does not belong to {}, which is {}; the key means: {}.", field.key, section.name,
                               section.kind, field.doc);
        }
        for (const std::string_view unit : {"mm", "deg"}) {
            if (unit != section.unit && field.key.find("{u}") != std::string_view::npos &&
                key == with_unit(field.key, unit)) {
                return fmt::format("{} counts in {}, but {} is {}; write {} (in {}).", key, unit, section.name,
                                   section.kind, with_unit(field.key, section.unit),
                                   with_unit(field.unit, section.unit));
            }
        }
    }
    const std::string hint = did_you_mean(key, known);
    return fmt::format("{} has no key {}{}", section.name, in_quotes(key), hint.empty() ? std::string(".") : hint);
}

}  // namespace

std::vector<std::string_view> read_fields(const TomlNode& table, std::span<const Field> fields, void* object,
                                          const Section& section, Problems& problems) {
    std::vector<std::string_view> refused;
    std::vector<std::string> names;
    std::vector<const Field*> here;
    for (const Field& field : fields) {
        if (!field.only.empty() && field.only != section.unit) continue;
        here.push_back(&field);
        names.push_back(with_unit(field.key, section.unit));
    }
    std::vector<std::string_view> known(names.begin(), names.end());
    known.insert(known.end(), section.also.begin(), section.also.end());
    std::vector<bool> seen(here.size(), false);

    for (const TomlNode& node : table.children) {
        const auto found = std::find(known.begin(), known.end(), node.key);
        if (found == known.end()) {
            const bool hint = problems.wants_hints();
            problems.error(node.key_location,
                           hint ? unknown_key(node.key, fields, section, known) : in_quotes(node.key));
            continue;
        }
        const auto index = static_cast<std::size_t>(found - known.begin());
        if (index >= here.size()) continue;
        seen[index] = true;
        if (!FieldReader(*here[index], node, section, problems).read_into(object)) refused.push_back(here[index]->key);
    }
    for (std::size_t i = 0; i < here.size(); ++i) {
        if (here[i]->required && !seen[i]) {
            refused.push_back(here[i]->key);
            problems.error(table.key_location, fmt::format("{} has no {}: {} ({}).", section.name, names[i],
                                                           here[i]->doc, range_text(*here[i], section.unit)));
        }
    }
    return refused;
}

}  // namespace motionrack::rack
