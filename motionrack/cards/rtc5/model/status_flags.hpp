// Marking info, start and stop info, and the limits of the corrected position, which set flags of the marking info.
#pragma once

#include <cstddef>
#include <cstdint>
#include <motionrack/cards/rtc5/model/block_buffers.hpp>
#include <motionrack/cards/rtc5/model/state.hpp>

namespace motionrack::rtc5 {

class StatusFlags {
  public:
    /// Both are parts of the card's state, which must outlive this.
    StatusFlags(FlagsState& flags, FlyLimits& limits) : flags_(flags), limits_(limits) {}

    /// Sets bits of the marking info; stores `tick` for those that were clear.
    void raise(std::uint32_t bits, std::int64_t tick);
    /// Sets the sequence error of an encoder: both of its lines changed at one instant.
    void raise_sequence_error(int encoder, std::int64_t tick) {
        raise(encoder == 0 ? marking_bit("ENCODER_X_SEQUENCE") : marking_bit("ENCODER_Y_SEQUENCE"), tick);
    }
    void raise_startstop(std::uint32_t bits) { flags_.startstop_info |= bits; }
    /// Raises the flags for the corrected positions of a block that begins at tick `first`; `extent`: their extent.
    void check(const BlockBuffers& b, const PlanExtent& extent, std::int64_t first);
    void check_z(double z, std::int64_t tick);
    /// Returns true if a position is so far inside the field and its limits that it can set no flag. Axis: 0 X, 1 Y.
    bool is_inside(double bits, std::size_t axis) const;

    /// Executes set_fly_limits or set_fly_limits_z.
    void set_limits(const Command& c);
    /// Executes clear_fly_overflow: clears the LIMIT bits of X (mode bit 0), Y (bit 1), Z (bit 2); 0: all.
    void clear_limit_flags(std::int64_t mode);
    /// Evaluates a condition such as if_fly_x_overflow; returns its result and clears the flags that it evaluates.
    bool take_condition(const Command& c);
    /// Returns the marking info and clears the bits that a reading clears.
    std::uint32_t take_marking_info();
    std::uint32_t startstop_info() const { return static_cast<std::uint32_t>(flags_.startstop_info); }
    void clear_startstop_info() { flags_.startstop_info = 0; }

  private:
    FlagsState& flags_;
    FlyLimits& limits_;
};

}  // namespace motionrack::rtc5
