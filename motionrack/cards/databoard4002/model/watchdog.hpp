// The watchdog: it resets the card one second after the last pass of a firmware that hangs.
#pragma once

#include <cstdint>
#include <motionrack/cards/databoard4002/model/state.hpp>

namespace motionrack::databoard4002 {

class Watchdog {
  public:
    /// The references are parts of the card's state.
    Watchdog(Instant& due, std::uint8_t& hung) : due_(due), hung_(hung) {}

    bool hung() const { return hung_ != 0; }
    /// Instant of the reset; never while the firmware runs.
    Instant due() const { return due_; }

    /// The firmware hangs from now on. `last_pass`: its last pass.
    void hang(Instant last_pass) {
        if (!hung()) due_ = last_pass + watchdog_time;
        hung_ = 1;
    }
    /// The firmware runs.
    void restart() {
        hung_ = 0;
        due_ = never;
    }

  private:
    Instant& due_;
    std::uint8_t& hung_;
};

}  // namespace motionrack::databoard4002
