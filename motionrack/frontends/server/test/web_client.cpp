// Sends and receives over blocking sockets, with OpenSSL for TLS.
#include "web_client.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <utility>

namespace motionrack::server {

std::string WebAnswer::message() const {
    const nlohmann::json value = json();
    return value.is_object() && value.contains("error") ? value["error"].value("message", "") : "";
}

WebClient::WebClient(std::uint16_t port, bool tls, bool small_window)
    : host(fmt::format("127.0.0.1:{}", port)), socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    const timeval half_a_minute{30, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &half_a_minute, sizeof half_a_minute);
    ::setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &half_a_minute, sizeof half_a_minute);
    const int on = 1;  // as in browsers and curl
    ::setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    if (small_window) {
        const int bytes = 2048;
        ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &bytes, sizeof bytes);
    }
    sockaddr_in address = {};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
        ::close(std::exchange(socket_, -1));
        return;
    }
    if (!tls) return;
    context_ = ::SSL_CTX_new(::TLS_client_method());
    tls_ = ::SSL_new(context_);
    ::SSL_set_fd(tls_, socket_);
    if (::SSL_connect(tls_) != 1) ::close(std::exchange(socket_, -1));
}

WebClient::WebClient(WebClient&& other) noexcept
    : host(std::move(other.host)),
      socket_(std::exchange(other.socket_, -1)),
      context_(std::exchange(other.context_, nullptr)),
      tls_(std::exchange(other.tls_, nullptr)),
      buffer_(std::move(other.buffer_)),
      next_id_(other.next_id_) {}

WebClient::~WebClient() {
    if (tls_ != nullptr) ::SSL_free(tls_);
    if (context_ != nullptr) ::SSL_CTX_free(context_);
    if (socket_ >= 0) ::close(socket_);
}

void WebClient::send(std::string_view bytes) {
    while (!bytes.empty() && socket_ >= 0) {
        const ssize_t some = tls_ != nullptr ? ::SSL_write(tls_, bytes.data(), static_cast<int>(bytes.size()))
                                             : ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (some <= 0) return;  // the answer shows how much was sent
        bytes.remove_prefix(static_cast<std::size_t>(some));
    }
}

bool WebClient::read_more() {
    char bytes[16384];
    if (socket_ < 0) return false;
    const ssize_t some =
        tls_ != nullptr ? ::SSL_read(tls_, bytes, sizeof bytes) : ::recv(socket_, bytes, sizeof bytes, 0);
    if (some <= 0) return false;
    buffer_.append(bytes, static_cast<std::size_t>(some));
    return true;
}

std::string WebClient::take(std::size_t bytes) {
    while (buffer_.size() < bytes)
        if (!read_more()) return "";
    std::string out = buffer_.substr(0, bytes);
    buffer_.erase(0, bytes);
    return out;
}

bool WebClient::ended() {
    errno = 0;
    while (socket_ >= 0 && read_more()) errno = 0;
    return socket_ >= 0 && errno != EAGAIN && errno != EWOULDBLOCK;
}

WebAnswer WebClient::ask(const std::string& method, const std::string& target, const std::string& body,
                         const std::string& fields) {
    std::string text = fmt::format("{} {} HTTP/1.1\r\nHost: {}\r\n{}", method, target, host, fields);
    if (!body.empty()) text += fmt::format("Content-Length: {}\r\n", body.size());
    send(text + "\r\n" + body);
    return answer(method == "HEAD");
}

WebAnswer WebClient::answer(bool head_only) {
    WebAnswer out;
    std::size_t end = 0;
    while ((end = buffer_.find("\r\n\r\n")) == std::string::npos)
        if (!read_more()) return out;
    const std::string head = take(end + 4);
    out.status = std::atoi(head.substr(9, 3).c_str());
    for (std::size_t at = head.find("\r\n") + 2; at < head.size() - 2;) {
        const std::size_t stop = head.find("\r\n", at), colon = head.find(':', at);
        std::string name = head.substr(at, colon - at);
        std::transform(name.begin(), name.end(), name.begin(),
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        out.fields[name] = head.substr(colon + 2, stop - colon - 2);
        at = stop + 2;
    }
    if (!head_only && out.fields.count("content-length") != 0)
        out.body = take(std::stoul(out.fields["content-length"]));
    return out;
}

WebAnswer WebClient::upgrade(const std::string& fields, const std::string& target) {
    return ask("GET", target, "",
               "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: "
               "AAAAAAAAAAAAAAAAAAAAAA==\r\n" +
                   fields);
}

void WebClient::send_frame(int kind, std::string_view payload, bool masked, bool last) {
    std::string out(1, static_cast<char>((last ? 0x80 : 0) | kind));
    const auto mask_bit = static_cast<unsigned>(masked ? 0x80 : 0);
    if (payload.size() < 126) {
        out += static_cast<char>(mask_bit | payload.size());
    } else {
        const int bytes = payload.size() < 65536 ? 2 : 8;
        out += static_cast<char>(mask_bit | (bytes == 2 ? 126u : 127u));
        for (int i = bytes - 1; i >= 0; --i) out += static_cast<char>(payload.size() >> (8 * i) & 0xff);
    }
    const char key[4] = {'r', 'a', 'c', 'k'};
    if (masked) out.append(key, 4);
    for (std::size_t i = 0; i < payload.size(); ++i)
        out += masked ? static_cast<char>(payload[i] ^ key[i % 4]) : payload[i];
    send(out);
}

std::size_t WebClient::frame_size() const {
    if (buffer_.size() < 2) return 0;
    const std::size_t size = static_cast<unsigned char>(buffer_[1]) & 127u, more = size < 126 ? 0 : size == 126 ? 2 : 8;
    if (buffer_.size() < 2 + more) return 0;
    std::size_t longer = 0;
    for (std::size_t i = 0; i < more; ++i) longer = longer << 8 | static_cast<unsigned char>(buffer_[2 + i]);
    return 2 + more + (more > 0 ? longer : size);
}

bool WebClient::has_frame() {
    const auto whole = [this] { return frame_size() > 0 && buffer_.size() >= frame_size(); };
    char bytes[65536];
    while (!whole()) {
        const ssize_t some = ::recv(socket_, bytes, sizeof bytes, MSG_DONTWAIT);
        if (some <= 0) return false;
        buffer_.append(bytes, static_cast<std::size_t>(some));
    }
    return true;
}

WebFrame WebClient::receive() {
    for (;;) {
        WebFrame frame;
        const std::string head = take(2);
        if (head.empty()) return frame;
        frame.kind = head[0] & 15;
        std::size_t size = static_cast<unsigned char>(head[1]) & 127u;
        if (size >= 126) {
            std::size_t longer = 0;
            for (const char byte : take(size == 126 ? 2 : 8)) longer = longer << 8 | static_cast<unsigned char>(byte);
            size = longer;
        }
        frame.text = size > 0 ? take(size) : "";
        if (frame.text.size() != size) return {};
        if (frame.kind == 9) {
            send_frame(10, frame.text);
        } else if (frame.kind == 8) {
            if (size >= 2)
                frame.code = static_cast<unsigned char>(frame.text[0]) << 8 | static_cast<unsigned char>(frame.text[1]);
            frame.text = size > 2 ? frame.text.substr(2) : "";
            return frame;
        } else if (frame.kind != 10) {
            return frame;
        }
    }
}

nlohmann::json WebClient::exchange(nlohmann::json message) {
    const int id = next_id_++;
    message["id"] = id;
    say(message);
    return receive_until([&](const nlohmann::json& answer) { return answer.contains("id") && answer["id"] == id; });
}

}  // namespace motionrack::server
