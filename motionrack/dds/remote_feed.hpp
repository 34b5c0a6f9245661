// Feeds the frames of a bus on another computer to a virtual card: every valid frame once, in order, between two runs
// of the rack.
#pragma once

#include <memory>
#include <motionrack/dds/subscriber.hpp>
#include <utility>

namespace motionrack::dds {

class RemoteFeed {
  public:
    /// `subscriber` must not be null.
    explicit RemoteFeed(std::unique_ptr<Subscriber> subscriber) : subscriber_(std::move(subscriber)) {}

    /// Receives a frame and the rack's time at which it enters.
    using Take = std::function<void(const Frame&, Instant now)>;

    /// Delivers the valid frames since the last call; returns their number. Call it between two runs of the rack's
    /// kernel, with the rack's time. A card marks its data stale two periods after its last frame, which is correct if
    /// the rack runs in real time; stale() uses this computer's clock.
    int give(Instant now, const Take& take) {
        struct Delivery {
            const Take& take;
            Instant now;
            int given;
        } call{take, now, 0};
        subscriber_->poll([&call](const Sample& sample, Validation verdict, Instant) {
            if (verdict != Validation::used) return;
            call.take(sample.frame, call.now);
            ++call.given;
        });
        return call.given;
    }

    bool stale() const { return subscriber_->judge().stale(); }
    Subscriber& subscriber() { return *subscriber_; }

  private:
    std::unique_ptr<Subscriber> subscriber_;
};

}  // namespace motionrack::dds
