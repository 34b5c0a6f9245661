// libFuzzer: any bytes to the server as HTTP. Each complete request gets its answer, in order, until an answer
// announces that it is the last. An answer to HEAD has no body; input that is not a request is rejected with a
// sentence. Without a token a client can change nothing at the machine except stop it.
//
//  input: choice (1 byte), then the bytes to send; FFh advances three slices; {token} is a token if choice is odd
#include <boost/beast/http/dynamic_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <cstdint>
#include <tests/fuzz/served_connection.hpp>
#include <vector>

namespace {

namespace http = boost::beast::http;
using motionrack::fuzz::require;
using motionrack::fuzz::ServedConnection;
using motionrack::fuzz::take_answer;
using motionrack::fuzz::WebAnswer;

// ---- sent bytes

struct Sent {
    std::vector<bool> is_head;  ///< for each complete request
    bool is_rest_head = false;  ///< for the bytes after them
    bool has_rest = false, is_rest_wrong = false;
};

/// Splits the bytes as an HTTP reader does, without limits on bodies.
Sent taken_apart(std::string_view bytes) {
    Sent out;
    while (!bytes.empty()) {
        http::request_parser<http::dynamic_body> parser;  // reserves no memory for a body
        parser.eager(true);
        parser.body_limit(boost::none);
        boost::system::error_code error;
        std::size_t used = 0;
        while (!parser.is_done() && used < bytes.size()) {
            const std::size_t some = parser.put(boost::asio::buffer(bytes.data() + used, bytes.size() - used), error);
            used += some;
            if (error || some == 0) break;
        }
        const bool is_head = parser.get().method() == http::verb::head;
        if (!parser.is_done()) {
            out.is_rest_head = is_head;
            out.has_rest = true;
            out.is_rest_wrong = error && error != http::error::need_more;
            return out;
        }
        out.is_head.push_back(is_head);
        bytes.remove_prefix(used);
    }
    return out;
}

std::string with_token(std::string text, const std::string& token) {
    for (std::size_t at = 0; (at = text.find("{token}", at)) != std::string::npos;) text.replace(at, 7, token);
    return text;
}

// ---- received bytes

/// Returns the number of answers; `is_last`: no answer follows.
std::size_t answers(const Sent& sent, std::string_view came, bool& is_last) {
    std::size_t count = 0;
    is_last = false;
    for (WebAnswer answer; !came.empty();) {
        const bool is_rest = count >= sent.is_head.size();
        if (!take_answer(came, is_rest ? sent.is_rest_head : sent.is_head[count], answer)) return count;
        require(!is_last, "nothing comes behind the last answer", answer.head);
        if (answer.status == 100) continue;
        require(!is_rest || sent.has_rest, "there is no answer without a request", answer.head);
        ++count;
        is_last = answer.closes || answer.status == 101;
        if (answer.status == 101) return count;  // frames follow
    }
    return count;
}

class Session {
  public:
    explicit Session(std::string_view input) : is_known_((input[0] & 1) != 0), left_(input.substr(1)) {
        if (is_known_) text_ = with_token(std::string(left_), connection_.token());
        if (is_known_) left_ = text_;
    }
    void run() {
        const bool has_ended = connection_.run([this] { return step(); });
        const Sent sent = taken_apart(all_);
        bool is_last = false;
        const std::size_t count = answers(sent, connection_.received(), is_last);
        require(is_last || count >= sent.is_head.size(), "each whole request gets an answer",
                std::to_string(count) + " of " + std::to_string(sent.is_head.size()));
        require(is_last || !sent.is_rest_wrong || count == sent.is_head.size() + 1, "what is no request is refused");
        require(has_ended, "the server ends where its client does");
        if (!is_known_) connection_.require_untouched();
    }

  private:
    /// Sends the next bytes and waits for the end.
    bool step() {
        if (--pause_ > 0) return true;
        if (!left_.empty()) {
            const std::size_t end = std::min(left_.find('\xFF'), left_.size());
            all_ += left_.substr(0, end);
            connection_.send(left_.substr(0, end));
            left_.remove_prefix(std::min(end + 1, left_.size()));
            pause_ = 3;
            return true;
        }
        if (!std::exchange(is_over_, true)) connection_.end_sending();
        return !connection_.has_ended();
    }

    ServedConnection connection_;
    bool is_known_ = false;
    std::string text_;  ///< with the token inserted
    std::string_view left_;
    std::string all_;  ///< sent so far
    int pause_ = 0;
    bool is_over_ = false;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 1 || size > 40'000) return 0;
    Session({reinterpret_cast<const char*>(data), size}).run();
    return 0;
}
