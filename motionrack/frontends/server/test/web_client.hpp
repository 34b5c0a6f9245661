// A small blocking HTTP and WebSocket client, which can also send malformed requests.
#pragma once

#include <openssl/ssl.h>

#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace motionrack::server {

struct WebAnswer {
    int status = 0;                             ///< 0: the connection ended before an answer
    std::map<std::string, std::string> fields;  ///< names in lower case
    std::string body;
    nlohmann::json json() const { return nlohmann::json::parse(body, nullptr, false); }
    /// The sentence of an error.
    std::string message() const;
};

struct WebFrame {
    int kind = -1;  ///< opcode: 1 text, 2 binary, 8 close, 9 ping, 10 pong; -1: the connection has ended
    std::string text;
    int code = 0;  ///< status code; close frames only
};

class WebClient {
  public:
    /// Reads time out after half a minute. `small_window`: sets a small receive buffer.
    explicit WebClient(std::uint16_t port, bool tls = false, bool small_window = false);
    ~WebClient();
    WebClient(WebClient&& other) noexcept;

    bool connected() const { return socket_ >= 0; }
    void send(std::string_view bytes);
    /// Sends a complete request and returns the answer; every one of `fields` ends with CR LF.
    WebAnswer ask(const std::string& method, const std::string& target, const std::string& body = "",
                  const std::string& fields = "");
    WebAnswer answer(bool head_only = false);
    /// Reads and discards until the other end closes. Returns false if a read times out, or without a connection.
    bool ended();

    /// Requests an upgrade to a WebSocket; status 101 if the server accepts it.
    WebAnswer upgrade(const std::string& fields = "", const std::string& target = "/api/stream");
    void send_frame(int kind, std::string_view payload, bool masked = true, bool last = true);
    void say(const nlohmann::json& message) { send_frame(1, message.dump()); }
    /// Returns the next text or the end; answers pings.
    WebFrame receive();
    /// Returns the next text whose JSON satisfies `Fits`; skips others. Null if the connection ended.
    template <class Fits>
    nlohmann::json receive_until(const Fits& fits) {
        for (;;) {
            const WebFrame frame = receive();
            if (frame.kind != 1) return nullptr;
            nlohmann::json message = nlohmann::json::parse(frame.text);
            if (fits(message)) return message;
        }
    }
    /// Sends a message with a new id and returns the answer to it.
    nlohmann::json exchange(nlohmann::json message);

    int descriptor() const { return socket_; }
    /// Reads available bytes without waiting; returns true if a whole frame is present.
    bool has_frame();
    /// Host name in requests.
    std::string host;

  private:
    bool read_more();
    std::string take(std::size_t bytes);
    /// Bytes of the frame at the start of the buffer; 0 if not yet known.
    std::size_t frame_size() const;

    int socket_ = -1;
    SSL_CTX* context_ = nullptr;
    SSL* tls_ = nullptr;
    std::string buffer_;
    int next_id_ = 1000;
};

}  // namespace motionrack::server
