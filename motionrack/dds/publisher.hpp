// Publishes the frames of one card on a bus, and detects other publishers of the bus.
#pragma once

#include <memory>
#include <motionrack/dds/frame_validator.hpp>
#include <string>

namespace motionrack::dds {

struct PublisherSettings {
    std::string bus = "stage";
    int domain = 0;
    Duration period = microseconds(200);  ///< bus time between two frames
    Duration pace = microseconds(200);    ///< real time between two frames
};

class Publisher {
  public:
    /// Opens a publisher. Errors: invalid_input (name, domain, period or pace outside 1 us to 60 s), io.
    static Result<std::unique_ptr<Publisher>> open(const PublisherSettings& settings);
    virtual ~Publisher() = default;

    /// Sends the frame; never waits for a subscriber. Returns false if it was not sent, because its CRC does not match
    /// its content or the network refused it: both are counted.
    virtual bool publish(const Frame& frame) = 0;
    /// Checks for other publishers; the `source` of a conflict event is this publisher.
    virtual void poll() = 0;
    virtual bool next_event(BusEvent& event) = 0;

    const PublisherIdentity& source() const { return source_; }
    std::uint64_t sent() const { return sent_; }
    std::uint64_t unsound() const { return unsound_; }  ///< frames not sent because they were already damaged
    std::uint64_t refused() const { return refused_; }  ///< frames refused by the network
    std::uint64_t foreign_frames() const { return foreign_frames_; }  ///< received from other publishers

  protected:
    PublisherIdentity source_;
    std::uint64_t sent_ = 0, unsound_ = 0, refused_ = 0, foreign_frames_ = 0;
};

}  // namespace motionrack::dds
