// Switches the laser's gate at once or later, with a resolution of half a microsecond.
#pragma once

#include <cstdint>
#include <motionrack/cards/rtc5/model/block_buffers.hpp>
#include <motionrack/cards/rtc5/model/connections.hpp>
#include <motionrack/cards/rtc5/model/state.hpp>

namespace motionrack::rtc5 {

class LaserControl {
  public:
    /// `laser` and `tick`: parts of the card's state, which must outlive this.
    LaserControl(Laser& laser, const std::int64_t& tick, const Connections& connections, BlockBuffers& buffers)
        : laser_(laser), tick_(tick), connections_(connections), buffers_(buffers) {}

    /// Begins a tick or block: its laser samples are not written yet.
    void begin_tick() { filled_ = tick_; }
    /// Switches the laser `half_us` half-microseconds after tick 0, but not before `tick`; drops later changes. A
    /// disabled laser stays off.
    void switch_at(std::int64_t half_us, bool on, std::int64_t tick);
    /// Switches the laser at the begin of the present tick.
    void switch_now(bool on);
    /// Drops the pending changes and switches the laser off.
    void switch_off();
    void enable() { laser_.disabled = 0; }
    /// Switches the laser off and keeps it off until enable().
    void disable();
    /// Executes the changes before `tick`, and writes their samples for a sink.
    void run_until(std::int64_t tick);

  private:
    Laser& laser_;
    const std::int64_t& tick_;
    const Connections& connections_;
    BlockBuffers& buffers_;
    std::int64_t filled_ = 0;  // tick up to which the laser samples are written
};

}  // namespace motionrack::rtc5
