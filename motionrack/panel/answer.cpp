// Converts answers, errors and events to JSON.
#include <motionrack/panel/answer.hpp>

namespace motionrack::panel {

using nlohmann::json;

Answer done(json fields) {
    fields["done"] = true;
    return {200, std::move(fields)};
}

Answer refused_answer(int status, std::string_view kind, std::string message) {
    return {status, {{"error", {{"kind", kind}, {"message", std::move(message)}}}}};
}

Answer error_answer(const Error& error) {
    const auto make = [&](int status, std::string_view kind) { return refused_answer(status, kind, error.message); };
    Answer answer;
    switch (error.kind) {
        case ErrorKind::invalid_input:
            answer = make(400, "invalid_input");
            break;
        case ErrorKind::refused:
        case ErrorKind::stopped:
            answer = make(409, "refused");
            break;
        case ErrorKind::machine:
            answer = make(500, "machine");
            break;
        case ErrorKind::io:
            answer = make(500, "io");
            break;
    }
    if (error.location.line > 0) answer.body["error"]["line"] = error.location.line;
    if (error.location.column > 0) answer.body["error"]["column"] = error.location.column;
    return answer;
}

json to_json(const Event& event) {
    return {{"number", event.number},
            {"at", to_seconds(event.at)},
            {"kind", event.kind},
            {"text", event.text},
            {"data", event.data}};
}

std::string text_of(const json& value) {
    return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace motionrack::panel
