// Wobbel motion: while a polyline is marked, the position circles on an ellipse about the path.
//
//        transversal * sin
//          ▲    ╭──╮
//   path ──┼───►│  │───► longitudinal * cos, along the motion
//               ╰──╯
#pragma once

#include <cstddef>
#include <cstdint>
#include <motionrack/cards/rtc5/model/state.hpp>

namespace motionrack::rtc5 {

class WobbelMotion {
  public:
    /// All three are parts of the card's state, which must outlive this.
    WobbelMotion(Wobbel& wobbel, const Lists& lists, const Activity& activity)
        : wobbel_(wobbel), lists_(lists), activity_(activity) {}

    /// Executes set_wobbel: amplitudes in bits and the frequency of the ellipse.
    void set(const Command& c);
    /// Returns true if the position circles in the present tick; called after the tick's commands.
    bool active() const { return wobbel_.on() && lists_.marking && !lists_.paused; }
    void begin_polyline() {
        wobbel_.step = 0;
        wobbel_.direction = {1, 0};
    }
    /// Adds the ellipse to the positions of n ticks of the activity, from its step `first` on.
    void add(double* x, double* y, std::size_t n, std::int64_t first);
    /// Records that the position of the last tick is on the path.
    void clear_offset() { wobbel_.offset = {}; }
    /// Returns the offset from the path in the last tick, bits.
    Point offset() const { return wobbel_.offset; }

  private:
    Wobbel& wobbel_;
    const Lists& lists_;
    const Activity& activity_;
};

}  // namespace motionrack::rtc5
