// libFuzzer: any bytes as a WebSocket's handshake and frames. A handshake is answered as in RFC 6455, or rejected with
// a sentence. The server sends frames with JSON; each message with an id gets one answer with this id, and a close has
// a code. Without a token a client can change nothing at the machine except stop it.
//
//  input: choice (2 bytes), then repeatedly: kind (1 byte), its text up to the next line end
#include <openssl/evp.h>
#include <openssl/sha.h>

#include <array>
#include <cstdint>
#include <map>
#include <tests/fuzz/served_connection.hpp>

namespace {

using motionrack::fuzz::require;
using motionrack::fuzz::ServedConnection;
using motionrack::fuzz::take_answer;
using motionrack::fuzz::WebAnswer;
using nlohmann::json;

constexpr std::string_view key = "AAECAwQFBgcICQoLDA0ODw==";

/// Returns the server's response to the key (RFC 6455, 4.2.2).
std::string accept_of(std::string text) {
    text += "258EAFA5-E914-47DA-95CA-C5AB0DC85B11";
    std::array<unsigned char, SHA_DIGEST_LENGTH> hash{};
    SHA1(reinterpret_cast<const unsigned char*>(text.data()), text.size(), hash.data());
    std::array<unsigned char, 32> out{};
    EVP_EncodeBlock(out.data(), hash.data(), static_cast<int>(hash.size()));
    return reinterpret_cast<const char*>(out.data());
}

/// `wrong`: one bit per error in the handshake.
std::string handshake(std::uint8_t wrong, std::string_view text) {
    const auto is = [&](int bit) { return (wrong >> bit & 1) != 0; };
    std::string out = is(0) ? "GET /api/other HTTP/1.1\r\n" : "GET /api/stream HTTP/1.1\r\n";
    out += is(1) ? "Host: elsewhere\r\n" : "Host: localhost\r\n";
    out += is(2) ? "Connection: close\r\n" : "Connection: keep-alive, Upgrade\r\n";
    out += "Upgrade: websocket\r\n";
    if (!is(3)) out += "Sec-WebSocket-Version: 13\r\n";
    if (!is(4)) out += fmt::format("Sec-WebSocket-Key: {}\r\n", key);
    if (is(5)) out += fmt::format("Sec-WebSocket-Key: {}\r\n", text);
    if (is(6)) out += "Sec-WebSocket-Extensions: permessage-deflate\r\nSec-WebSocket-Protocol: a, b\r\n";
    if (is(7)) out += fmt::format("Content-Length: {}\r\n", text.size());
    return out + "\r\n";
}

std::string frame(unsigned first, std::string_view text, bool is_masked = true) {
    std::string out(1, static_cast<char>(first));
    const unsigned mask = is_masked ? 0x80 : 0;
    if (text.size() < 126) {
        out += static_cast<char>(mask | static_cast<unsigned>(text.size()));
    } else {
        out += static_cast<char>(mask | 126);
        out += static_cast<char>(text.size() >> 8);
        out += static_cast<char>(text.size());
    }
    static constexpr std::string_view bits = "fuzz";
    if (is_masked) out += bits;
    for (std::size_t i = 0; i < text.size(); ++i) out += is_masked ? static_cast<char>(text[i] ^ bits[i % 4]) : text[i];
    return out;
}

// ---- received bytes

class Frames {
  public:
    /// Removes complete frames.
    void take(std::string_view& came) {
        while (came.size() >= 2) {
            const auto first = static_cast<unsigned char>(came[0]), second = static_cast<unsigned char>(came[1]);
            std::size_t size = second & 127u;
            const std::size_t more = size < 126 ? 0 : size == 126 ? 2 : 8;
            if (came.size() < 2 + more) return;
            if (more > 0) size = 0;
            for (std::size_t i = 0; i < more; ++i) size = size << 8 | static_cast<unsigned char>(came[2 + i]);
            if (came.size() < 2 + more + size) return;
            require((first & 0xF0) == 0x80 && (second & 0x80) == 0, "a server's frames are whole and not masked");
            take_one(first & 15, std::string(came.substr(2 + more, size)));
            came.remove_prefix(2 + more + size);
        }
    }
    bool is_closed() const { return is_closed_; }
    std::size_t answers() const { return answers_; }
    /// Number of answers by id; "null" for those without an id.
    const std::map<std::string, int>& answered() const { return answered_; }

  private:
    void take_one(int kind, const std::string& text) {
        require(!is_closed_, "nothing comes behind a close");
        require(kind == 1 || (kind >= 8 && kind <= 10), "a frame is of a kind that there is", std::to_string(kind));
        require(kind == 1 || text.size() <= 125, "a control frame is short");
        if (kind == 8) {
            is_closed_ = true;
            if (text.empty()) return;
            require(text.size() >= 2, "a close has a code");
            const int code = static_cast<unsigned char>(text[0]) << 8 | static_cast<unsigned char>(text[1]);
            require((code >= 1000 && code <= 1003) || (code >= 1007 && code <= 1014) || code >= 3000,
                    "a close has a code that there is", std::to_string(code));
        }
        if (kind != 1) return;
        const json message = json::parse(text, nullptr, false);
        require(message.is_object(), "a message is an object in JSON", text);
        const bool is_answer = message.contains("done") || message.contains("error");
        const bool is_other = message.contains("hello") || message.contains("seq") || message.contains("event");
        require(is_answer != is_other, "a message is an answer, or told to all", text);
        if (!is_answer) return;
        require(message.contains("id"), "an answer has an id", text);
        if (message.contains("error"))
            require(message["error"]["message"].get<std::string>().size() > 10, "a refusal is a sentence", text);
        ++answers_;
        ++answered_[message["id"].dump()];
    }

    bool is_closed_ = false;
    std::size_t answers_ = 0;
    std::map<std::string, int> answered_;
};

class Session {
  public:
    explicit Session(std::string_view input)
        : is_known_((input[0] & 1) != 0), is_wrong_((input[0] & 2) != 0), left_(input.substr(2)) {
        const std::string_view text = left_.substr(0, left_.find_first_of("\r\n"));
        const auto wrong = is_wrong_ ? static_cast<std::uint8_t>(input[1]) : 0;
        if ((wrong >> 5 & 1) != 0) key_ = text;
        connection_.send(handshake(static_cast<std::uint8_t>(wrong), text));
        if (is_known_) say(json{{"id", "token"}, {"token", connection_.token()}}.dump());
    }
    void run() {
        const bool has_ended = connection_.run([this] { return step(); });
        const std::string counts = fmt::format("{} of {}", frames_.answers(), said_);
        require(is_broken_ || frames_.answers() <= said_, "no message gets two answers", counts);
        require(is_broken_ || has_ended || frames_.answers() == said_, "each message gets an answer", counts);
        require(has_ended, "the server ends where its client does");
        for (const auto& [id, count] : frames_.answered())
            require(id == "null" || count <= ids_[id], "an answer has the id of a message that was sent", id);
        if (!is_known_) connection_.require_untouched();
    }

  private:
    void say(const std::string& text) {
        waiting_ += frame(0x81, text);
        note(text);
    }
    /// Records a message that will be answered.
    void note(const std::string& text) {
        ++said_;
        const json message = json::parse(text, nullptr, false);
        if (message.is_object() && message.contains("id")) ++ids_[message["id"].dump()];
    }
    /// Sends the message for the next kind and text.
    void next() {
        const auto kind = static_cast<std::uint8_t>(left_[0]);
        const std::size_t end = std::min(left_.find('\n'), left_.size());
        const std::string text(left_.substr(1, end > 1 ? end - 1 : 0));
        left_.remove_prefix(std::min(std::max<std::size_t>(end, 1) + 1, left_.size()));
        switch (kind % 8) {
            case 0: {
                const std::size_t half = text.size() / 2;
                waiting_ += frame(0x01, text.substr(0, half)) + frame(0x89, "between") + frame(0x80, text.substr(half));
                note(text);
                break;
            }
            case 1:
                waiting_ += frame(0x82, text);
                ++said_;
                break;
            case 2:
                waiting_ += frame(0x80 | (kind >> 4), text.substr(0, 125), (kind & 8) == 0);
                is_broken_ = true;
                break;
            case 3:
                waiting_ += text;
                is_broken_ = true;
                break;
            case 4:
                pause_ = kind;
                break;
            default:
                say(text);
        }
    }
    bool step() {
        std::string_view came = std::string_view(connection_.received()).substr(taken_);
        const std::size_t before = came.size();
        if (is_open_ || open(came)) frames_.take(came);
        taken_ += before - came.size();
        if (connection_.has_ended()) return false;
        if (!is_open_ || --pause_ > 0) return true;
        connection_.send(std::exchange(waiting_, ""));
        if (!left_.empty()) {
            next();
        } else if (!is_over_ && (is_broken_ || frames_.answers() >= said_)) {
            is_over_ = true;
            connection_.send(frame(0x88, "\x03\xe8"));
            connection_.end_sending();
        }
        return true;
    }
    /// Returns true if the connection is open now.
    bool open(std::string_view& came) {
        WebAnswer answer;
        if (!take_answer(came, false, answer)) return false;
        is_open_ = answer.status == 101;
        if (is_open_) {
            require(answer.has("\r\nSec-WebSocket-Accept: " + accept_of(key_) + "\r\n"),
                    "the answer to a handshake is made of its key", answer.head);
        } else {
            require(is_wrong_ && answer.status >= 400, "a handshake that is right is not refused", answer.head);
            connection_.end_sending();
        }
        return is_open_;
    }

    ServedConnection connection_;
    Frames frames_;
    bool is_known_ = false, is_wrong_ = false;
    std::string_view left_;
    std::string key_ = std::string(key), waiting_;  ///< waiting: until the handshake is answered
    std::map<std::string, int> ids_;
    std::size_t taken_ = 0, said_ = 0;
    int pause_ = 0;
    bool is_open_ = false, is_broken_ = false, is_over_ = false;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2 || size > 20'000) return 0;
    Session({reinterpret_cast<const char*>(data), size}).run();
    return 0;
}
