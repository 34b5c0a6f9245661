// What can be asked: orders and queries, their fields, and who may. The one declaration: checking, OpenAPI, the
// reference page, HTTP routes and WebSocket orders come from it.
#pragma once

#include <cstdint>
#include <motionrack/auth/role.hpp>
#include <motionrack/base/result.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

namespace motionrack::panel {

enum class FieldType : std::uint8_t {
    number,
    integer,
    text,
    choice,  ///< a text, one of `words`
    flag,
    texts,   ///< a list of texts
    numbers  ///< an object of whole numbers by their names
};

struct FieldSpec {
    std::string_view name;
    FieldType type = FieldType::number;
    bool required = true;
    double min = 0, max = 0;  ///< of numbers; of texts, lists and objects their greatest length
    std::string_view unit;    ///< "mm or degrees", "s"
    std::string_view words;   ///< choice: "real|free|paused"
    std::string_view text;    ///< one line
    bool or_null = false;     ///< JSON's null is taken, too
};

/// An order or a query.
struct OperationSpec {
    std::string_view name;
    auth::Role role = auth::Role::observe;
    bool lease = false;  ///< whoever asks must hold the control lease
    std::span<const FieldSpec> fields;
    std::string_view text;        ///< one sentence
    std::string_view gives = {};  ///< members of the answer besides "done"
    bool external = false;        ///< PanelSettings::elsewhere carries it out
    bool high_rate = false;       ///< repeated many times a second: no event, no journal
};

std::span<const OperationSpec> commands();
std::span<const OperationSpec> queries();
/// Of both tables; nullptr if there is none.
const OperationSpec* find_row(std::string_view name);

/// Errors: invalid_input; no object, an unknown, missing or wrong field; a sentence that names it.
Result<void> check_fields(const OperationSpec& row, const nlohmann::json& fields);

/// Fields from a query's texts (HTTP): numbers and flags read as their fields say. Errors: invalid_input.
Result<nlohmann::json> fields_of_texts(const OperationSpec& row,
                                       const std::vector<std::pair<std::string, std::string>>& texts);

/// The reference page (Markdown) and the OpenAPI description.
std::string api_reference();
const nlohmann::json& openapi();

}  // namespace motionrack::panel
