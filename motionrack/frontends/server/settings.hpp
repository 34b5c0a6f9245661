// What a server is told, and what it allows.
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
    std::string certificate;  ///< with those that signed it
    std::string key;
};

struct Limits {
    std::size_t connections = 500;
    std::size_t of_a_network = 250;        ///< of these, from one network (network_of); beyond both STOP only is heard
    std::size_t callers = 128;             ///< connections that have sent no head so far, or have no seat
    std::size_t strange_frame = 4 * 1024;  ///< bytes of a WebSocket message before its token
    std::size_t frame = 64 * 1024;         ///< from who may look; of who may operate big_body
    std::size_t strange_body = 1024;       ///< bytes of a body of who may not order this, or pairs
    std::size_t small_body = 64 * 1024;    ///< bytes of a body
    std::size_t big_body = 16 * 1024 * 1024;  ///< of one that may have a program in it, from who may ask for that
    double requests_at_once = 500, requests_per_second = 200;  ///< HTTP, of an address
    double messages_at_once = 200, messages_per_second = 100;  ///< WebSocket, of a connection
    std::size_t pictures_waiting = 2;                          ///< for one client; what comes then is lost
    std::size_t strange_texts_waiting = 100;                   ///< answers and events for one client without a token
    std::size_t texts_waiting = 500;           ///< answers and events for one client; with more it is let go
    std::size_t asks_waiting = 64;             ///< orders and queries of one client without an answer so far
    std::chrono::milliseconds header{10'000};  ///< for a request's head, a handshake, a client's token
    std::chrono::milliseconds idle{60'000};    ///< between requests
    std::chrono::milliseconds body{30'000};
    std::chrono::milliseconds spare_time{3'000};
    std::chrono::milliseconds silence{
        20'000};  ///< of a WebSocket's other end, which is asked for a sign (ping) after half of it
};

/// Bytes of an entry's sentence in the journal.
inline constexpr std::size_t max_audit_bytes = 200;

/// Who asked for what, and what became of it.
struct AuditEntry {
    std::string user, address, what;
    int status = 200;     ///< as in HTTP
    std::string outcome;  ///< "done", or the sentence
};

struct ServerSettings {
    std::string address = "127.0.0.1";  ///< IPv4 or IPv6; other than loopback only with TLS
    std::uint16_t port = 8080;          ///< 0: any free one
    std::optional<TlsFiles> tls = {};
    std::vector<std::string> hosts =
        {};  ///< names that this computer is called by, besides localhost and its addresses
    std::vector<std::string> origins = {};           ///< "http://localhost:5173": pages from elsewhere that may ask
    auth::Role loopback_role = auth::Role::observe;  ///< of who comes from this computer without a token
    std::string version = {}, rack = {}, boot = {};
    Limits limits = {};
    std::function<void(const AuditEntry&)> audit = {};  ///< on the network thread; must not wait
    std::function<auth::Timestamps()> clock = [] {
        return auth::Timestamps{std::chrono::system_clock::now(), std::chrono::steady_clock::now()};
    };
};

}  // namespace motionrack::server
