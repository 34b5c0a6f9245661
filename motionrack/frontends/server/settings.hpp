// What a server is told, and what it allows.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <motionrack/authority/doorkeeper.hpp>
#include <motionrack/authority/role.hpp>
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
    std::size_t spare = 32;              ///< beyond them, for STOP only; the oldest of these goes when another comes
    std::size_t frame = 64 * 1024;       ///< bytes of a WebSocket message from who may not operate; else big_body
    std::size_t small_body = 64 * 1024;  ///< bytes of a body
    std::size_t big_body = 16 * 1024 * 1024;  ///< of one that may have a program in it, from who may ask for that
    double requests_at_once = 500, requests_per_second = 200;  ///< HTTP, of an address
    double messages_at_once = 200, messages_per_second = 100;  ///< WebSocket, of a connection
    std::size_t pictures_waiting = 2;                          ///< for one client; what comes then is lost
    std::size_t texts_waiting = 500;           ///< answers and events for one client; with more it is let go
    std::size_t asks_waiting = 64;             ///< orders and queries of one client without an answer so far
    std::chrono::milliseconds header{10'000};  ///< for a request's head, a handshake, a client's token
    std::chrono::milliseconds idle{60'000};    ///< between requests
    std::chrono::milliseconds body{30'000};
    std::chrono::milliseconds spare_time{3'000};
    std::chrono::milliseconds silence{
        20'000};  ///< of a WebSocket's other end, which is asked for a sign (ping) after half of it
};

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
    std::vector<std::string> origins = {};  ///< "http://localhost:5173": pages from elsewhere that may ask
    authority::Role loopback_role = authority::Role::observe;  ///< of who comes from this computer without a token
    std::string version = {}, rack = {}, boot = {};
    Limits limits = {};
    std::function<void(const AuditEntry&)> audit = {};  ///< on the network thread; must not wait
    std::function<authority::Now()> clock = [] {
        return authority::Now{std::chrono::system_clock::now(), std::chrono::steady_clock::now()};
    };
};

}  // namespace motionrack::server
