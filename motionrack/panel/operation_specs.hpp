// Operation specs: commands and queries, their fields, and the required roles. They are the single source of checks,
// OpenAPI, the reference page, HTTP routes and WebSocket commands.
#pragma once

#include <cstdint>
#include <motionrack/auth/role.hpp>
#include <motionrack/base/result.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

namespace motionrack::panel {

enum class ParameterType : std::uint8_t {
    number,
    integer,
    text,
    choice,  ///< a text, one of `words`
    flag,
    texts,   ///< a list of texts
    numbers  ///< an object of whole numbers by name
};

struct FieldSpec {
    std::string_view name;
    ParameterType type = ParameterType::number;
    bool required = true;
    double min = 0, max = 0;  ///< limits of numbers; for texts, lists and objects limits of their length
    std::string_view unit;    ///< "mm or degrees", "s"
    std::string_view words;   ///< choice: "real|unthrottled|paused"
    std::string_view text;    ///< one line
    bool or_null = false;     ///< JSON's null is also accepted
};

/// A command or a query.
struct OperationSpec {
    std::string_view name;
    auth::Role role = auth::Role::observe;
    bool lease = false;  ///< the caller must hold the control lease
    std::span<const FieldSpec> fields;
    std::string_view text;        ///< one sentence
    std::string_view gives = {};  ///< members of the answer besides "done"
    bool external = false;        ///< executed by PanelSettings::external
    bool high_rate = false;       ///< repeated many times per second: no event, no journal
};

std::span<const OperationSpec> commands();
std::span<const OperationSpec> queries();
/// Searches both tables; returns nullptr if the name is unknown.
const OperationSpec* find_row(std::string_view name);
/// Returns a message about a name that find_row does not know; it gives the present name of a renamed operation.
/// `kind`: "command", "query".
std::string unknown_operation(std::string_view kind, std::string_view name);

/// Checks the fields of a request against its spec. Errors: invalid_input if `fields` is not an object, or names the
/// field that is unknown, missing or wrong.
Result<void> check_fields(const OperationSpec& row, const nlohmann::json& fields);

/// Converts a query's texts (HTTP) to fields: numbers and flags by their specs. Errors: invalid_input.
Result<nlohmann::json> fields_of_texts(const OperationSpec& row,
                                       const std::vector<std::pair<std::string, std::string>>& texts);

/// Reference page (Markdown) and OpenAPI description.
std::string api_reference();
const nlohmann::json& openapi();

}  // namespace motionrack::panel
