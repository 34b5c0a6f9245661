// The end of a wait for encoder counts or McBSP words.
#pragma once

#include <cstddef>
#include <cstdint>
#include <motionrack/cards/rtc5/model/belt_encoders.hpp>
#include <motionrack/cards/rtc5/model/mcbsp_receiver.hpp>

namespace motionrack::rtc5 {

class InputWait {
  public:
    /// `activity`: part of the card's state, with the wait to evaluate. All arguments must outlive this.
    InputWait(const Activity& activity, BeltEncoders& encoders, McBspReceiver& mcbsp, BlockBuffers& buffers)
        : activity_(activity), encoders_(encoders), mcbsp_(mcbsp), buffers_(buffers) {}

    /// Number of ticks of the wait among the next `limit`, including the one that ends it; `over`: it ends in them.
    std::int64_t ticks(std::int64_t limit, bool& over);
    /// Number of ticks of the wait as ticks() finds it, but calculated from constant or simulated counts; 2^60: these
    /// counts never end the wait; -1: ticks() must evaluate each tick.
    std::int64_t steady_ticks(bool& over) const;

  private:
    bool met(std::int64_t before, std::int64_t present) const;
    bool met_at(std::size_t i) const;
    bool met_now() const;

    const Activity& activity_;
    BeltEncoders& encoders_;
    McBspReceiver& mcbsp_;
    BlockBuffers& buffers_;
};

}  // namespace motionrack::rtc5
