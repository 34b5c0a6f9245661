// Finds the ends of lines, eight characters at a time.
#include <bit>
#include <cstring>
#include <limits>
#include <motionrack/control/gcode/block.hpp>
#include <motionrack/control/gcode/program_lines.hpp>

namespace motionrack::control::gcode {

namespace {

/// Sets the highest bit of every byte that is zero in `word`; bytes below the first such byte are exact.
constexpr std::uint64_t zero_bytes(std::uint64_t word) {
    return (word - 0x0101010101010101u) & ~word & 0x8080808080808080u;
}

/// Returns the first CR or LF at or after `p`, or `end`.
const char* find_line_end(const char* p, const char* end) {
    constexpr std::uint64_t every_lf = 0x0a0a0a0a0a0a0a0au;
    constexpr std::uint64_t every_cr = 0x0d0d0d0d0d0d0d0du;
    if constexpr (std::endian::native == std::endian::little) {
        while (end - p >= 8) {
            std::uint64_t word = 0;
            std::memcpy(&word, p, 8);
            const std::uint64_t found = zero_bytes(word ^ every_lf) | zero_bytes(word ^ every_cr);
            if (found != 0) return p + std::countr_zero(found) / 8;
            p += 8;
        }
    }
    while (p < end && *p != '\n' && *p != '\r') ++p;
    return p;
}

}  // namespace

ProgramLines::ProgramLines(std::string_view text) : at_(text.data()), end_(text.data() + text.size()) {
    if (text.substr(0, 3) == "\xEF\xBB\xBF") at_ += 3;
}

bool ProgramLines::next(std::string_view& line) {
    const auto pass_end = [this] {
        if (at_ < end_) at_ += *at_ == '\r' && at_ + 1 < end_ && at_[1] == '\n' ? 2 : 1;
    };
    if (skip_) {
        at_ = find_line_end(at_, end_);
        pass_end();
        skip_ = false;
    }
    if (at_ == end_) return false;
    constexpr std::ptrdiff_t max_bytes = max_line_length + 1;
    const char* begin = at_;
    at_ = find_line_end(begin, end_ - begin > max_bytes ? begin + max_bytes : end_);
    line = std::string_view(begin, static_cast<std::size_t>(at_ - begin));
    if (line.size() == static_cast<std::size_t>(max_bytes))
        skip_ = true;
    else
        pass_end();
    if (number_ < std::numeric_limits<std::int32_t>::max()) ++number_;
    return true;
}

}  // namespace motionrack::control::gcode
