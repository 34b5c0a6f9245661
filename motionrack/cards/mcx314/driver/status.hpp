// The chip's status words, decoded: name, meaning and remedy of each bit.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/cards/mcx314/map.hpp>
#include <span>
#include <string>
#include <string_view>

namespace motionrack::mcx314 {

/// Main status RR0, decoded.
struct MainStatus {
    std::uint16_t word = 0;
    bool driving(unsigned axes) const { return (field("RR0", "DRV").get(word) & axes) != 0; }
    bool error(unsigned axes) const { return (field("RR0", "ERR").get(word) & axes) != 0; }
    bool interpolating() const { return field("RR0", "IDRV").test(word); }
    bool can_queue() const { return field("RR0", "CNEXT").test(word); }
    int octant() const { return static_cast<int>(field("RR0", "ZONE").get(word)); }
    int patterns_stacked() const { return static_cast<int>(field("RR0", "BPSC").get(word)); }
};

/// Status of one axis: RR1 and RR2, decoded.
struct DriveStatus {
    std::uint16_t rr1 = 0;
    std::uint16_t rr2 = 0;
    bool accelerating() const { return field("RR1", "ASND").test(rr1); }
    bool constant() const { return field("RR1", "CNST").test(rr1); }
    bool decelerating() const { return field("RR1", "DSND").test(rr1); }
    /// Returns true in a ramp of an S-curve.
    bool in_s_ramp() const {
        return field("RR1", "AASND").test(rr1) || field("RR1", "ACNST").test(rr1) || field("RR1", "ADSND").test(rr1);
    }
    /// Returns true if the limit switch is active or has stopped the axis; live or latched.
    bool at_plus_limit() const { return field("RR2", "HLMTP").test(rr2) || field("RR1", "LMTP").test(rr1); }
    bool at_minus_limit() const { return field("RR2", "HLMTM").test(rr2) || field("RR1", "LMTM").test(rr1); }
    bool at_software_limit() const { return field("RR2", "SLMTP").test(rr2) || field("RR2", "SLMTM").test(rr2); }
    bool at_limit() const { return at_plus_limit() || at_minus_limit() || at_software_limit(); }
    bool alarm() const { return field("RR2", "ALARM").test(rr2) || field("RR1", "ALARM").test(rr1); }
    bool emergency() const { return field("RR2", "EMG").test(rr2) || field("RR1", "EMG").test(rr1); }
    /// Returns true if stopped by input n, 0..3.
    bool stopped_by_input(int n) const { return (field("RR1", "IN0").mask << n & rr1) != 0; }
    /// Returns the reason for the end of the last drive as a phrase ("the + limit switch was reached"); "" for a normal
    /// end.
    std::string why_stopped() const;
    /// Returns the remedy as a sentence; "" if none is needed.
    std::string what_next() const;
};

/// One axis at one instant, for messages and screens.
struct AxisReport {
    int axis = 0;
    bool driving = false;
    std::int32_t lp = 0;
    std::int32_t ep = 0;
    std::int32_t cv = 0;
    DriveStatus status = {};
    /// Returns the report: "X stands at LP 1200, EP 1200: the + limit switch was reached (RR1 1000h, RR2 0004h). Move
    /// it off ..."
    std::string text() const;
};

/// A readable bit of RR0..RR3. Names and meanings are those of the map.
struct StatusBit {
    std::string_view reg;
    std::string_view name;
    std::uint16_t mask = 0;
    std::string_view meaning;
    std::string_view next;  ///< remedy; "": none
};

/// Returns every field of RR0, RR1, RR2, RR3.
std::span<const StatusBit> status_bits();
/// Explains the nonzero fields in a word of `reg`, one per line: "LMTP: stopped by nLMTP. Move ..".
std::string explain(std::string_view reg, std::uint16_t word);

/// Levels of an axis' inputs (RR4, RR5), 1 High.
struct InputLevels {
    std::array<bool, 4> in = {};
    bool expp = false;
    bool expm = false;
    bool in_position = false;
    bool alarm = false;
};

}  // namespace motionrack::mcx314
