// A position loop closed through the bus' frames: every frame gives a position, and the position a voltage for the
// period that follows.
//
//   frame ──► count, unwrapped ──► nm ──┐
//                                       ▼
//   profile ──► wanted ───────────────(-)──► error ──► P + I + D ──┐
//         └──► speed, acceleration ──► feed-forward ──────────────(+)──► limit ──► volts
//
// A frame that is not sound or not newer is not used. Stale data and too great an error open the loop: 0 V, and the
// position is not trusted until close().
#pragma once

#include <cstdint>
#include <motionrack/base/time.hpp>
#include <motionrack/cards/grating_bus/frame.hpp>
#include <motionrack/cards/grating_bus/processor/profile.hpp>

namespace motionrack::grating_bus {

struct ServoGains {
    double p = 0;         ///< V for a nm
    double i = 0;         ///< V for a nm s
    double d = 0;         ///< V for a nm/s
    double speed_ff = 0;  ///< V for a nm/s
    double accel_ff = 0;  ///< V for a nm/s2
};

/// Gains that make the open loop cross 1 at `bandwidth_hz` (about a twentieth of the frames' rate leaves room for the
/// frames' own delay), for a stage that is accelerated by `accel_per_volt` m/s2 for a volt and braked by `viscous` m/s2
/// for a m/s.
ServoGains tuned(double bandwidth_hz, double accel_per_volt, double viscous = 0);

struct ServoSettings {
    std::uint64_t scale = 0;  ///< its address, 0 .. 127: the frame's word is looked up by it
    double nm_per_count = 1;  ///< not 0; negative: the scale counts the other way
    double zero_nm = 0;       ///< where the scale's count is 0
    ServoGains gains;
    double limit_v = 10;   ///< > 0: of the output
    double limit_i_v = 5;  ///< >= 0: of the integral part
    double limit_nm = 0;   ///< >= 0: a greater following error opens the loop; 0: none does
};

enum class LoopState : std::uint32_t {
    not_begun,  ///< close() was not called
    closed,
    stale,    ///< opened: no frame with its scale came in time
    too_far,  ///< opened: the following error was greater than limit_nm
    stopped   ///< opened by stop()
};

/// What the loop has missed since it was last reset.
struct FollowingError {
    double last_nm = 0;  ///< wanted - measured, at the last frame
    double peak_nm = 0;  ///< the greatest without its sign
    double squares = 0;
    std::uint64_t frames = 0;
    double rms_nm() const;
};

/// Trivially copyable: a copy goes on like the original.
class ServoLoop {
  public:
    ServoLoop() : ServoLoop(ServoSettings{}) {}
    explicit ServoLoop(const ServoSettings& settings);

    /// The position is trusted from now on: the next frame's count is the one next to `count` (64 bits, of the scale).
    /// Closes the loop.
    void close(std::int64_t count = 0);
    /// Takes the frame's position; the volts from now on. A frame that cannot be used changes nothing and is counted;
    /// the second sound one in a row without the loop's scale opens the loop, as stale data do.
    double on_frame(const Frame& frame, const Setpoint& wanted);
    /// No frame came in time: opens the loop, if it is closed; 0 V.
    double on_stale();
    /// Opens the loop, if it is closed; 0 V.
    double stop() { return closed() ? open(LoopState::stopped) : volts_; }

    bool closed() const { return state_ == LoopState::closed; }
    LoopState state() const { return state_; }
    double volts() const { return volts_; }
    /// As measured by the last frame.
    double position_nm() const { return settings_.zero_nm + static_cast<double>(count_) * settings_.nm_per_count; }
    std::int64_t count() const { return count_; }
    const FollowingError& error() const { return error_; }
    void reset_error() { error_ = {}; }
    /// Frames that were not used: damaged, without this scale, not newer than the last one.
    std::uint64_t unused() const { return unused_; }
    const ServoSettings& settings() const { return settings_; }

  private:
    /// The word of the loop's scale, if the frame can be used.
    std::optional<std::uint32_t> usable(const Frame& frame) const;
    double open(LoopState why);

    ServoSettings settings_;
    FollowingError error_;
    std::int64_t count_ = 0;
    double integral_ = 0;  // V
    double before_ = 0;    // error at the last frame, nm
    double volts_ = 0;
    Instant last_{};  // of the last frame used
    LoopState state_ = LoopState::not_begun;
    std::uint16_t begun_ = 0;    // a frame was used since close()
    std::uint16_t without_ = 0;  // sound frames in a row that have not the loop's scale
    std::uint64_t unused_ = 0;
};

}  // namespace motionrack::grating_bus
