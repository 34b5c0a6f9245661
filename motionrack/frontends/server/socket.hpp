// What connections have from Boost, and the two ways between its types and ours.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/span.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/span_body.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/ssl/ssl_stream.hpp>
#include <memory>
#include <motionrack/frontends/server/listener.hpp>
#include <string>
#include <string_view>

namespace motionrack::server {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using boost::system::error_code;

using Request = http::request<http::string_body>;
using Response = http::response<http::span_body<const char>>;
using PlainStream = beast::tcp_stream;
using TlsStream = beast::ssl_stream<beast::tcp_stream>;

Head head_of(const Request& request, const Peer& peer);
/// Points to the answer's body, which must stay.
Response response_of(const HttpAnswer& answer, bool head_only, bool keep_alive);
/// 503 with this sentence, as it goes over the line; the same sentence again costs nothing.
const std::string& last_word(std::string_view why);

/// Becomes a WebSocket. A template's two uses are compiled in files of their own: each takes half a minute.
void serve_stream(PlainStream stream, Request request, Peer peer, std::shared_ptr<Hall> hall, Open* before);
void serve_stream(TlsStream stream, Request request, Peer peer, std::shared_ptr<Hall> hall, Open* before);

}  // namespace motionrack::server
