// External starts: the list begins at once, or after a distance on the conveyor.
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

    /// Records a signal at the start input; the next tick evaluates it.
    void trigger() { ++starts_.triggers; }
    /// Executes simulate_ext_start: the next tick treats it as an external start with this track delay in counts.
    void ask(std::int64_t delay, std::int64_t encoder);
    /// Sets the track delay of later start signals in counts (0: immediate), and the encoder that measures it.
    void set_delay(std::int64_t delay, std::int64_t encoder) { starts_.delay = delay, starts_.encoder = encoder; }
    void set_position(std::int64_t position) { starts_.position = position; }
    /// Discards all pending starts.
    void stop();
    /// Discards values derived from the previous source of inputs; called when another source is attached.
    void forget_inputs() { not_due_.forget(); }

    bool waiting() const { return starts_.waiting > 0; }
    /// Returns true if simulate_ext_start was executed since the last tick.
    bool asked() const { return starts_.asked_count > 0; }
    bool at_rest() const { return starts_.waiting == 0 && starts_.triggers == 0 && starts_.asked_count == 0; }
    /// Queues the new starts and begins the lists whose start is due in the present tick.
    void take();
    /// Returns the ticks from the present one to the one in which the first waiting start is due, at most `limit`.
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
