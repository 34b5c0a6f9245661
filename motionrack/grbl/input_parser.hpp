// Input of a Grbl port: real-time bytes, which act immediately at any position, and lines.
//
//   G1X10 ? F600
//   ──►  '?' acts now ─ "G1X10F600" is a line
//
// As in Grbl 1.1h, 128 bytes can wait; further bytes are lost without a message. A line's buffer holds 80 bytes,
// including its end.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

namespace motionrack::grbl {

enum class Realtime : std::uint8_t {
    reset,
    status,
    cycle_start,
    feed_hold,
    door,
    jog_cancel,
    feed_100,
    feed_plus_10,
    feed_minus_10,
    feed_plus_1,
    feed_minus_1,
    rapid_100,
    rapid_50,
    rapid_25,
    spindle_100,
    spindle_plus_10,
    spindle_minus_10,
    spindle_plus_1,
    spindle_minus_1,
    spindle_stop,
    flood,
    mist
};

struct RealtimeByte {
    std::uint8_t byte;
    Realtime what;
};
inline constexpr std::array<RealtimeByte, 22> realtime_bytes = {{
    {0x18, Realtime::reset},
    {'?', Realtime::status},
    {'~', Realtime::cycle_start},
    {'!', Realtime::feed_hold},
    {0x84, Realtime::door},
    {0x85, Realtime::jog_cancel},
    {0x90, Realtime::feed_100},
    {0x91, Realtime::feed_plus_10},
    {0x92, Realtime::feed_minus_10},
    {0x93, Realtime::feed_plus_1},
    {0x94, Realtime::feed_minus_1},
    {0x95, Realtime::rapid_100},
    {0x96, Realtime::rapid_50},
    {0x97, Realtime::rapid_25},
    {0x99, Realtime::spindle_100},
    {0x9A, Realtime::spindle_plus_10},
    {0x9B, Realtime::spindle_minus_10},
    {0x9C, Realtime::spindle_plus_1},
    {0x9D, Realtime::spindle_minus_1},
    {0x9E, Realtime::spindle_stop},
    {0xA0, Realtime::flood},
    {0xA1, Realtime::mist},
}};
std::optional<Realtime> realtime_of(std::uint8_t byte);

inline constexpr std::size_t max_waiting = 128, max_line_bytes = 79;

/// A line after Grbl's preprocessing: no blanks, no comments, upper case.
struct Line {
    std::string text;
    bool too_long = false;
};

/// Assembles lines from received bytes; buffers bytes until their line is read.
class InputParser {
  public:
    /// Adds one byte that is not a real-time byte. Returns false if the buffer was full and the byte is lost.
    bool put(std::uint8_t byte);
    /// Reads on to the end of the present line; returns nothing if the end has not arrived. Each CR and each LF ends a
    /// line.
    std::optional<Line> next();
    std::size_t free_bytes() const { return max_waiting - waiting_.size(); }
    /// Returns true if bytes wait, or if a line has begun and its end has not arrived.
    bool has_input() const { return !waiting_.empty() || has_begun_line(); }
    void clear() { *this = InputParser(); }

  private:
    void read(char c);
    bool has_begun_line() const { return !line_.text.empty() || line_.too_long || in_brackets_ || behind_semicolon_; }

    std::deque<char> waiting_;
    Line line_;
    bool in_brackets_ = false, behind_semicolon_ = false;
};

}  // namespace motionrack::grbl
