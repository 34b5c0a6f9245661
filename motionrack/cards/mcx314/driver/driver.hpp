// The MCX314 function library: the source's functions over a register port, with every argument's range checked before anything is
// written. It knows the chip only by its registers, so it cannot tell a virtual chip from a real one.
//
// Axis masks: X 1, Y 2, Z 4, U 8, and their sums.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/base/port.hpp>
#include <motionrack/base/result.hpp>
#include <string>

namespace motionrack::mcx314 {

/// Main status RR0, decoded.
struct MainStatus {
    std::uint16_t word = 0;
    bool driving(unsigned mask) const { return (word & mask & 0xFu) != 0; }
    bool error(unsigned mask) const { return (word >> 4 & mask & 0xFu) != 0; }
    bool interpolating() const { return (word & 0x0100u) != 0; }
    bool can_queue() const { return (word & 0x0200u) != 0; }
    int octant() const { return word >> 10 & 7; }
};

/// Status of one axis: RR1 and RR2, decoded.
struct AxisStatus {
    std::uint16_t rr1 = 0;
    std::uint16_t rr2 = 0;
    /// Why the last drive ended, as a sentence part ("the + limit switch is active"); empty if it ended as commanded.
    std::string why_stopped() const;
};

/// An interpolation command's end, in pulses relative to its start.
struct Finish {
    int axis = 0;  ///< channel 0..3
    std::int32_t pulses = 0;
    std::int32_t centre = 0;  ///< arcs only
};

class Driver {
  public:
    Driver(RegisterPort& port, Interrupt& interrupt) : port_(port), interrupt_(interrupt) {}

    // ---- initial ------------------------------------------------------------------------------------------------------------
    /// Software reset of the chip; waits its 875 ns.
    void RESET();
    /// Pulse output: `mode` 0 two pulse trains, 1 pulse and direction (WR2 PLSMD).
    Result<void> SetPulseMode(unsigned axes, int mode);
    /// R, 16,000 .. 8,000,000: pulses a second = V * 8,000,000 / R. (The second and third axis of constant vector speed: to 13,856,000.)
    Result<void> SetRange(unsigned axes, std::int64_t range);

    // ---- speeds and ramps, register units --------------------------------------------------------------------------------------
    Result<void> SetSV(unsigned axes, std::int64_t value);  ///< initial speed, 1 .. 8,000
    Result<void> SetV(unsigned axes, std::int64_t value);   ///< drive speed, 1 .. 8,000; also while driving
    Result<void> SetA(unsigned axes, std::int64_t value);   ///< acceleration, 1 .. 8,000 (125 * M pulses/s2)
    Result<void> SetD(unsigned axes, std::int64_t value);   ///< deceleration, 1 .. 8,000
    Result<void> SetAA(unsigned axes, std::int64_t value);  ///< K, 1 .. 65,535: jerk 62.5e6 / K * M pulses/s3
    Result<void> SetAO(unsigned axes, std::int64_t value);  ///< pulses kept for the end at SV, 0 .. 65,535
    /// Output pulses of a fixed drive, 0 .. 268,435,455; the sign is the direction that Drive() takes.
    Result<void> Pulse(unsigned axes, std::int64_t pulses);
    Result<void> AutoDec(unsigned axes);
    /// Decelerates after `point` pulses, 0 .. 268,435,455.
    Result<void> ManualDec(unsigned axes, std::int64_t point);
    /// The point alone, also while driving with manual deceleration.
    Result<void> SetDecPoint(unsigned axes, std::int64_t point);
    /// S-curve or T-curve for the next drives (WR3 SACC).
    void SetSCurve(unsigned axes, bool on);

    // ---- drives ---------------------------------------------------------------------------------------------------------------
    /// Starts what Pulse() set, in its direction.
    void Drive(unsigned axes, bool negative);
    void DriveContinuous(unsigned axes, bool negative);
    void Hold(unsigned axes);
    void Start(unsigned axes);
    void SlowStop(unsigned axes);
    void QuickStop(unsigned axes);

    // ---- interpolation ----------------------------------------------------------------------------------------------------------
    /// Axes of the next interpolation commands: channels of AX1, AX2 (, AX3); constant vector speed for two axes; interrupt at each
    /// joint of continuous interpolation.
    void SetInterpolationAxes(int first, int second, int third, bool constant_vector, bool interrupt_at_joints);
    /// A line of two or three axes: finish points -8,388,608 .. 8,388,607. Starts, or is queued behind the running one.
    Result<void> Line(const Finish* ends, int count);
    Result<void> Arc(const Finish (&ends)[2], bool clockwise);
    void EnableDeceleration(bool on);
    void ClearInterpolationInterrupt();

    // ---- limits, inputs and interrupts ------------------------------------------------------------------------------------------
    /// WR1, WR2, WR3 as words; the driver keeps what it wrote, per axis.
    void WriteMode1(unsigned axes, std::uint16_t word);
    void WriteMode2(unsigned axes, std::uint16_t word);
    void WriteMode3(unsigned axes, std::uint16_t word);
    std::uint16_t mode2(int axis) const { return mode_[axis][1]; }
    std::uint16_t mode3(int axis) const { return mode_[axis][2]; }

    // ---- positions and status -----------------------------------------------------------------------------------------------------
    Result<void> LPS(unsigned axes, std::int64_t value);       ///< sets the logical position, 32 bit
    Result<void> EPS(unsigned axes, std::int64_t value);       ///< sets the real (encoder) position
    Result<void> SetCompP(unsigned axes, std::int64_t value);  ///< COMP+, 32 bit
    Result<void> SetCompM(unsigned axes, std::int64_t value);  ///< COMP-
    std::int32_t ReadLPS(int axis);
    std::int32_t ReadEPS(int axis);
    std::int32_t ReadCV(int axis);
    std::int32_t ReadCA(int axis);
    MainStatus status();
    AxisStatus axis_status(int axis);
    std::uint16_t read_interrupts(int axis);  ///< RR3; reading clears it

    /// Waits until none of the axes drives. Errors: Trouble::machine after `timeout`; Trouble::stopped where the user asked to stop (the axes are
    /// then decelerated and standing).
    Result<void> wait_until_stopped(unsigned axes, Duration timeout);

    RegisterPort& port() { return port_; }
    Interrupt& interrupt() { return interrupt_; }

  private:
    void command(unsigned axes, unsigned code);
    void write_data(unsigned axes, unsigned code, std::uint32_t value);
    std::uint32_t read_data(int axis, unsigned code);
    Result<void> checked(unsigned axes, unsigned code, std::int64_t value, std::int64_t least, std::int64_t greatest, const char* name);
    void write_mode(unsigned axes, int number, std::uint16_t word);

    RegisterPort& port_;
    Interrupt& interrupt_;
    std::array<std::array<std::uint16_t, 3>, 4> mode_ = {};
};

}  // namespace motionrack::mcx314
