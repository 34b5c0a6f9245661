// A marking job: what is drawn, with which card settings, optics and laser, on a part that moves how; read from TOML.
#pragma once

#include <cstdint>
#include <functional>
#include <motionrack/mark/drawing.hpp>
#include <motionrack/sim/parts/marking_station.hpp>
#include <motionrack/sim/parts/position_sender.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::mark {

enum class Anchor : std::uint8_t { centre, origin };

struct DrawingSource {
    std::optional<std::string> svg, gcode, text;  ///< just one of them: two file names, or the text itself
    double height_mm = 5;                         ///< of the text's capitals
    std::optional<double> width_mm;               ///< the drawing is made so wide
    double scale = 1, rotate_deg = 0;
    double x_mm = 0, y_mm = 0;  ///< where the anchor is in the field
    Anchor anchor = Anchor::centre;
    double tolerance_mm = default_tolerance_mm;
};

struct Optics {
    double bits_per_mm = 8656;       ///< K, without lens and ct5
    std::optional<std::string> ct5;  ///< file of the card's table
    bool correction = true;          ///< false: the card has no table, though there is a lens
};

struct LensData {
    double f1_mm = 163.064, f2_mm = -1.259, f3_mm = -21.465, f4_mm = -26.664;
    double calibration_deg = 11.7, bits_per_mm = 8656;
    sim::ScanLens lens() const { return {{f1_mm, f2_mm, f3_mm, f4_mm}, calibration_deg, bits_per_mm}; }
};

/// Settings of the card's list.
struct Pace {
    double mark_mm_s = 500, jump_mm_s = 3000;
    double jump_delay_us = 0, mark_delay_us = 0, polygon_delay_us = 0;  ///< whole 10 us
    double laser_on_us = 0, laser_off_us = 0;                           ///< whole 0.5 us
};

struct Belt {
    double speed = 0;                     ///< mm/s, or degrees/s of a table
    double direction_deg = 0;             ///< of a belt
    double centre_x_mm = 0, centre_y_mm = 0;  ///< of a table
    double counts_per_unit = 1000;
    double slip = 0, jitter_counts = 0;
    bool rotary = false;
    std::vector<parts::SpeedPoint> profile;  ///< instead of the speed, if not empty
    Place place;                             ///< of the section
};

enum class FlyMode : std::uint8_t { off, encoder, simulated, mcbsp };

struct FlySettings {
    FlyMode mode = FlyMode::off;
    double tracking_error_us = 0;  ///< whole 10 us
    double scale_factor = 1;       ///< of the right scale: what a wrong calibration does
};

struct Job {
    std::string file;
    DrawingSource drawing;
    Optics optics;
    std::optional<LensData> lens;
    parts::GalvoSettings galvo;
    parts::LaserSettings laser;
    Pace pace;
    Belt belt;
    FlySettings fly;
    parts::SenderSettings sender;

    parts::TrackSettings track() const;
};

/// A job, or everything that is wrong with it, with the places.
struct JobRead {
    std::optional<Job> job;
    std::vector<Error> errors;
};
JobRead read_job(std::string_view text, const std::string& file);

/// Gives the bytes of a file that a job names (relative to the job).
using Load = std::function<Result<std::string>(const std::string& path)>;

/// The drawing of a job in the field's mm, placed, scaled and turned. Errors: of the file, or a drawing without lines.
Result<Drawing> drawing_of(const Job& job, const Load& load);

}  // namespace motionrack::mark
