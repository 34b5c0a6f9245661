// Records signals, and sends them over McBSP.
#pragma once

#include <cstddef>
#include <cstdint>
#include <motionrack/cards/rtc5/model/head_transforms.hpp>
#include <motionrack/cards/rtc5/model/state.hpp>
#include <motionrack/cards/rtc5/model/zeroed_array.hpp>
#include <span>

namespace motionrack::rtc5 {

class SignalRecorder {
  public:
    /// `recording` and `sender`: parts of the card's state `card`, which must outlive this; the signals are values of
    /// it.
    SignalRecorder(Recording& recording, Sender& sender, const State& card, const HeadTransforms& heads)
        : recording_(recording), sender_(sender), card_(card), heads_(heads) {}

    /// Executes set_trigger or set_trigger4.
    void begin(const Command& c, std::int64_t tick);
    /// Ends a recording; its samples are kept.
    void stop() { recording_.period = 0; }
    /// Returns the ticks to the next sample while recording continues; 0: the present tick.
    std::int64_t ticks_to_sample() const;
    /// Returns true if the present tick has a sample; called after the commands of the tick.
    bool samples_now() const { return ticks_to_sample() == 0; }
    /// Records the present tick; requires its output.
    void record();

    const Recording& recording() const { return recording_; }
    /// Returns sample `i` of `channel` (0 .. 3).
    std::int32_t recorded(std::int64_t channel, std::int64_t i) const {
        return samples_[static_cast<std::size_t>(i * recording_.channels + channel)];
    }
    /// Takes the samples, which are not part of the state, from the card whose state was copied.
    void copy_samples(const SignalRecorder& other);

    /// Returns the value of a signal in the last tick. Errors: refused if the card has no signal of that number.
    Result<std::int32_t> value(std::uint32_t signal) const;
    /// Executes set_mcbsp_out: sends up to 8 signals in turn, one per tick, from the next tick on; none: sending ends.
    Result<void> send(std::span<const std::uint32_t> signals);
    /// Returns the word sent over McBSP in the last tick; 0 while sending is off.
    std::int32_t sent() const;

  private:
    std::int32_t value_of(const SignalInfo& signal) const;

    Recording& recording_;
    Sender& sender_;
    const State& card_;
    const HeadTransforms& heads_;
    ZeroedArray<std::int32_t> samples_{record_values};
};

}  // namespace motionrack::rtc5
