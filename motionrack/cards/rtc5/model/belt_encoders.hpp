// The encoders of the conveyor: counts tick by tick, in blocks and over intervals, from inputs or simulated.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <motionrack/cards/rtc5/model/block_buffers.hpp>
#include <motionrack/cards/rtc5/model/connections.hpp>
#include <motionrack/cards/rtc5/model/state.hpp>

namespace motionrack::rtc5 {

/// Returns the low 32 bits of `v` as a signed number, because the card's counters wrap.
inline std::int32_t wrapped(std::int64_t v) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(v));
}

class BeltEncoders {
  public:
    /// `state` and `tick`: parts of the card's state, which must outlive this.
    BeltEncoders(EncodersState& state, const std::int64_t& tick, const Connections& connections, BlockBuffers& buffers)
        : state_(state), tick_(tick), connections_(connections), buffers_(buffers) {}

    const BeltCounter& counter(std::size_t encoder) const { return state_.counters[encoder]; }
    std::int32_t count(std::size_t encoder) const { return state_.counters[encoder].count(); }
    /// Returns the count that the correction uses in the present tick: the count plus the tracking error (ticks) times
    /// the counts per tick.
    double effective(std::size_t encoder) const;
    std::int64_t tracking_error(std::size_t encoder) const { return state_.tracking_error[encoder]; }

    // ---- running
    /// Reads both encoders in the present tick.
    void sample();
    /// Advances both encoders from the present tick to the last of the `n` ticks that begin with it.
    void advance(std::int64_t n);
    /// Writes the counts of the next `n` ticks, the present one first, to the buffer of counts.
    void load_counts(std::size_t encoder, std::size_t n);
    /// Writes the counts with the tracking error, as effective() defines them, to the buffer of effective values.
    void load_effective(std::size_t encoder, std::size_t n);
    void zero(std::size_t encoder) { state_.counters[encoder].zero = state_.counters[encoder].travel; }
    void zero_at_start(std::size_t encoder) { state_.counters[encoder].reset_at_start = 1; }
    /// Zeroes the encoders that wait for an external start; called when such a start begins a list.
    void take_start();

    // ---- commands
    void set_count(int encoder, std::int32_t counts) { state_.input[static_cast<std::size_t>(encoder)] = counts; }
    void set_tracking_error(std::uint16_t x, std::uint16_t y) { state_.tracking_error = {x, y}; }
    Result<void> simulate(int which);
    /// Executes store_encoder: stores both counts at `pos` 0 or 1.
    void store(std::size_t pos);
    /// Returns both counts that store_encoder stored at `pos` 0 or 1.
    std::array<std::int32_t, 2> stored(int pos) const;
    /// Executes set_encoder_speed. `encoder`: 0, 1, or 2 and 3 for both; `counts_ms`: target, clipped to 100 .. 16000
    /// counts/ms; `smooth`: 0 (no filter) to 1.
    Result<void> watch_speed(int encoder, double counts_ms, double smooth);
    bool speed_watched() const { return state_.speed_watched != 0; }
    /// Returns the filtered encoder speed in counts/ms; 0 while no speed is watched.
    double speed() const;

  private:
    void filter_speed(std::size_t first, std::size_t n);

    EncodersState& state_;
    const std::int64_t& tick_;
    const Connections& connections_;
    BlockBuffers& buffers_;
};

}  // namespace motionrack::rtc5
