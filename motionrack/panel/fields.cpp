// Checks requests against the operation specs: unknown, missing and wrong fields, each with a message.
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <motionrack/panel/operation_specs.hpp>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::panel {

namespace {

using nlohmann::json;

tl::unexpected<Error> wrong(const OperationSpec& row, std::string_view what) {
    return fail(ErrorKind::invalid_input, fmt::format("{} was not done: {}", row.name, what));
}

/// Returns true if the text is one of "a|b|c".
bool one_of(std::string_view words, std::string_view text) {
    for (;;) {
        const std::size_t bar = words.find('|');
        if (words.substr(0, bar) == text) return true;
        if (bar == std::string_view::npos) return false;
        words.remove_prefix(bar + 1);
    }
}

std::string range_of(const FieldSpec& field) {
    return fmt::format("{} to {}{}{}", field.min, field.max, field.unit.empty() ? "" : " ", field.unit);
}

Result<void> check_number(const OperationSpec& row, const FieldSpec& field, const json& value) {
    if (!value.is_number())
        return wrong(row,
                     fmt::format("{} must be a number ({}), not {}.", field.name, range_of(field), value.type_name()));
    const double number = value.get<double>();
    if (!std::isfinite(number) || number < field.min || number > field.max)
        return wrong(row, fmt::format("{} is {}; it must be {}.", field.name, number, range_of(field)));
    if (field.type == ParameterType::integer && number != std::floor(number))
        return wrong(row, fmt::format("{} is {}, but must be a whole number.", field.name, number));
    return {};
}

Result<void> check_text(const OperationSpec& row, const FieldSpec& field, const json& value) {
    if (!value.is_string()) return wrong(row, fmt::format("{} must be a text, not {}.", field.name, value.type_name()));
    const auto& text = value.get_ref<const std::string&>();
    if (static_cast<double>(text.size()) > field.max)
        return wrong(row, fmt::format("{} has {} characters; the limit is {}.", field.name, text.size(), field.max));
    return {};
}

/// Limit of whole numbers that a double holds exactly.
constexpr double max_whole = 9e15;

Result<void> check_numbers(const OperationSpec& row, const FieldSpec& field, const json& value) {
    if (!value.is_object())
        return wrong(
            row, fmt::format("{} must be an object of whole numbers by name, not {}.", field.name, value.type_name()));
    if (static_cast<double>(value.size()) > field.max)
        return wrong(row, fmt::format("{} has {} members; the limit is {}.", field.name, value.size(), field.max));
    for (const auto& [name, one] : value.items())
        if (!one.is_number() || one.get<double>() != std::floor(one.get<double>()) ||
            std::fabs(one.get<double>()) > max_whole)
            return wrong(row, fmt::format("{} of {} must be a whole number, not {}.", rack::in_quotes(name), field.name,
                                          one.is_number() ? "any number" : one.type_name()));
    return {};
}

Result<void> check_field(const OperationSpec& row, const FieldSpec& field, const json& value) {
    if (value.is_null() && field.or_null) return {};
    switch (field.type) {
        case ParameterType::number:
        case ParameterType::integer:
            return check_number(row, field, value);
        case ParameterType::text:
            return check_text(row, field, value);
        case ParameterType::choice:
            if (!value.is_string() || !one_of(field.words, value.get_ref<const std::string&>()))
                return wrong(row, fmt::format("{} must be one of {}.", field.name, field.words));
            return {};
        case ParameterType::flag:
            if (!value.is_boolean())
                return wrong(row, fmt::format("{} must be true or false, not {}.", field.name, value.type_name()));
            return {};
        case ParameterType::numbers:
            return check_numbers(row, field, value);
        case ParameterType::texts:
            if (!value.is_array())
                return wrong(row, fmt::format("{} must be a list of texts, not {}.", field.name, value.type_name()));
            if (static_cast<double>(value.size()) > field.max)
                return wrong(row,
                             fmt::format("{} has {} members; the limit is {}.", field.name, value.size(), field.max));
            for (const json& one : value)
                if (!one.is_string())
                    return wrong(row, fmt::format("{} must be a list of texts; one of them is {}.", field.name,
                                                  one.type_name()));
            return {};
    }
    return {};
}

}  // namespace

Result<void> check_fields(const OperationSpec& row, const json& fields) {
    if (!fields.is_object())
        return wrong(row, fmt::format("its fields must be a JSON object, not {}.", fields.type_name()));
    for (const auto& [name, value] : fields.items()) {
        const auto found = std::find_if(row.fields.begin(), row.fields.end(),
                                        [&name = name](const FieldSpec& field) { return field.name == name; });
        if (found == row.fields.end()) {
            std::string known;
            for (const FieldSpec& field : row.fields) known += (known.empty() ? "" : ", ") + std::string(field.name);
            return wrong(row, fmt::format("it has no field {}; it has: {}.", rack::in_quotes(name),
                                          known.empty() ? "none" : known));
        }
        MOTIONRACK_CHECK(check_field(row, *found, value));
    }
    for (const FieldSpec& field : row.fields)
        if (field.required && !fields.contains(field.name))
            return wrong(row, fmt::format("the field {} is missing: {}.", field.name, field.text));
    return {};
}

Result<json> fields_of_texts(const OperationSpec& row, const std::vector<std::pair<std::string, std::string>>& texts) {
    json fields = json::object();
    for (const auto& [name, text] : texts) {
        const auto found = std::find_if(row.fields.begin(), row.fields.end(),
                                        [&name = name](const FieldSpec& field) { return field.name == name; });
        const ParameterType type = found == row.fields.end() ? ParameterType::text : found->type;
        double number = 0;
        if (type == ParameterType::number || type == ParameterType::integer) {
            const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
            if (read.ec != std::errc{} || read.ptr != text.data() + text.size())
                return wrong(row, fmt::format("{} is {}, which is not a number.", name, rack::in_quotes(text)));
            fields[name] = number;
        } else if (type == ParameterType::flag && (text == "true" || text == "false")) {
            fields[name] = text == "true";
        } else if (type == ParameterType::texts) {
            json& list = fields[name] = json::array();
            for (std::size_t at = 0; at <= text.size();) {
                const std::size_t comma = std::min(text.find(',', at), text.size());
                if (comma > at) list.push_back(text.substr(at, comma - at));
                at = comma + 1;
            }
        } else {
            fields[name] = text;
        }
    }
    return fields;
}

}  // namespace motionrack::panel
