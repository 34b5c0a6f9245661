// Keys of lens, mirrors and laser, shared by rack files and marking jobs.
#pragma once

#include <array>
#include <motionrack/rack/toml_reader.hpp>
#include <motionrack/sim/blocks/scan_lens.hpp>
#include <motionrack/sim/parts/galvo_pair.hpp>
#include <motionrack/sim/parts/laser_gate.hpp>

namespace motionrack::rack {

/// Section lens; see sim::ScanLens.
struct RackLens {
    double f1_mm = 163.064, f2_mm = -1.259, f3_mm = -21.465, f4_mm = -26.664;
    double calibration_deg = 11.7, bits_per_mm = 8656;
    sim::ScanLens lens() const { return {{f1_mm, f2_mm, f3_mm, f4_mm}, calibration_deg, bits_per_mm}; }
};

inline constexpr std::array<Field, 6> lens_keys = {
    field<&RackLens::f1_mm>("f1_mm", 1, 10'000, "mm", "image height for the angle"),
    field<&RackLens::f2_mm>("f2_mm", -1e5, 1e5, "mm", "for its square"),
    field<&RackLens::f3_mm>("f3_mm", -1e5, 1e5, "mm", "for its cube"),
    field<&RackLens::f4_mm>("f4_mm", -1e5, 1e5, "mm", "for its fourth power"),
    field<&RackLens::calibration_deg>("calibration_deg", 1, 22, "deg", "mechanical deflection at 96 % of the range"),
    field<&RackLens::bits_per_mm>("bits_per_mm", 1, 1e6, "bits/mm", "K, of a corrected field"),
};

inline constexpr std::array<Field, 5> galvo_keys = {
    formerly("ideal", field<&parts::GalvoSettings::ideal_mirrors>("ideal_mirrors", 0, 1, "", "mirrors without lag")),
    formerly("dead_us", field<&parts::GalvoSettings::dead_time_us>("dead_time_us", 0, parts::max_dead_time_us, "us",
                                                                   "dead time, rounded down to 10 us")),
    formerly("natural_hz", field<&parts::GalvoSettings::natural_frequency_hz>("natural_frequency_hz", 10, 20'000, "Hz",
                                                                              "natural frequency")),
    formerly("damping", field<&parts::GalvoSettings::damping_ratio>("damping_ratio", 0.1, 10, "", "1: no overshoot")),
    formerly("greatest_speed", field<&parts::GalvoSettings::max_velocity_bits_ms>("max_velocity_bits_ms", 1, 1e9,
                                                                                  "bits/ms", "velocity limit")),
};

inline constexpr std::array<Field, 3> laser_keys = {
    field<&parts::LaserSettings::power_w>("power_w", 0, 1e5, "W", "mean power while on"),
    field<&parts::LaserSettings::on_delay_us>("on_delay_us", 0, 1e5, "us", "delay from the gate to laser on"),
    field<&parts::LaserSettings::off_delay_us>("off_delay_us", 0, 1e5, "us", "delay from the gate to laser off"),
};

}  // namespace motionrack::rack
