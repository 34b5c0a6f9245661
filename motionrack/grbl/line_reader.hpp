// Lines of a sender, in order: buffers its bytes, and the next line until that can be processed.
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
    /// Returns the line that next() has returned, and removes it. Requires has_line().
    Line take();
    bool has_line() const { return line_.has_value(); }
    /// Returns true if a line waits, or if bytes of one have arrived.
    bool has_input() const { return has_line() || parser_.has_input(); }
    std::size_t free_bytes() const { return parser_.free_bytes(); }
    /// Discards all input.
    void clear();

  private:
    InputParser parser_;
    std::optional<Line> line_;
};

}  // namespace motionrack::grbl
