// Recording of signals, and their transmission over McBSP.
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

    /// set_trigger and set_trigger4.
    void begin(const Command& c, std::int64_t tick);
    /// Ends a recording; its samples are kept.
    void stop() { recording_.period = 0; }
    /// Ticks to the next sample if the list continues to run; 0: the present tick.
    std::int64_t ticks_to_sample() const;
    /// True if the present tick has a sample; called after its commands.
    bool samples_now() const { return ticks_to_sample() == 0; }
    /// Records the present tick; requires its output.
    void record();

    const Recording& recording() const { return recording_; }
    /// Sample `i` of `channel` (0 ..).
    std::int32_t recorded(std::int64_t channel, std::int64_t i) const {
        return samples_[static_cast<std::size_t>(i * recording_.channels + channel)];
    }
    /// Takes the samples, which are not part of the state, from the card whose state was copied.
    void copy_samples(const SignalRecorder& other);

    /// Value of a signal in the last tick.
    Result<std::int32_t> value(std::uint32_t signal) const;
    /// set_mcbsp_out: signals that are sent from the next tick on, one per tick, in turn; none: sending ends. At
    /// most 8.
    Result<void> send(std::span<const std::uint32_t> signals);
    /// The word sent in the last tick; 0 while sending is off.
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
