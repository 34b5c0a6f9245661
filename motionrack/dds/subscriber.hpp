// A listener on a bus: takes frames from the network as they come and has them judged when it is polled. It has no
// writer and asks for no repetition, so that it cannot disturb the publisher or anyone else.
#pragma once

#include <functional>
#include <memory>
#include <motionrack/dds/frame_validator.hpp>
#include <string>

namespace motionrack::dds {

struct SubscriberSettings {
    std::string bus = "stage";
    int domain = 0;
    ValidatorSettings judge;
    std::size_t queue =
        1024;  ///< samples that may wait between two polls; more are dropped, the oldest first, and counted
    bool other_participants_only = false;  ///< for a publisher that listens whether it is alone
    int participant = 0;                   ///< the engine's participant to use; 0: one of its own
};

class Subscriber {
  public:
    /// Errors: invalid_input (name, domain), io (no network interface, a wrong configuration).
    static Result<std::unique_ptr<Subscriber>> open(const SubscriberSettings& settings);
    virtual ~Subscriber() = default;

    /// Is called for every sample that waited, with its verdict, in the order in which they were received.
    using Use = std::function<void(const Sample&, Validation, Instant received)>;
    /// Judges what waits, and then what is stale. Gives the time at which it looked.
    virtual Instant poll(const Use& use) = 0;
    /// Returns when something waits, at most after `timeout`; true if something does.
    virtual bool wait(Duration timeout) = 0;
    /// Samples dropped because nobody polled.
    virtual std::uint64_t overruns() const = 0;

    FrameValidator& judge() { return judge_; }
    const FrameValidator& judge() const { return judge_; }

  protected:
    explicit Subscriber(const ValidatorSettings& settings) : judge_(settings) {}
    FrameValidator judge_;
};

}  // namespace motionrack::dds
