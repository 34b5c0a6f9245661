// Settings and limits of a server.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <motionrack/auth/authenticator.hpp>
#include <motionrack/auth/role.hpp>
#include <optional>
#include <string>
#include <vector>

namespace motionrack::server {

/// PEM files.
struct TlsFiles {
    std::string certificate;  ///< with its certificate chain
    std::string key;
};

struct Limits {
    std::size_t connections = 500;
    std::size_t of_a_network =
        250;                    ///< connections per network (network_of); beyond either limit only STOP is accepted
    std::size_t callers = 128;  ///< connections without a complete head or without a slot
    std::size_t strange_frame = 4 * 1024;  ///< maximum bytes of a WebSocket message before authentication
    std::size_t frame = 64 * 1024;  ///< maximum bytes of a WebSocket message from an observer; big_body for operators
    std::size_t strange_body =
        1024;  ///< maximum bytes of a body without permission for the operation, or of a pairing request
    std::size_t small_body = 64 * 1024;  ///< maximum bytes of other bodies
    std::size_t big_body =
        16 * 1024 * 1024;  ///< maximum bytes of a body that may contain a program, with permission for it and a token
    double requests_at_once = 500, requests_per_second = 200;  ///< HTTP, per address
    double messages_at_once = 200, messages_per_second = 100;  ///< WebSocket, per connection
    std::size_t pictures_waiting = 2;         ///< maximum number queued per client; later ones are lost
    std::size_t strange_texts_waiting = 100;  ///< maximum answers and events queued for a client without a token
    std::size_t texts_waiting =
        500;                        ///< maximum answers and events queued for a client; beyond it the client is closed
    std::size_t asks_waiting = 64;  ///< maximum unanswered commands and queries of one client
    std::chrono::milliseconds header{10'000};     ///< timeout of a head, a handshake and a client's token
    std::chrono::milliseconds idle{60'000};       ///< timeout between requests
    std::chrono::milliseconds body{30'000};       ///< timeout of a body, and of sending an answer
    std::chrono::milliseconds spare_time{3'000};  ///< timeout of a connection without a slot, and of closing
    std::chrono::milliseconds silence{
        20'000};  ///< timeout of the other end of a WebSocket; a ping is sent after half of it
};

/// Maximum bytes of an entry's sentence in the journal.
inline constexpr std::size_t max_audit_bytes = 200;

/// Request with its caller and its result.
struct AuditEntry {
    std::string user, address, what;
    int status = 200;     ///< HTTP status
    std::string outcome;  ///< "done", or the error message
};

struct ServerSettings {
    std::string address = "127.0.0.1";  ///< IPv4 or IPv6; non-loopback only with TLS
    std::uint16_t port = 8080;          ///< 0: any free port
    std::optional<TlsFiles> tls = {};
    std::vector<std::string> hosts = {};             ///< accepted host names, besides localhost and its addresses
    std::vector<std::string> origins = {};           ///< "http://localhost:5173": foreign pages that may send requests
    auth::Role loopback_role = auth::Role::observe;  ///< role of a local client without a token
    std::string version = {}, rack = {}, boot = {};
    Limits limits = {};
    std::function<void(const AuditEntry&)> audit = {};  ///< on the network thread; must not block
    std::function<auth::Timestamps()> clock = [] {
        return auth::Timestamps{std::chrono::system_clock::now(), std::chrono::steady_clock::now()};
    };
};

}  // namespace motionrack::server
