// Subscriber of a bus: receives frames from the network and validates them when it is polled. It has no writer and
// requests no repetition, so it cannot disturb the publisher or other participants.
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
    /// Capacity between two polls, samples; a further sample replaces the oldest one and counts as an overrun.
    std::size_t queue = 1024;
    /// True: ignores writers of the same participant; a publisher detects conflicts with it.
    bool other_participants_only = false;
    int participant = 0;  ///< handle of the DDS participant to use; 0: creates one
};

class Subscriber {
  public:
    /// Opens a subscriber. Errors: invalid_input (name, domain), io (no network interface, a wrong configuration).
    static Result<std::unique_ptr<Subscriber>> open(const SubscriberSettings& settings);
    virtual ~Subscriber() = default;

    /// Receives every waiting sample with its validation result, in order of reception.
    using Use = std::function<void(const Sample&, Validation, Instant received)>;
    /// Validates the waiting samples, then checks for stale data. Returns the time of the poll.
    virtual Instant poll(const Use& use) = 0;
    /// Waits for a sample, at most `timeout`; returns true if one is waiting.
    virtual bool wait(Duration timeout) = 0;
    /// Returns the number of samples dropped because polling was too slow.
    virtual std::uint64_t overruns() const = 0;

    FrameValidator& judge() { return judge_; }
    const FrameValidator& judge() const { return judge_; }

  protected:
    explicit Subscriber(const ValidatorSettings& settings) : judge_(settings) {}
    FrameValidator judge_;
};

}  // namespace motionrack::dds
