// Writes the operation specs as an OpenAPI 3.0 description and as a Markdown page.
#include <fmt/format.h>

#include <motionrack/panel/answer.hpp>
#include <motionrack/panel/operation_specs.hpp>

namespace motionrack::panel {

namespace {

using nlohmann::json;

/// Splits "a|b" into a list.
json words_of(std::string_view words) {
    json list = json::array();
    for (;;) {
        const std::size_t bar = words.find('|');
        list.push_back(words.substr(0, bar));
        if (bar == std::string_view::npos) return list;
        words.remove_prefix(bar + 1);
    }
}

json schema_of(const FieldSpec& field) {
    json schema = {{"description", fmt::format("{}{}{}", field.text, field.unit.empty() ? "" : "; ", field.unit)}};
    switch (field.type) {
        case ParameterType::number:
        case ParameterType::integer:
            schema["type"] = field.type == ParameterType::number ? "number" : "integer";
            schema["minimum"] = field.min;
            schema["maximum"] = field.max;
            break;
        case ParameterType::text:
            schema["type"] = "string";
            schema["maxLength"] = static_cast<std::int64_t>(field.max);
            break;
        case ParameterType::choice:
            schema["type"] = "string";
            schema["enum"] = words_of(field.words);
            break;
        case ParameterType::flag:
            schema["type"] = "boolean";
            break;
        case ParameterType::texts:
            schema["type"] = "array";
            schema["items"] = {{"type", "string"}};
            schema["maxItems"] = static_cast<std::int64_t>(field.max);
            break;
        case ParameterType::numbers:
            schema["type"] = "object";
            schema["additionalProperties"] = {{"type", "integer"}};
            schema["maxProperties"] = static_cast<std::int64_t>(field.max);
            break;
    }
    if (field.or_null) schema["nullable"] = true;
    return schema;
}

std::string who_may(const OperationSpec& row) {
    if (row.role == auth::Role::none) return "Every caller, without a token.";
    return fmt::format("Needs the role {}{}.", auth::name_of(row.role), row.lease ? " and the control lease" : "");
}

json operation_of(const OperationSpec& row) {
    json answers = {
        {"200",
         {{"description", row.gives.empty() ? std::string("done") : fmt::format("done; with {}", row.gives)},
          {"content", {{"application/json", {{"schema", {{"$ref", "#/components/schemas/Done"}}}}}}}}}};
    for (const char* status : {"400", "401", "403", "409", "500", "503"})
        answers[status] = {{"$ref", "#/components/responses/Error"}};
    json operation = {{"operationId", row.name},
                      {"summary", row.text},
                      {"description", who_may(row)},
                      {"responses", std::move(answers)}};
    if (row.role == auth::Role::none) operation["security"] = json::array();
    return operation;
}

json path_of_order(const OperationSpec& row) {
    json operation = operation_of(row);
    json schema = {{"type", "object"}, {"additionalProperties", false}};
    for (const FieldSpec& field : row.fields) {
        schema["properties"][std::string(field.name)] = schema_of(field);
        if (field.required) schema["required"].push_back(field.name);
    }
    if (!row.fields.empty())
        operation["requestBody"] = {{"required", schema.contains("required")},
                                    {"content", {{"application/json", {{"schema", std::move(schema)}}}}}};
    return {{"post", std::move(operation)}};
}

json path_of_query(const OperationSpec& row) {
    json operation = operation_of(row);
    for (const FieldSpec& field : row.fields)
        operation["parameters"].push_back(
            {{"name", field.name}, {"in", "query"}, {"required", field.required}, {"schema", schema_of(field)}});
    return {{"get", std::move(operation)}};
}

json make_openapi() {
    json api = {
        {"openapi", "3.0.3"},
        {"info",
         {{"title", "Motionrack"}, {"version", "1"}, {"description", "A rack of motion-control cards, operated."}}},
        {"security", {{{"token", json::array()}}}}};
    for (const OperationSpec& row : commands()) api["paths"]["/api/" + std::string(row.name)] = path_of_order(row);
    for (const OperationSpec& row : queries()) api["paths"]["/api/" + std::string(row.name)] = path_of_query(row);
    api["components"] = {
        {"securitySchemes",
         {{"token",
           {{"type", "http"},
            {"scheme", "bearer"},
            {"description", "from pairing; loopback without one may observe"}}}}},
        {"schemas",
         {{"Done", {{"type", "object"}, {"required", {"done"}}, {"properties", {{"done", {{"type", "boolean"}}}}}}},
          {"Error",
           {{"type", "object"},
            {"properties",
             {{"error",
               {{"type", "object"},
                {"properties",
                 {{"kind",
                   {{"type", "string"}, {"enum", {"invalid_input", "refused", "denied", "machine", "io", "limit"}}}},
                  {"message", {{"type", "string"}}},
                  {"line", {{"type", "integer"}}},
                  {"column", {{"type", "integer"}}}}}}}}}}}}},
        {"responses",
         {{"Error",
           {{"description", "not done; with the reason"},
            {"content", {{"application/json", {{"schema", {{"$ref", "#/components/schemas/Error"}}}}}}}}}}}};
    return api;
}

std::string kind_of(const FieldSpec& field) {
    switch (field.type) {
        case ParameterType::number:
        case ParameterType::integer:
            return fmt::format("{} {} .. {}{}{}{}", field.type == ParameterType::number ? "number" : "whole number",
                               field.min, field.max, field.unit.empty() ? "" : " ", field.unit,
                               field.or_null ? ", or null" : "");
        case ParameterType::text:
            return fmt::format("text, {} characters at most", field.max);
        case ParameterType::choice: {
            std::string words(field.words);
            for (std::size_t at = 0; (at = words.find('|', at)) != std::string::npos; at += 2)
                words.replace(at, 1, ", ");
            return "one of " + words;
        }
        case ParameterType::flag:
            return "true or false";
        case ParameterType::texts:
            return fmt::format("list of texts, {} at most", field.max);
        case ParameterType::numbers:
            return fmt::format("object of whole numbers by name, {} at most", field.max);
    }
    return {};
}

std::string section_of(const OperationSpec& row, std::string_view verb) {
    std::string out = fmt::format("### {}\n\n{} `{} /api/{}` {}", row.name, row.text, verb, row.name, who_may(row));
    if (!row.gives.empty()) out += fmt::format(" The answer has: {}.", row.gives);
    out += "\n\n";
    if (row.fields.empty()) return out;
    out += "| field | what it may be | |\n|---|---|---|\n";
    for (const FieldSpec& field : row.fields)
        out += fmt::format("| `{}`{} | {} | {} |\n", field.name, field.required ? "" : " (optional)", kind_of(field),
                           field.text);
    return out + "\n";
}

}  // namespace

const json& openapi() {
    static const json api = make_openapi();
    return api;
}

std::string api_reference() {
    std::string out =
        "# Commands and queries of a served machine\n\n"
        "<!-- written by `motionrack describe api --markdown` -->\n\n"
        "`motionrack serve` answers these over HTTP and, as `{\"id\":1,\"command\":NAME,...}` and "
        "`{\"id\":1,\"query\":NAME,...}`, over its WebSocket. Every command and every query is\n"
        "declared once; checking, `/api/openapi.json` and this page are made from that. An answer is "
        "`{\"done\":true,...}` or\n"
        "`{\"error\":{\"kind\":...,\"message\":...}}` with a sentence that has the cause and the effect.\n\n"
        "## Commands\n\n";
    for (const OperationSpec& row : commands()) out += section_of(row, "POST");
    out += "## Queries\n\n";
    for (const OperationSpec& row : queries()) out += section_of(row, "GET");
    return out;
}

}  // namespace motionrack::panel
