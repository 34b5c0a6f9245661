// The host's side: publishes the frames of one card on a bus, and listens whether anyone else does.
#pragma once

#include <memory>
#include <motionrack/dds/frame_validator.hpp>
#include <string>

namespace motionrack::dds {

struct PublisherSettings {
    std::string bus = "stage";
    int domain = 0;
    Duration period = microseconds(200);  ///< time of the bus between two frames
    Duration pace = microseconds(200);    ///< real time between two frames
};

class Publisher {
  public:
    /// Errors: invalid_input (name, domain, period or pace outside 1 us to 60 s), io.
    static Result<std::unique_ptr<Publisher>> open(const PublisherSettings& settings);
    virtual ~Publisher() = default;

    /// Sends the frame; never waits for a subscriber. False if it was not sent, because its CRC is not that of its
    /// content or the network refused it: both are counted.
    virtual bool publish(const Frame& frame) = 0;
    /// Looks who else publishes; a conflict's event has this publisher as `source`.
    virtual void look() = 0;
    virtual bool next_event(Event& event) = 0;

    const Source& source() const { return source_; }
    std::uint64_t sent() const { return sent_; }
    std::uint64_t unsound() const { return unsound_; }  ///< frames that were not sent, because they were damaged before
    std::uint64_t refused() const { return refused_; }  ///< frames that the network did not take
    std::uint64_t foreign_frames() const { return foreign_frames_; }  ///< heard from other publishers

  protected:
    Source source_;
    std::uint64_t sent_ = 0, unsound_ = 0, refused_ = 0, foreign_frames_ = 0;
};

}  // namespace motionrack::dds
