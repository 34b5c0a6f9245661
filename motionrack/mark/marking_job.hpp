// Marking job, read from TOML: the drawing, card settings, optics and laser, and the movement of the parts.
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
        text;                        ///< exactly one: two file names, or the text itself, with {n} for the part number
    double height_mm = 5;            ///< capital height of the text
    std::optional<double> width_mm;  ///< scales the drawing to this width
    double scale = 1, rotate_deg = 0;
    double x_mm = 0, y_mm = 0;  ///< position of the anchor in the field
    Anchor anchor = Anchor::centre;
    double tolerance_mm = default_tolerance_mm;
};

struct Optics {
    double bits_per_mm = 8656;       ///< K: field bits per mm; used without a lens and without a ct5 file
    std::optional<std::string> ct5;  ///< file of the card's correction table
    bool correction = true;          ///< false: the card uses no correction table, although there is a lens
};

/// Speeds and delays that the list sets.
struct ProcessSpeeds {
    double mark_speed_mm_s = 500, jump_speed_mm_s = 3000;
    double jump_delay_us = 0, mark_delay_us = 0, polygon_delay_us = 0;  ///< multiples of 10 us
    double laser_on_us = 0, laser_off_us = 0;                           ///< multiples of 0.5 us
};

struct BeltSettings {
    double velocity = 0;                      ///< mm/s, or degrees/s of a table
    double direction_deg = 0;                 ///< belt only
    double centre_x_mm = 0, centre_y_mm = 0;  ///< table only
    double counts_per_unit = 1000;
    double slip = 0, jitter_counts = 0;
    bool rotary = false;
    std::vector<parts::VelocityPoint> profile;  ///< if not empty, replaces `velocity`
    TextPosition location;                      ///< position of the section
};

enum class FlyMode : std::uint8_t { off, encoder, simulated, mcbsp };
enum class WaitMode : std::uint8_t { none, automatic };

struct FlySettings {
    FlyMode mode = FlyMode::off;
    double tracking_error_us = 0;  ///< time that the card extrapolates encoder counts; a multiple of 10 us
    double scale_factor = 1;       ///< factor on the correct scale, to simulate a wrong calibration
    std::optional<double>
        simulated_velocity;  ///< mm/s or degrees/s represented by the simulated encoder; empty: belt velocity
    double offset_us = 0;    ///< shifts all marks by the initial belt velocity times this, to compensate a late source
    WaitMode wait_mode = WaitMode::none;
    double margin_mm = 1;  ///< with waits: minimum distance of marks from the field edge
};

enum class PartStart : std::uint8_t {
    sensor,       ///< the edge of each part is an external start, with track delay
    equidistant,  ///< only the first edge; then each list requests the next start one spacing after its own
};

/// Consecutive parts. Units are mm on a belt and degrees on a table.
struct PartsSettings {
    std::int64_t count = 1;
    double spacing = 0;
    std::vector<double> at;  ///< replaces count and spacing: belt distance until each part reaches the sensor
    double track_delay = 0;  ///< from the sensor to the intended marking position
    PartStart start = PartStart::sensor;
    std::int64_t first_number = 1, number_step = 1;  ///< values of {n} in texts

    std::size_t size() const { return at.empty() ? static_cast<std::size_t>(count) : at.size(); }
    std::int64_t number(std::size_t marked) const {
        return first_number + static_cast<std::int64_t>(marked) * number_step;
    }
    /// Belt distance until part `i` reaches its marking position.
    double travel(std::size_t i) const { return (at.empty() ? static_cast<double>(i) * spacing : at[i]) + track_delay; }
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
    std::optional<PartsSettings> parts;  ///< empty: one part, and the job starts by itself
    parts::SerialPositionSettings sender;

    parts::ConveyorSettings track() const;
    /// Returns 1 if the belt moves along its direction, -1 if against it.
    double sense() const;
};

/// Result of reading a job: the job, or all errors with their positions.
struct JobRead {
    std::optional<MarkingJob> job;
    std::vector<Error> errors;
};
JobRead read_job(std::string_view text, const std::string& file);

/// Returns the reference page of all keys of a job file.
std::string job_file_reference();

/// Returns the bytes of a file named by a job (path relative to the job).
using Load = std::function<Result<std::string>(const std::string& path)>;

/// Returns the drawing of a job in field mm: positioned, scaled and rotated, with this number in its texts. Errors:
/// those of the file, or a drawing without lines.
Result<Drawing> drawing_of(const MarkingJob& job, const Load& load, std::int64_t number);
/// Returns true if its texts contain a number.
bool has_numbers(const MarkingJob& job);

}  // namespace motionrack::mark
