// Negates positions and rates.
#include <algorithm>
#include <motionrack/rack/position_functions.hpp>

namespace motionrack::rack {

void InvertedPosition::watch(int slot, std::int64_t below, std::int64_t above) {
    of_.watch(slot, above == sim::unwatched_above ? sim::unwatched_below : -above,
              below == sim::unwatched_below ? sim::unwatched_above : -below);
}

int InvertedPosition::add_listener(sim::PositionListener& listener) {
    listeners_.push_back(std::make_unique<Observer>(listener));
    return of_.add_listener(*listeners_.back());
}

void InvertedPosition::set_edge_listener(sim::EdgeListener* listener) {
    edge_listener_ = listener;
    of_.set_edge_listener(listener != nullptr ? this : nullptr);
}

void InvertedPosition::edges(const sim::EdgeBatch& batch) {
    mirrored_.origin = batch.origin;
    mirrored_.tick = batch.tick;
    mirrored_.first_count = -batch.first_count;
    mirrored_.step = -batch.step;
    mirrored_.size = batch.size;
    std::copy_n(batch.at.begin(), batch.size, mirrored_.at.begin());
    edge_listener_->edges(mirrored_);
}

}  // namespace motionrack::rack
