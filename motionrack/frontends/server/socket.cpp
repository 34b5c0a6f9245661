// Conversions of heads and answers to and from Boost.
#include <boost/beast/http/serializer.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <functional>
#include <map>
#include <motionrack/frontends/server/socket.hpp>
#include <sstream>

namespace motionrack::server {

namespace {

std::string field(const Request& request, http::field name) {
    const auto text = request[name];
    return {text.data(), text.size()};
}

/// Empty if the field occurs twice, because it is ambiguous.
std::string only_field(const Request& request, http::field name) {
    return request.count(name) == 1 ? field(request, name) : "";
}

}  // namespace

asio::ip::address unmapped(const asio::ip::address& address) {
    if (address.is_v6() && address.to_v6().is_v4_mapped())
        return asio::ip::make_address_v4(asio::ip::v4_mapped, address.to_v6());
    return address;
}

RequestHead head_of(const Request& request, const Peer& peer) {
    RequestHead head;
    head.peer = peer;
    head.method = std::string(request.method_string());
    head.target = std::string(request.target());
    head.host = only_field(request, http::field::host);
    head.origin = field(request, http::field::origin);
    head.authorization = field(request, http::field::authorization);
    head.upgrade = beast::websocket::is_upgrade(request);
    head.websocket_key = only_field(request, http::field::sec_websocket_key);
    head.websocket_version = only_field(request, http::field::sec_websocket_version);
    return head;
}

Response response_of(const HttpAnswer& answer, bool head_only, bool keep_alive) {
    Response response(static_cast<http::status>(answer.status), 11);
    response.set(http::field::server, "motionrack");
    response.set(http::field::content_type, answer.type);
    response.set(http::field::cache_control, answer.cache);
    response.set("Content-Security-Policy",
                 "default-src 'self'; object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
    response.set("X-Content-Type-Options", "nosniff");
    response.set("Referrer-Policy", "no-referrer");
    response.set("Cross-Origin-Opener-Policy", "same-origin");
    response.set("Cross-Origin-Resource-Policy", "same-origin");
    for (const auto& [name, value] : answer.more) response.set(name, value);
    const std::string& body = *answer.body;
    if (!head_only) response.body() = beast::span<const char>(body.data(), body.size());
    response.content_length(body.size());
    response.keep_alive(keep_alive);
    return response;
}

const std::string& last_word(std::string_view why) {
    thread_local std::map<std::string, std::string, std::less<>> words;
    if (const auto found = words.find(why); found != words.end()) return found->second;
    std::ostringstream out;
    out << response_of(http_error(503, "limit", std::string(why)), false, false);
    return words.emplace(why, out.str()).first->second;
}

}  // namespace motionrack::server
