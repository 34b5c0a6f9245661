// Walking through the lines of a program.
#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <motionrack/control/gcode/reader.hpp>

namespace motionrack::control::gcode {

namespace {

/// A byte of `word` is zero where the highest bit of that byte of the result is set (and none below the first such byte
/// is wrong).
constexpr std::uint64_t zero_bytes(std::uint64_t word) {
    return (word - 0x0101010101010101u) & ~word & 0x8080808080808080u;
}

/// First CR or LF at or after `p`, or `end`.
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

Lines::Lines(std::string_view text) : at_(text.data()), end_(text.data() + text.size()) {
    if (text.substr(0, 3) == "\xEF\xBB\xBF") at_ += 3;
}

bool Lines::next(std::string_view& line) {
    const auto pass_end = [this] {
        if (at_ < end_) at_ += *at_ == '\r' && at_ + 1 < end_ && at_[1] == '\n' ? 2 : 1;
    };
    if (skip_) {
        at_ = find_line_end(at_, end_);
        pass_end();
        skip_ = false;
    }
    if (at_ == end_) return false;
    constexpr std::ptrdiff_t most = longest_line + 1;
    const char* begin = at_;
    at_ = find_line_end(begin, end_ - begin > most ? begin + most : end_);
    line = std::string_view(begin, static_cast<std::size_t>(at_ - begin));
    if (line.size() == static_cast<std::size_t>(most))
        skip_ = true;
    else
        pass_end();
    if (number_ < std::numeric_limits<std::int32_t>::max()) ++number_;
    return true;
}

bool ProgramEnd::at(const Block& block) {
    const bool stops = block.has_m(m_stop) && block.m[m_stop] >= 2;
    const bool closes = block.percent && begun_;
    begun_ = begun_ || block.percent || (block.words | block.g_groups | block.m_groups) != 0;
    return stops || closes;
}

Reader::Reader(std::string_view text, const Settings& settings, std::string file)
    : lines_(text), interpreter_(settings), file_(std::move(file)) {}

Outcome<const Step*> Reader::next_from_lines() {
    std::string_view text;
    while (!over_ && lines_.next(text)) {
        if (auto done = interpreter_.line(text, lines_.number()); !done) {
            done.error().file = file_;
            const std::size_t column = static_cast<std::size_t>(done.error().place.column);
            if (lines_.at_end() && done.error().word == "(" && text.find(')', column) == std::string_view::npos) {
                done.error().message = "the text ends inside this comment; is the file complete?";
            }
            return tl::unexpected<Problem>(std::move(done.error()));
        }
        over_ = end_.at(interpreter_.block());
        if (const Step* step = interpreter_.pull()) return step;
    }
    over_ = true;
    if (auto done = interpreter_.finish(); !done) {
        done.error().file = file_;
        return tl::unexpected<Problem>(std::move(done.error()));
    }
    return interpreter_.pull();
}

Check check_program(std::string_view text, const Settings& settings, std::size_t most_problems,
                    const std::string& file) {
    Check check;
    check.least = check.greatest = settings.start;
    Reader reader(text, settings, file);
    for (;;) {
        const auto step = reader.next();
        if (!step) {
            check.problems.push_back(step.error());
            if (check.problems.size() < most_problems) continue;
            check.more_problems = true;
            break;
        }
        if (*step == nullptr) break;
        if ((*step)->kind != StepKind::move) continue;
        const Move& move = (*step)->move;
        if (move.kind == MoveKind::dwell) {
            ++check.dwells;
            check.seconds_of_dwells += move.seconds;
            continue;
        }
        ++check.moves;
        for (int axis = 0; axis < axis_count; ++axis) {
            check.least[axis] = std::min(check.least[axis], move.end[axis]);
            check.greatest[axis] = std::max(check.greatest[axis], move.end[axis]);
        }
    }
    check.lines = reader.line();
    check.ended = reader.interpreter().modes().ended;
    return check;
}

}  // namespace motionrack::control::gcode
