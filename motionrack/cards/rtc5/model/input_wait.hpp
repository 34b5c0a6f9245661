// Finds the end of a wait for encoder counts or McBSP words.
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

    /// Returns how many of the next `limit` ticks the wait takes, including the one that ends it; sets `over` if it
    /// ends within them.
    std::int64_t ticks(std::int64_t limit, bool& over);
    /// Calculates the ticks of the wait from constant or simulated counts. Returns 2^60 if these counts never end the
    /// wait, -1 if ticks() must evaluate each tick.
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
