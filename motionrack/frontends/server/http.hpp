// Request head and answer, independent of the HTTP library.
#pragma once

#include <cstdint>
#include <memory>
#include <motionrack/panel/answer.hpp>
#include <string>
#include <utility>
#include <vector>

namespace motionrack::server {

/// Remote end of a connection.
struct Peer {
    std::string address;  ///< "127.0.0.1"
    std::string local;    ///< local address of the connection
    bool loopback = false, secure = false;
    bool stop_only = false;    ///< no slot is free: only STOP is accepted
    std::string network = {};  ///< key for limits: network_of(address)
};

struct RequestHead {
    Peer peer;
    std::string method, target, host, origin, authorization;
    bool upgrade = false;   ///< upgrade to a WebSocket
    bool has_more = false;  ///< has a body, or bytes after the head of an upgrade
    std::string websocket_key, websocket_version;
};

struct HttpAnswer {
    int status = 200;
    std::string type = "application/json";
    std::shared_ptr<const std::string> body;
    std::string cache = "no-store";
    std::vector<std::pair<std::string, std::string>> more = {};  ///< further header fields
};

HttpAnswer http_answer(const panel::Answer& answer);
/// Returns an error answer: {"error":{"kind":..,"message":..}}.
HttpAnswer http_error(int status, std::string_view trouble, std::string sentence);

/// Parses a JSON object, `what` in messages. Errors: invalid_input with line and column: not JSON, not an object, or
/// nested deeper than 16.
Result<nlohmann::json> read_object(std::string_view text, std::string_view what);

/// Request target: path, "/api/card", and the %XX-decoded names and values behind "?".
struct RequestTarget {
    std::string path;
    std::vector<std::pair<std::string, std::string>> texts;
};
/// Parses a request target. Errors: invalid_input: a % without two hexadecimal digits.
Result<RequestTarget> read_target(std::string_view target);

}  // namespace motionrack::server
