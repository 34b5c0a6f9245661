// The watchdog: it resets the card one second after the last pass of a firmware that hangs.
#pragma once

#include <cstdint>
#include <motionrack/cards/databoard4002/model/state.hpp>

namespace motionrack::databoard4002 {

class Watchdog {
  public:
    /// The references are parts of the card's state, which must outlive this.
    Watchdog(Instant& due, FirmwareState& firmware) : due_(due), firmware_(firmware) {}

    bool hung() const { return firmware_ == FirmwareState::hung; }
    /// Instant of the reset; never while the firmware runs.
    Instant due() const { return due_; }

    /// The firmware hangs from now on. `last_pass`: its last pass.
    void hang(Instant last_pass) { FirmwareSteps::run(*this, FirmwareEvent::hang, last_pass); }
    /// The firmware runs.
    void restart() { FirmwareSteps::run(*this, FirmwareEvent::restart, never); }

  private:
    enum class FirmwareEvent : std::uint8_t { hang, restart };

    struct FirmwareSteps {
        static void wait(Watchdog& watchdog, Instant last_pass) { watchdog.due_ = last_pass + watchdog_time; }
        static void rest(Watchdog& watchdog, Instant) { watchdog.due_ = never; }

        static constexpr StateRow<Watchdog, FirmwareState, FirmwareEvent, Instant> rows[] = {
            {FirmwareState::running, FirmwareEvent::hang, FirmwareState::hung, nullptr, wait},
            {FirmwareState::hung, FirmwareEvent::restart, FirmwareState::running, nullptr, rest},
        };
        static_assert(declared<rows_flaw(machine_named(map::machines, "firmware"), rows)>());

        static void run(Watchdog& watchdog, FirmwareEvent event, Instant last_pass) {
            step(rows, watchdog.firmware_, event, watchdog, last_pass);
        }
    };

    Instant& due_;
    FirmwareState& firmware_;
};

}  // namespace motionrack::databoard4002
