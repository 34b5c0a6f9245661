// Callers and answers: the interface between the panel and its network front ends.
#pragma once

#include <motionrack/auth/role.hpp>
#include <motionrack/base/result.hpp>
#include <motionrack/base/time.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace motionrack::panel {

struct Caller {
    std::string user;
    auth::Role role = auth::Role::none;
    std::string session;       ///< one connection or token: holder of the control lease
    std::string address = {};  ///< origin of the request, for the journal
};

/// `status` as in HTTP: 200, 400 invalid_input, 401 no token, 403 denied, 404 unknown name, 409 refused, 500 machine,
/// 503 gone.
struct Answer {
    int status = 200;
    nlohmann::json body;  ///< {"done":true, ...} or {"error":{"kind","message","line","column"}}
};

/// Returns an answer of status 200: {"done":true} and the members of `fields`.
Answer done(nlohmann::json fields = nlohmann::json::object());
/// Returns an answer with this HTTP status and error. `kind`: invalid_input, refused, denied, machine, io, limit.
Answer refused_answer(int status, std::string_view kind, std::string message);
Answer error_answer(const Error& error);

/// An event of the machine or the panel, sent to all connected clients.
struct Event {
    std::int64_t number = 0;  ///< starts at 1
    Instant at{};
    std::string kind;  ///< alarm, state, job, command, setting, stop
    std::string text;
    nlohmann::json data;
};
nlohmann::json to_json(const Event& event);

/// Returns JSON text; invalid UTF-8 is replaced.
std::string text_of(const nlohmann::json& value);

}  // namespace motionrack::panel
