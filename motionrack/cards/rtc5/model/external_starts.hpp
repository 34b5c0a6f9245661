// External starts: immediate, or after a distance on the conveyor.
#pragma once

#include <cstdint>
#include <motionrack/cards/rtc5/model/belt_encoders.hpp>
#include <motionrack/cards/rtc5/model/connections.hpp>
#include <motionrack/cards/rtc5/model/list_execution.hpp>
#include <motionrack/cards/rtc5/model/not_due.hpp>
#include <motionrack/cards/rtc5/model/status_flags.hpp>

namespace motionrack::rtc5 {

class ExternalStarts {
  public:
    /// `starts`, `control_mode` and `tick`: parts of the card's state, which must outlive this.
    ExternalStarts(Starts& starts, const std::int64_t& control_mode, const std::int64_t& tick, BeltEncoders& encoders,
                   ListExecution& list, StatusFlags& flags, const Connections& connections, BlockBuffers& buffers)
        : starts_(starts),
          control_mode_(control_mode),
          tick_(tick),
          encoders_(encoders),
          list_(list),
          flags_(flags),
          connections_(connections),
          buffers_(buffers) {}

    /// A signal at the start input.
    void trigger() { ++starts_.triggers; }
    /// simulate_ext_start
    void ask(std::int64_t delay, std::int64_t encoder);
    /// Track delay, and the encoder that measures it.
    void set_delay(std::int64_t delay, std::int64_t encoder) { starts_.delay = delay, starts_.encoder = encoder; }
    void set_position(std::int64_t position) { starts_.position = position; }
    /// Drops what waits.
    void stop();
    /// Other inputs are attached to the card.
    void forget_inputs() { not_due_.forget(); }

    bool waiting() const { return starts_.waiting > 0; }
    /// Starts were asked for since the last tick.
    bool asked() const { return starts_.asked_count > 0; }
    bool at_rest() const { return starts_.waiting == 0 && starts_.triggers == 0 && starts_.asked_count == 0; }
    /// Begins the starts that are due in the present tick.
    void take();
    /// Ticks from the present one to that of the first waiting start, at most `limit`.
    std::int64_t ticks_to_start(std::int64_t limit);

  private:
    void enqueue(std::int32_t delay, int encoder);
    void begin();
    void report(StartFate fate);

    Starts& starts_;
    const std::int64_t& control_mode_;
    const std::int64_t& tick_;
    BeltEncoders& encoders_;
    ListExecution& list_;
    StatusFlags& flags_;
    const Connections& connections_;
    BlockBuffers& buffers_;
    NotDue not_due_;
};

}  // namespace motionrack::rtc5
