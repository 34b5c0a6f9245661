// Tables of the keys of a marking job, by section. The reader and the generated reference page use them.
#pragma once

#include <array>
#include <motionrack/mark/marking_job.hpp>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::mark::fields {

using rack::absent_means;
using rack::Field;
using rack::field;
using rack::with_choices;
using rack::with_lines;

inline constexpr std::array<std::string_view, 2> anchors = {"centre", "origin"};
inline constexpr std::array<std::string_view, 4> modes = {"off", "encoder", "simulated", "mcbsp"};
inline constexpr std::array<std::string_view, 2> wait_modes = {"none", "auto"};
inline constexpr std::array<std::string_view, 2> starts = {"sensor", "equidistant"};

inline constexpr std::array<Field, 10> drawing_fields = {
    absent_means(field<&DrawingSource::svg>("svg", 1, 1000, "", "SVG file"), "one of the three"),
    absent_means(field<&DrawingSource::gcode>("gcode", 1, 1000, "", "part program"), "one of the three"),
    absent_means(
        with_lines(field<&DrawingSource::text>(
            "text", 1, 10'000, "",
            "text in a single-stroke font, in lines; `{n}` is the part's number, `{n:05}` with leading zeros")),
        "one of the three"),
    field<&DrawingSource::height_mm>("height_mm", 0.01, 1000, "mm", "height of the text's capitals"),
    absent_means(
        field<&DrawingSource::width_mm>("width_mm", 0.001, 10'000, "mm", "width of the drawing, which is scaled to it"),
        "as it is"),
    field<&DrawingSource::scale>("scale", 1e-6, 1e6, "", "scale of the drawing"),
    field<&DrawingSource::rotate_deg>("rotate_deg", -3600, 3600, "deg", "rotation of the drawing, counter-clockwise"),
    field<&DrawingSource::x_mm>("x_mm", -1000, 1000, "mm", "position of its anchor"),
    field<&DrawingSource::y_mm>("y_mm", -1000, 1000, "mm", "position of its anchor"),
    with_choices(field<&DrawingSource::anchor>("anchor", 0, 0, "", "its centre or its own origin"), anchors),
};
inline constexpr std::array<Field, 3> optics_fields = {
    field<&Optics::bits_per_mm>("bits_per_mm", 1, 1e6, "bits/mm", "without lens and ct5"),
    absent_means(field<&Optics::ct5>("ct5", 1, 1000, "", "correction file of the card"), "made from the lens"),
    field<&Optics::correction>("correction", 0, 1, "", "false: without a table in the card"),
};
inline constexpr std::array<Field, 7> pace_fields = {
    formerly("mark_mm_s",
             field<&ProcessSpeeds::mark_speed_mm_s>("mark_speed_mm_s", 1e-6, 1e6, "mm/s", "speed of marks")),
    formerly("jump_mm_s",
             field<&ProcessSpeeds::jump_speed_mm_s>("jump_speed_mm_s", 1e-6, 1e6, "mm/s", "speed of jumps")),
    field<&ProcessSpeeds::jump_delay_us>("jump_delay_us", 0, 1e7, "us", "wait after a jump"),
    field<&ProcessSpeeds::mark_delay_us>("mark_delay_us", 0, 1e7, "us", "wait after a stroke"),
    field<&ProcessSpeeds::polygon_delay_us>("polygon_delay_us", 0, 1e7, "us", "wait at a corner"),
    field<&ProcessSpeeds::laser_on_us>("laser_on_us", -16'384, 32'767, "us", "from the begin of a stroke to laser on"),
    field<&ProcessSpeeds::laser_off_us>("laser_off_us", 0, 32'767, "us", "from the end of a stroke to laser off"),
};
inline constexpr std::array<Field, 5> belt_fields = {
    formerly("speed_mm_s", field<&BeltSettings::velocity>("velocity_mm_s", -1e5, 1e5, "mm/s", "velocity")),
    field<&BeltSettings::direction_deg>("direction_deg", -3600, 3600, "deg",
                                        "direction of its motion, from +X counter-clockwise"),
    field<&BeltSettings::counts_per_unit>("counts_per_mm", -1e6, 1e6, "", "counts of its encoder, four a line"),
    field<&BeltSettings::slip>("slip", -0.5, 0.5, "", "of the encoder's wheel"),
    field<&BeltSettings::jitter_counts>("jitter_counts", 0, 1000, "", "noise of a reading"),
};
inline constexpr std::array<Field, 6> table_fields = {
    formerly("speed_deg_s", field<&BeltSettings::velocity>("velocity_deg_s", -1e5, 1e5, "deg/s", "counter-clockwise")),
    field<&BeltSettings::centre_x_mm>("centre_x_mm", -1000, 1000, "mm", "centre"),
    field<&BeltSettings::centre_y_mm>("centre_y_mm", -1000, 1000, "mm", "centre"),
    field<&BeltSettings::counts_per_unit>("counts_per_deg", -1e6, 1e6, "", "counts of its encoder, four a line"),
    field<&BeltSettings::slip>("slip", -0.5, 0.5, "", "of the encoder's wheel"),
    field<&BeltSettings::jitter_counts>("jitter_counts", 0, 1000, "", "noise of a reading"),
};
inline constexpr std::array<Field, 7> fly_fields = {
    with_choices(field<&FlySettings::mode>("mode", 0, 0, "", "source of the movement for the card"), modes),
    field<&FlySettings::tracking_error_us>(
        "tracking_error_us", 0, 655'350, "us",
        "lag of the mirrors that the card compensates, in steps of 10 us; encoders only"),
    field<&FlySettings::scale_factor>("scale_factor", 0.01, 100, "",
                                      "factor of a wrong scale: 1.01 is one percent too large"),
    absent_means(
        formerly("simulated_speed_{u}_s", field<&FlySettings::simulated_velocity>(
                                              "simulated_velocity_{u}_s", -1e5, 1e5, "{u}/s",
                                              "mode simulated: the velocity that the card's clock represents")),
        "the velocity of the belt"),
    field<&FlySettings::offset_us>(
        "offset_us", -1e6, 1e6, "us",
        "shifts all marks ahead by the motion of the belt in this time at its first velocity: for a late source"),
    with_choices(formerly("waits", field<&FlySettings::wait_mode>(
                                       "wait_mode", 0, 0, "",
                                       "auto: each stroke waits until it is in the field; long strokes are split")),
                 wait_modes),
    field<&FlySettings::margin_mm>("margin_mm", 0, 1000, "mm",
                                   "with waits: minimum distance of marks from the field's edge"),
};
inline constexpr std::array<Field, 6> parts_fields = {
    field<&PartsSettings::count>("count", 1, 10'000, "", "how many come"),
    field<&PartsSettings::spacing>("spacing_{u}", 0, 1e6, "{u}", "distance between two parts"),
    field<&PartsSettings::track_delay>("track_delay_{u}", 0, 1e6, "{u}",
                                       "distance from the sensor to the position of the drawing in the field"),
    with_choices(field<&PartsSettings::start>("start", 0, 0, "",
                                              "each part's edge at the sensor, or the card itself after each spacing"),
                 starts),
    field<&PartsSettings::first_number>("first_number", -1e15, 1e15, "", "`{n}` of the first marked part"),
    field<&PartsSettings::number_step>("number_step", -1e9, 1e9, "", "step of `{n}` between two marked parts"),
};
inline constexpr std::array<Field, 3> sender_fields = {
    field<&parts::SerialPositionSettings::bits_per_mm>("bits_per_unit", -1e9, 1e9, "", "resolution, a mm or degree"),
    field<&parts::SerialPositionSettings::period_us>("period_us", 1, 1e6, "us", "between readings"),
    field<&parts::SerialPositionSettings::delay_us>("delay_us", 0, 1e6, "us", "delay from a reading to its word"),
};
/// A key whose value is an array.
struct ArrayKey {
    std::string_view key, unit, range, absent, doc;
    std::string_view old_key = {};  ///< name of the key in earlier versions; empty: the same
};

struct SectionInfo {
    std::string_view name;
    std::span<const Field> fields;
    std::string_view doc;
    ArrayKey array{};
};
inline constexpr ArrayKey profile_key{"profile", "s, {u}/s", "1 .. 10000 pairs", "none",
                                      "instead of the velocity: [[seconds, velocity], ..], linear between the points"};
inline constexpr ArrayKey at_key{
    "part_positions_{u}",
    "{u}",
    "1 .. 10000 rising numbers from 0 on",
    "none",
    "instead of count and spacing: travel of the belt until each part's edge is at the sensor",
    "at_{u}"};

inline constexpr std::array<SectionInfo, 11> sections = {
    SectionInfo{"drawing", drawing_fields,
                "One of `svg`, `gcode` and `text`. Repeated `[[drawing]]` sections mark several drawings in turn."},
    SectionInfo{"optics", optics_fields, ""},
    SectionInfo{"lens", rack::lens_keys, "An f-theta lens. The card's table is made from it, or is the ct5 file."},
    SectionInfo{"galvo", rack::galvo_keys, "Without `ideal_mirrors` they have dead time, lag and a velocity limit."},
    SectionInfo{"laser", rack::laser_keys, ""},
    SectionInfo{"pace", pace_fields,
                "Delays of the mirrors are in steps of 10 us, those of the laser in steps of 0.5 us."},
    SectionInfo{"belt", belt_fields, "The conveyor of the parts.", profile_key},
    SectionInfo{"table", table_fields, "A rotary table instead of a belt.", profile_key},
    SectionInfo{"fly", fly_fields, "Tracking of the part by the card."},
    SectionInfo{"parts", parts_fields,
                "Successive parts. Without it the job has one part and the list starts by itself.", at_key},
    SectionInfo{"sender", sender_fields, "The source of McBSP words, with mode mcbsp."},
};

}  // namespace motionrack::mark::fields
