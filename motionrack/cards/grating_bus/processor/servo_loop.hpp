// A position loop closed through the bus' frames: every frame gives a position, and the loop returns the voltage for
// the next period.
//
//   frame ──► count, unwrapped ──► nm ──┐
//                                       ▼
//   profile ──► commanded ────────────(-)──► error ──► P + I + D ──┐
//         └──► velocity, acceleration ─► feed-forward ────────────(+)──► limit ──► volts
//
// A damaged or old frame is ignored. Stale data or an excessive following error open the loop: 0 V, and the position is
// invalid until close().
#pragma once

#include <cstdint>
#include <motionrack/base/time.hpp>
#include <motionrack/cards/grating_bus/frame.hpp>
#include <motionrack/cards/grating_bus/processor/profile.hpp>

namespace motionrack::grating_bus {

struct ServoGains {
    double p = 0;         ///< V per nm
    double i = 0;         ///< V per nm s
    double d = 0;         ///< V per nm/s
    double speed_ff = 0;  ///< V per nm/s
    double accel_ff = 0;  ///< V per nm/s2
};

/// Returns gains for an open-loop crossover at `bandwidth_hz`; about a twentieth of the frame rate keeps a phase margin
/// for the delay of the frames. `accel_per_volt`: acceleration of the stage, m/s2 per volt; `viscous`: its viscous
/// deceleration, m/s2 per m/s.
ServoGains tuned(double bandwidth_hz, double accel_per_volt, double viscous = 0);

struct ServoSettings {
    std::uint64_t scale = 0;    ///< address of the scale, 0 .. 127; selects the word in the frame
    double nm_per_count = 1;    ///< not 0; negative: the scale counts in the opposite direction
    double zero_offset_nm = 0;  ///< position at which the scale's count is 0
    ServoGains gains;
    double limit_v = 10;   ///< > 0: limit of the output
    double limit_i_v = 5;  ///< >= 0: limit of the integral part
    double max_following_error_nm =
        0;  ///< >= 0: limit of the following error, beyond which the loop opens; 0: unlimited
};

enum class LoopState : std::uint32_t {
    not_begun,  ///< close() was not called
    closed,
    stale,    ///< opened: no frame with its scale arrived in time
    too_far,  ///< opened: the following error exceeded limit_nm
    stopped   ///< opened by stop()
};

/// Following error of the loop since its last reset.
struct FollowingError {
    double last_nm = 0;  ///< commanded minus actual position at the last frame
    double peak_nm = 0;  ///< largest magnitude
    double squares = 0;
    std::uint64_t frames = 0;
    double rms_nm() const;
};

/// The loop. Trivially copyable: a copy continues like the original.
class ServoLoop {
  public:
    ServoLoop() : ServoLoop(ServoSettings{}) {}
    explicit ServoLoop(const ServoSettings& settings);

    /// Closes the loop. The position is valid from now on: the next frame's count is the one nearest to `count` (64
    /// bits, of the scale).
    void close(std::int64_t count = 0);
    /// Takes the frame's position and returns the new voltage. A frame that cannot be used is counted and otherwise
    /// ignored. The second valid frame in a row without the loop's scale opens the loop, as stale data do.
    double on_frame(const Frame& frame, const Setpoint& wanted);
    /// Reports that no frame arrived in time: opens a closed loop; 0 V.
    double on_stale();
    /// Opens a closed loop; 0 V.
    double stop() { return closed() ? open(LoopState::stopped) : volts_; }

    bool closed() const { return state_ == LoopState::closed; }
    LoopState state() const { return state_; }
    double volts() const { return volts_; }
    /// Returns the actual position at the last frame.
    double position_nm() const {
        return settings_.zero_offset_nm + static_cast<double>(count_) * settings_.nm_per_count;
    }
    std::int64_t count() const { return count_; }
    const FollowingError& error() const { return error_; }
    void reset_error() { error_ = {}; }
    /// Returns the number of ignored frames: damaged, without this scale, or not newer than the last one.
    std::uint64_t unused() const { return unused_; }
    const ServoSettings& settings() const { return settings_; }

  private:
    /// Returns the word of the loop's scale; nullopt if the frame cannot be used.
    std::optional<std::uint32_t> usable(const Frame& frame) const;
    double open(LoopState why);

    ServoSettings settings_;
    FollowingError error_;
    std::int64_t count_ = 0;
    double integral_ = 0;  // V
    double before_ = 0;    // error at the last frame, nm
    double volts_ = 0;
    Instant last_{};  // instant of the last frame used
    LoopState state_ = LoopState::not_begun;
    std::uint16_t begun_ = 0;    // a frame was used since close()
    std::uint16_t without_ = 0;  // consecutive valid frames without the loop's scale
    std::uint64_t unused_ = 0;
};

}  // namespace motionrack::grating_bus
