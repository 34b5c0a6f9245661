// Lines of a sender, in order: its bytes that wait, and the next line while that has to wait.
#pragma once

#include <cstdint>
#include <motionrack/grbl/input_parser.hpp>
#include <optional>

namespace motionrack::grbl {

class LineReader {
  public:
    /// Adds one byte that is not a real-time byte; it is lost if the buffer is full.
    void put(std::uint8_t byte) { (void)parser_.put(byte); }
    /// Returns the next line, which waits until it is taken; nothing if its end has not arrived.
    const Line* next();
    /// Requires a line that waits.
    Line take();
    bool has_line() const { return line_.has_value(); }
    std::size_t free_bytes() const { return parser_.free_bytes(); }
    /// Discards all input.
    void clear();

  private:
    InputParser parser_;
    std::optional<Line> line_;
};

}  // namespace motionrack::grbl
