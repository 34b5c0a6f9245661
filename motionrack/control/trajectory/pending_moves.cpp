// Numbers and tags of moves.
#include <algorithm>
#include <motionrack/control/trajectory/pending_moves.hpp>

namespace motionrack::control {

namespace {

constexpr std::int64_t tags = std::int64_t{1} << 30;

}  // namespace

std::int32_t PendingMoves::push(const TrajectoryMove& move) {
    moves_.push_back(move);
    return static_cast<std::int32_t>(pushed_++ % tags);
}

void PendingMoves::forget_before(std::int64_t number) {
    for (; first_ < number; ++first_) moves_.pop_front();
}

std::int64_t PendingMoves::number_of(std::int32_t tag) const {
    return first_ + (tag - first_ % tags + tags) % tags;
}

std::int64_t PendingMoves::first_in_builder() const {
    return pushed_ == flushed_ ? pushed_ : std::max(flushed_, reported_);
}

}  // namespace motionrack::control
