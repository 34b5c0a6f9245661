// Assembles lines from bytes.
#include <motionrack/grbl/input_parser.hpp>
#include <utility>

namespace motionrack::grbl {

std::optional<Realtime> realtime_of(std::uint8_t byte) {
    for (const RealtimeByte& one : realtime_bytes)
        if (one.byte == byte) return one.what;
    return std::nullopt;
}

bool InputParser::put(std::uint8_t byte) {
    if (byte > 0x7F) return true;  // discarded, as in UTF-8 text
    if (waiting_.size() >= max_waiting) return false;
    waiting_.push_back(static_cast<char>(byte));
    return true;
}

std::optional<Line> InputParser::next() {
    while (!waiting_.empty()) {
        const char c = waiting_.front();
        waiting_.pop_front();
        if (c != '\n' && c != '\r') {
            read(c);
            continue;
        }
        in_brackets_ = behind_semicolon_ = false;
        return std::exchange(line_, {});
    }
    return std::nullopt;
}

void InputParser::read(char c) {
    if (in_brackets_) {
        in_brackets_ = c != ')';
    } else if (c == '(') {
        in_brackets_ = !behind_semicolon_;
    } else if (c == ';') {
        behind_semicolon_ = true;
    } else if (c > ' ' && c != '/' && !behind_semicolon_) {
        if (line_.text.size() < max_line_bytes)
            line_.text += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
        else
            line_.too_long = true;
    }
}

}  // namespace motionrack::grbl
