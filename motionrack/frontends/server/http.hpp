// A request's head and an answer, without the library that carries them.
#pragma once

#include <cstdint>
#include <memory>
#include <motionrack/panel/answer.hpp>
#include <string>
#include <utility>
#include <vector>

namespace motionrack::server {

/// Where a connection comes from.
struct Peer {
    std::string address;  ///< "127.0.0.1"
    std::string local;    ///< the address that it reached
    bool loopback = false, secure = false;
    bool stop_only = false;    ///< there is no seat for it: it may ask for STOP only
    std::string network = {};  ///< what limits count: network_of(address)
};

struct RequestHead {
    Peer peer;
    std::string method, target, host, origin, authorization;
    bool upgrade = false;   ///< to a WebSocket
    bool has_more = false;  ///< a body, or bytes behind the head of an upgrade
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
/// {"error":{"trouble":..,"message":..}}
HttpAnswer http_error(int status, std::string_view trouble, std::string sentence);

/// An object from a text. Errors: invalid_input with line and column: no JSON, no object, nested deeper than 16.
Result<nlohmann::json> read_object(std::string_view text, std::string_view what);

/// "/api/card", and the texts behind "?" with their %XX decoded. Errors: invalid_input.
struct Target {
    std::string path;
    std::vector<std::pair<std::string, std::string>> texts;
};
Result<Target> read_target(std::string_view target);

}  // namespace motionrack::server
