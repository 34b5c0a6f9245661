// Corrects the position for the motion of the part (processing on the fly), by encoder counts or McBSP words.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <motionrack/cards/rtc5/model/belt_encoders.hpp>
#include <motionrack/cards/rtc5/model/fly_table.hpp>
#include <motionrack/cards/rtc5/model/mcbsp_receiver.hpp>
#include <motionrack/cards/rtc5/model/status_flags.hpp>
#include <optional>

namespace motionrack::rtc5 {

class FlyCorrection {
  public:
    /// `state`, `z` (before the correction) and `tick`: parts of the card's state, which must outlive this.
    FlyCorrection(FlyState& state, double& z, const std::int64_t& tick, BeltEncoders& encoders, McBspReceiver& mcbsp,
                  StatusFlags& flags, BlockBuffers& buffers)
        : state_(state), z_(z), tick_(tick), encoders_(encoders), mcbsp_(mcbsp), flags_(flags), buffers_(buffers) {}

    bool on() const { return state_.now.on(); }

    // ---- commands
    /// Executes a list command that switches a correction on or off (set_fly_x, ..), except fly_return.
    void take(const Command& c);
    Result<void> set_mcbsp_in(int mode, double scale);
    /// Executes set_mcbsp_in with validated parameters.
    void correct_axes(int mode, double scale);
    /// Executes set_multi_mcbsp_in: from now on McBSP words carry their type; those of type 3 are the laser's power
    /// (see McBspReceiver::power).
    Result<void> set_multi_mcbsp_in(int port, std::int64_t factor, int mode);
    /// Sets online positioning by McBSP words. Scale 0 (offset per word unit, bits) disables X or Y; a resolution below
    /// 100 word units per revolution disables the angle.
    Result<void> set_mcbsp_online(double scale_x, double scale_y, double resolution);
    /// Each sets one parameter of online positioning (scale of X, scale of Y, resolution of the angle) and keeps the
    /// other two.
    Result<void> set_mcbsp_x(double scale);
    Result<void> set_mcbsp_y(double scale);
    Result<void> set_mcbsp_rot(double resolution);
    /// Sets one of these parameters by its number: X (0), Y (1) or the angle (2).
    void set_online(std::size_t which, double value);
    /// Sets online positioning of matrix coefficients by McBSP words of (M * 2^24) * 4 + 2 i + j, |M| < 32.
    void set_mcbsp_matrix();
    Result<void> set_rot_center(Point centre);
    void turn_about(Point centre) { state_.rot_center = centre; }
    /// Executes init_fly_2d: zeroes both encoders and sets the offsets (counts) that the 2D correction adds to them.
    void zero_2d(std::int32_t offset_x, std::int32_t offset_y);
    void set_z(double z) { z_ = z; }

    // ---- the table of the 2D correction, which is not part of the state
    void load_table(std::shared_ptr<const FlyTable> table) { table_ = std::move(table); }
    void copy_table(const FlyCorrection& other) { table_ = other.table_; }

    // ---- changes of the correction: each takes the position p before the correction and returns the new one
    /// Switches the correction off and adds it to `p`, so the output does not jump.
    Point leave(Point p, const Transform& global);
    /// Executes park_position; `pause`: the correction is off until end_parking().
    Point park(Point p, const Transform& global, bool pause);
    /// Resumes the correction that park() paused.
    Point end_parking(Point p, const Transform& global);
    Point park_from() const { return state_.park_from; }

    // ---- running
    /// Corrects the positions x and y of n ticks.
    void apply(std::size_t n);
    /// Raises the marking info's flags for n corrected positions. Returns their extent.
    PlanExtent check(std::size_t n);
    /// Returns the extent of the corrected positions in n ticks, if it is so far inside field and limits that they set
    /// no flag; else nullopt. `moves`: the activity runs; else the position stays at `p`.
    std::optional<PlanExtent> steady_extent(const Activity& a, bool moves, Point p, std::int64_t n) const;
    /// Returns the output Z of the last of `n` executed ticks, clipped to -32768 .. 32767 bits.
    double output_z(std::size_t n) const;

  private:
    void be_kind(FlyKind kind);
    void settle_kind();
    void turn(FlyKind kind, double resolution);
    void check_z(std::size_t n);
    double z_now() const;
    Point shifted(Point p, bool backwards) const;
    Point moved(Point p, const Transform& global, bool backwards) const;

    FlyState& state_;
    double& z_;
    const std::int64_t& tick_;
    BeltEncoders& encoders_;
    McBspReceiver& mcbsp_;
    StatusFlags& flags_;
    BlockBuffers& buffers_;
    std::shared_ptr<const FlyTable> table_;
    double block_z_ = 0;  // Z of the block's last tick
};

}  // namespace motionrack::rtc5
