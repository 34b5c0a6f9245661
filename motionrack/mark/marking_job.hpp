// A marking job: what is drawn, with which card settings, optics and laser, on parts that move how; read from TOML.
#pragma once

#include <cstdint>
#include <functional>
#include <motionrack/mark/drawing.hpp>
#include <motionrack/rack/optics_fields.hpp>
#include <motionrack/sim/parts/marking_station.hpp>
#include <motionrack/sim/parts/serial_position_source.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::mark {

enum class Anchor : std::uint8_t { centre, origin };

struct DrawingSource {
    std::optional<std::string> svg, gcode,
        text;              ///< just one of them: two file names, or the text itself, with {n} for the part's number
    double height_mm = 5;  ///< of the text's capitals
    std::optional<double> width_mm;  ///< the drawing is made so wide
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

/// Settings of the card's list.
struct ProcessSpeeds {
    double mark_mm_s = 500, jump_mm_s = 3000;
    double jump_delay_us = 0, mark_delay_us = 0, polygon_delay_us = 0;  ///< whole 10 us
    double laser_on_us = 0, laser_off_us = 0;                           ///< whole 0.5 us
};

struct BeltSettings {
    double speed = 0;                         ///< mm/s, or degrees/s of a table
    double direction_deg = 0;                 ///< of a belt
    double centre_x_mm = 0, centre_y_mm = 0;  ///< of a table
    double counts_per_unit = 1000;
    double slip = 0, jitter_counts = 0;
    bool rotary = false;
    std::vector<parts::SpeedPoint> profile;  ///< instead of the speed, if not empty
    Place place;                             ///< of the section
};

enum class FlyMode : std::uint8_t { off, encoder, simulated, mcbsp };
enum class WaitMode : std::uint8_t { none, automatic };

struct FlySettings {
    FlyMode mode = FlyMode::off;
    double tracking_error_us = 0;  ///< whole 10 us
    double scale_factor = 1;       ///< of the right scale: what a wrong calibration does
    std::optional<double>
        simulated_speed;  ///< mm/s or degrees/s that the simulated encoder stands for; none: the belt's
    double offset_us =
        0;  ///< everything is marked so much of the belt's first speed further on: for a source that is late
    WaitMode waits = WaitMode::none;
    double margin_mm = 1;  ///< with waits: marks keep so far from the field's edge
};

enum class PartStart : std::uint8_t {
    sensor,       ///< each part's edge is an external start, with track delay
    equidistant,  ///< only the first; then each list asks for the next start, a spacing after its own
};

/// Parts that come one after the other. Units are mm on a belt and degrees on a table.
struct PartsSettings {
    std::int64_t count = 1;
    double spacing = 0;
    std::vector<double> at;  ///< instead of count and spacing: way of the belt until each part is at the sensor
    double track_delay = 0;  ///< from the sensor to where the drawing is meant to be marked
    PartStart start = PartStart::sensor;
    std::int64_t first_number = 1, number_step = 1;  ///< of {n} in texts

    std::size_t size() const { return at.empty() ? static_cast<std::size_t>(count) : at.size(); }
    std::int64_t number(std::size_t marked) const {
        return first_number + static_cast<std::int64_t>(marked) * number_step;
    }
    /// Way of the belt until part `i` is where it should be marked.
    double way(std::size_t i) const { return (at.empty() ? static_cast<double>(i) * spacing : at[i]) + track_delay; }
};

struct MarkingJob {
    std::string file;
    std::vector<DrawingSource> drawings;
    Optics optics;
    std::optional<rack::RackLens> lens;
    parts::GalvoSettings galvo;
    parts::LaserSettings laser;
    ProcessSpeeds pace;
    BeltSettings belt;
    FlySettings fly;
    std::optional<PartsSettings> parts;  ///< none: one part, and the job begins by itself
    parts::SerialPositionSettings sender;

    parts::ConveyorSettings track() const;
    /// 1 or -1: where the belt goes, seen from its direction.
    double sense() const;
};

/// A job, or everything that is wrong with it, with the places.
struct JobRead {
    std::optional<MarkingJob> job;
    std::vector<Error> errors;
};
JobRead read_job(std::string_view text, const std::string& file);

/// Every key of a job file, as a page.
std::string job_file_reference();

/// Gives the bytes of a file that a job names (relative to the job).
using Load = std::function<Result<std::string>(const std::string& path)>;

/// The drawing of a job in the field's mm, placed, scaled and turned, with this number in its texts. Errors: of the
/// file, or a drawing without lines.
Result<Drawing> drawing_of(const MarkingJob& job, const Load& load, std::int64_t number);
/// Whether its texts have a number.
bool has_numbers(const MarkingJob& job);

}  // namespace motionrack::mark
