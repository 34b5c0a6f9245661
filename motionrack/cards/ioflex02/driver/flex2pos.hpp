// The unit uFlex2Pos: the source's object tIOFlexPos with every name of its table, and an extended interface: readings
// of one instant whose time and counts do not wrap, modes, diagnostics.
//
//   tIOFlex02 (Flex02) ◄── tIOFlexPos (Flex2Pos)
//
// Time and counts of the card have 24 bits. The object extends them to 64 bits. It requires that it sees every clearing
// of the time, so a card must not be shared between two objects, and that an axis moves less than 8,388,607 counts
// between two readings.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/cards/ioflex02/driver/flex02.hpp>

namespace motionrack::ioflex02 {

inline constexpr int cVerNo = 0x0251;                ///< version of the unit, BCD
inline constexpr char cVer[] = "02.51, 07.08.2003";  ///< the same as text, with its date

/// An axis in a reading.
struct AxisReading {
    std::int64_t position = 0;  ///< counts since the calibration, extended beyond 24 bits
    std::int64_t raw = 0;       ///< counts since Init, unaffected by calibrations
    std::int64_t age = 0;       ///< ticks since the last count; oldest_age: at least that, or no count yet
    bool down = false;          ///< the last count was downwards
};
inline constexpr std::int64_t oldest_age = mask_24;

/// Complete reading of one instant.
struct Reading {
    std::int64_t ticks = 0;  ///< time since Init in ticks of 1.2 us, extended over wraps and clearings
    std::array<AxisReading, axis_count> axes{};
    double seconds() const { return static_cast<double>(ticks) * to_seconds(time_tick); }
};

/// Details of an axis; positions are raw counts.
struct AxisDetail {
    AxisReading at;  ///< its reading at this instant
    std::int64_t ticks = 0;
    bool a = false, b = false, z = false, cal = false;  ///< levels of the lines
    std::uint16_t edges_a = 0, edges_b = 0;             ///< modulo 65,536
    std::uint16_t indexes = 0;                          ///< index pulses, modulo 65,536
    std::int64_t index_at = 0;                          ///< position of the last index pulse
    std::uint16_t illegal = 0;                          ///< illegal transitions, at most 65,535
    std::int64_t illegal_at = 0;                        ///< position of the last one
    int edges = 4;                                      ///< counted edges per line: 4, 2 or 1
    /// Converts a raw position to counts since the calibration.
    std::int64_t position_of(std::int64_t place) const { return place - at.raw + at.position; }
};

/// Counting mode of an axis.
struct AxisMode {
    bool reversed = false;
    int edges = 4;           ///< 4, 2 or 1 counts per encoder line
    bool index_low = false;  ///< the index is active low
    int filter = 0;          ///< 0 .. 15: a level counts after filter + 1 samples of 100 ns
    friend bool operator==(const AxisMode&, const AxisMode&) = default;
};

class Flex2Pos final : public Flex02 {
  public:
    using Flex02::Flex02;
    /// Sets the base address and configures the array with the image of the settings or of use_image, otherwise with
    /// the built-in one.
    void Init(std::uint16_t Addr) override;
    void Configure(std::span<const std::uint8_t> image) override;

    // ---- the source's functions; Longint is a signed 32-bit number
    /// Time in ticks of 1.2 us, 0 .. 16,777,215.
    std::int32_t ReadTime();
    /// The same, and clears the counter in the same access.
    std::int32_t ReadTimeClr();
    /// Position in counts since the calibration, -8,388,608 .. 8,388,607.
    std::int32_t ReadPosition0() { return read_position(0); }
    std::int32_t ReadPosition1() { return read_position(1); }
    std::int32_t ReadPosition2() { return read_position(2); }
    std::int32_t ReadPosition3() { return read_position(3); }
    /// Time (cleared) and the positions of one instant; 11 accesses, whereas four ReadPosition need 12.
    void ReadTimeClrPosition(std::int32_t& Time, std::int32_t& Pos0, std::int32_t& Pos1, std::int32_t& Pos2,
                             std::int32_t& Pos3);
    /// Writes one calibration command for each axis together; pending commands are replaced.
    void WriteCmd(tIOFlexCmd Cmd0, tIOFlexCmd Cmd1, tIOFlexCmd Cmd2, tIOFlexCmd Cmd3);
    /// Not in the source: writes the command of one axis 0 to 3 and keeps the pending commands of the others; one
    /// access. WriteCmd cannot do this: cNop ends the wait of an axis, and any other command restarts it.
    void WriteCmdAxis(int axis, tIOFlexCmd Cmd);
    void ReadSts(tIOFlexSts& Sts0, tIOFlexSts& Sts1, tIOFlexSts& Sts2, tIOFlexSts& Sts3);

    // ---- extended interface; axes are 0 .. 3
    /// Time, positions, raw counts and ages of one instant.
    Reading read();
    /// Details of all four axes at one instant.
    std::array<AxisDetail, axis_count> read_details();
    /// Commands and statuses as lists.
    void calibrate(const std::array<tIOFlexCmd, axis_count>& commands);
    std::array<tIOFlexSts, axis_count> statuses();
    /// Waits until the axis is sCal; `never` waits without limit. Errors: machine after `timeout`; stopped.
    motionrack::Result<void> wait_calibrated(int axis, Duration timeout);
    /// Errors: refused (edges or filter out of range; nothing was written), machine (Init has not succeeded).
    motionrack::Result<void> set_mode(int axis, const AxisMode& mode);
    AxisMode mode(int axis);
    void clear_errors();
    /// Sets positions and the card's time to 0; the extended values (ticks, raw counts) continue.
    void reset();

  private:
    /// A 24-bit counter extended to 64 bits.
    struct Carried {
        std::uint32_t last = 0;
        std::int64_t value = 0;
    };
    void forget();
    std::int32_t read_position(std::uint32_t axis);
    std::int64_t carry_time(std::uint32_t time, bool cleared);
    void carry_axis(std::size_t axis, std::uint32_t position, std::uint32_t raw);
    Reading read_captured();

    std::int64_t ticks_ = 0;
    std::uint32_t last_time_ = 0;
    Instant host_then_{};
    std::array<Carried, axis_count> raw_{};
    std::array<std::int64_t, axis_count> position_{};
    std::array<std::uint32_t, axis_count> zero_{};  ///< raw count at the position's zero, 24 bits
};

}  // namespace motionrack::ioflex02
