#include <algorithm>
#include <motionrack/control/gcode/number.hpp>
#include <motionrack/grbl/input_parser.hpp>
#include <motionrack/grbl/introduction.hpp>
#include <utility>

namespace motionrack::grbl {

namespace {

constexpr char reset_byte = '\x18';

/// Returns true for bytes that a sender may send before its first line, as when it searches for a Grbl: ? ! ~ ^X and
/// line ends.
bool is_greeting(char c) {
    return c == '?' || c == '!' || c == '~' || c == '\r' || c == '\n' || c == reset_byte;
}

/// Returns true if HTTP could have a method of these characters; that of a browser's page can be as long as its first
/// packet.
bool is_long_method(std::string_view bytes) {
    constexpr std::size_t max_of_a_sender = 16;
    return bytes.size() > max_of_a_sender && bytes.find_first_not_of("!~") == std::string_view::npos;
}

/// Returns true for "METHOD TARGET HTTP/VERSION", whatever its method and target are: RFC 9112, 3.
bool is_request_line(std::string_view line) {
    constexpr std::string_view protocol = " HTTP/";
    const std::size_t at = line.rfind(protocol);
    return at != std::string_view::npos &&
           line.find_first_not_of("0123456789. \t", at + protocol.size()) == std::string_view::npos;
}

/// Returns true for letters with numbers, as in "G1X-1.5F600" and "M115".
bool is_words(std::string_view text) {
    const char *at = text.data(), *const end = text.data() + text.size();
    while (at < end) {
        if (*at < 'A' || *at > 'Z') return false;
        ++at;
        if (control::gcode::scan_number(at, end).fault != control::gcode::NumberFault::none) return false;
    }
    return true;
}

/// Returns true if a G-code sender may send this line; a comment counts. "[ESP..]" asks a wireless serial adapter for
/// its identity.
bool is_line_of_a_sender(const Line& line) {
    const std::string& text = line.text;
    if (line.too_long) return false;
    return text.empty() || text[0] == '$' || text == "%" || text.rfind("[ESP", 0) == 0 || is_words(text);
}

/// Returns true for text as senders write it; comments may use other alphabets.
bool is_text(std::string_view bytes) {
    bool comment = false;
    for (const char c : bytes) {
        if (c == '\r' || c == '\n')
            comment = false;
        else if (c == '(' || c == ';')
            comment = true;
        const bool control = (c >= 0 && c < ' ') || c == '\x7F';
        if (control && c != '\t' && !is_greeting(c)) return false;
        if (static_cast<unsigned char>(c) > 0x7F && !comment) return false;
    }
    return true;
}

}  // namespace

Introduction::Verdict Introduction::receive(std::string_view bytes) {
    bytes_ += bytes;
    if (!is_text(bytes_)) return Verdict::stranger;
    const bool is_greeted = std::all_of(bytes_.begin(), bytes_.end(), is_greeting);
    if (is_greeted && !is_long_method(bytes_)) return bytes_.empty() ? Verdict::open : Verdict::sender;
    InputParser lines;
    bool begun = false;  // a line with content
    std::string raw;     // the line as it was sent
    for (const char c : bytes_) {
        const bool ends = c == '\n' || c == '\r';
        if (ends && is_request_line(std::exchange(raw, {}))) return Verdict::stranger;
        if (!ends) raw += c;
        if (realtime_of(static_cast<std::uint8_t>(c))) continue;
        lines.put(static_cast<std::uint8_t>(c));
        const auto line = lines.next();
        if (line && begun) return is_line_of_a_sender(*line) ? Verdict::sender : Verdict::stranger;
        begun = begun || !line;
    }
    return bytes_.size() > max_open_bytes ? Verdict::stranger : Verdict::open;
}

}  // namespace motionrack::grbl
