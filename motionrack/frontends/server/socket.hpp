// Types that connections use from Boost, and the conversions to our types.
#pragma once

#include <boost/beast/core/span.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/span_body.hpp>
#include <boost/beast/http/string_body.hpp>
#include <memory>
#include <motionrack/frontends/server/connection_pool.hpp>
#include <motionrack/frontends/server/transport.hpp>
#include <string>
#include <string_view>

namespace motionrack::server {

namespace http = boost::beast::http;

using Request = http::request<http::string_body>;
using Response = http::response<http::span_body<const char>>;

/// Converts an IPv4-mapped IPv6 address to IPv4.
asio::ip::address unmapped(const asio::ip::address& address);
RequestHead head_of(const Request& request, const Peer& peer);
/// Converts an answer; the response refers to its body, which must outlive it.
Response response_of(const HttpAnswer& answer, bool head_only, bool keep_alive);
/// Returns the raw bytes of a 503 response with this sentence, cached per sentence.
const std::string& last_word(std::string_view why);

/// Starts to serve an accepted connection.
void serve(Transport transport, Peer peer, std::shared_ptr<ConnectionPool> pool);
/// Upgrades a connection to a WebSocket, which takes over the slot of `before`.
void serve_stream(Transport transport, Request request, Peer peer, std::shared_ptr<ConnectionPool> pool,
                  OpenConnection* before);

}  // namespace motionrack::server
