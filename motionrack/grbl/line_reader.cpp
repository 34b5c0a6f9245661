#include <motionrack/grbl/line_reader.hpp>
#include <utility>

namespace motionrack::grbl {

const Line* LineReader::next() {
    if (!line_) line_ = parser_.next();
    return line_ ? &*line_ : nullptr;
}

Line LineReader::take() {
    return *std::exchange(line_, std::nullopt);
}

void LineReader::clear() {
    parser_.clear();
    line_.reset();
}

}  // namespace motionrack::grbl
