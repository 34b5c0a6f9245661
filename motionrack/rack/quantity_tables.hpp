// Tables of quantities: axes, stages, belts and tables, scan heads. Only quantities.cpp uses them.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/rack/rack.hpp>
#include <string_view>

namespace motionrack::rack::quantity_tables {

enum class ValueKind : std::uint8_t {
    measures,  ///< any number
    whole,     ///< any whole number
    amount,    ///< a whole number >= 0
    yes_no     ///< 1 or 0
};
using enum ValueKind;

/// A row of a part's table.
template <class Part>
struct QuantityRow {
    std::string_view name;  ///< "{u}" stands for mm or deg
    std::string_view doc;
    double (*get)(Part& part, Instant now);
    ValueKind values;
    bool (*present)(const Part& part) = nullptr;  ///< nullptr: always
    /// Returns the microsteps by which to push the motor to bring an axis to `value`; nullptr: not settable.
    double (*push)(Part& part, double value, Instant now) = nullptr;
};

inline bool has_encoder(const RunningAxis& axis) {
    return axis.machine->has_encoder();
}

inline double rotor(RunningAxis& axis, Instant now) {
    return static_cast<double>(axis.machine->rotor().count(now));
}

inline constexpr std::array<QuantityRow<RunningAxis>, 13> axis_quantities = {{
    {"position_{u}", "the true position of the table",
     [](RunningAxis& axis, Instant now) { return axis.machine->position(now); }, measures, nullptr,
     [](RunningAxis& axis, double value, Instant now) {
         return (value - axis.machine->position(now)) / axis.machine->units_per_pulse();
     }},
    {"speed_{u}_s", "velocity of the table by the rotor, signed",
     [](RunningAxis& axis, Instant now) { return axis.velocity(now); }, measures},
    {"position_pulses", "the rotor in microsteps since the start", rotor, whole, nullptr,
     [](RunningAxis& axis, double value, Instant now) { return value - rotor(axis, now); }},
    {"position_counts", "counts of its encoder since the start",
     [](RunningAxis& axis, Instant now) { return static_cast<double>(axis.machine->encoder().count(now)); }, whole,
     has_encoder},
    {"pulses", "pulses that came to the motor, + less -",
     [](RunningAxis& axis, Instant now) {
         return rotor(axis, now) + static_cast<double>(axis.machine->lost_steps(now));
     },
     whole},
    {"lost_pulses", "pulses that the rotor did not follow",
     [](RunningAxis& axis, Instant now) { return static_cast<double>(axis.machine->lost_steps(now)); }, whole},
    {"in_step", "1 while the rotor follows the pulses, else 0",
     [](RunningAxis& axis, Instant) { return axis.machine->in_step() ? 1.0 : 0.0; }, yes_no},
    {"top_speed_{u}_s", "the peak velocity so far",
     [](RunningAxis& axis, Instant) { return axis.machine->peak_velocity(); }, measures},
    {"limit_minus", "1 while the machine is at that switch, independent of its wire",
     [](RunningAxis& axis, Instant) { return axis.machine->switches().limit_minus().active() ? 1.0 : 0.0; }, yes_no,
     [](const RunningAxis& axis) { return axis.machine->switches().limit_minus().present(); }},
    {"limit_plus", "the same for the switch at the + end",
     [](RunningAxis& axis, Instant) { return axis.machine->switches().limit_plus().active() ? 1.0 : 0.0; }, yes_no,
     [](const RunningAxis& axis) { return axis.machine->switches().limit_plus().present(); }},
    {"home", "the same for the home switch",
     [](RunningAxis& axis, Instant) { return axis.machine->switches().home().active() ? 1.0 : 0.0; }, yes_no,
     [](const RunningAxis& axis) { return axis.machine->switches().home().present(); }},
    {"cam", "1 while the machine is on its reference cam",
     [](RunningAxis& axis, Instant now) { return axis.cam->active(now) ? 1.0 : 0.0; }, yes_no,
     [](const RunningAxis& axis) { return axis.cam != nullptr; }},
    {"drive_v", "the voltage at the servo amplifier", [](RunningAxis& axis, Instant) { return axis.servo->volts(); },
     measures, [](const RunningAxis& axis) { return axis.servo != nullptr; }},
}};

inline constexpr double mm = 1e-6;  // mm per nm

/// Returns true if the stage's control loop is closed by a processor.
inline bool has_loop(const RunningStage& stage) {
    return stage.loop() != nullptr;
}

inline constexpr std::array<QuantityRow<RunningStage>, 13> stage_quantities = {{
    {"position_mm", "the true position of the stage",
     [](RunningStage& stage, Instant now) { return stage.motor->position_nm(now) * mm; }, measures},
    {"speed_mm_s", "its velocity, signed",
     [](RunningStage& stage, Instant now) { return stage.motor->velocity(now) * 1e3; }, measures},
    {"drive_v", "the voltage at its amplifier", [](RunningStage& stage, Instant) { return stage.motor->volts(); },
     measures},
    {"scale_mm", "its position by its scale",
     [](RunningStage& stage, Instant now) {
         return stage.config.scale.zero_offset_mm + stage.scale->position_nm(now) * mm;
     },
     measures},
    {"scale_counts", "counts of its scale",
     [](RunningStage& stage, Instant now) { return static_cast<double>(stage.scale->count(now)); }, whole},
    {"lost_counts", "counts that its scale has lost",
     [](RunningStage& stage, Instant) { return static_cast<double>(stage.scale->lost()); }, amount},
    {"trusted", "1 while its scale has lost none, else 0",
     [](RunningStage& stage, Instant) { return stage.scale->counts_valid() ? 1.0 : 0.0; }, yes_no},
    {"closed", "1 while its loop is closed, else 0",
     [](RunningStage& stage, Instant) { return stage.loop()->closed() ? 1.0 : 0.0; }, yes_no, has_loop},
    {"following_nm", "following error at the last frame: commanded - measured",
     [](RunningStage& stage, Instant) { return stage.loop()->error().last_nm; }, measures, has_loop},
    {"following_peak_nm", "the peak following error so far, absolute",
     [](RunningStage& stage, Instant) { return stage.loop()->error().peak_nm; }, measures, has_loop},
    {"following_rms_nm", "the RMS following error so far",
     [](RunningStage& stage, Instant) { return stage.loop()->error().rms_nm(); }, measures, has_loop},
    {"wanted_mm", "its commanded position",
     [](RunningStage& stage, Instant now) { return stage.wanted(to_seconds(now)).position_nm * mm; }, measures,
     has_loop},
    {"unused_frames", "frames that its loop could not use",
     [](RunningStage& stage, Instant) { return static_cast<double>(stage.loop()->unused()); }, amount, has_loop},
}};

inline bool with_encoder(const RunningConveyor& track) {
    return track.encoder != nullptr;
}

inline constexpr std::string_view track_velocity = "speed_{u}_s";
inline constexpr std::array<QuantityRow<RunningConveyor>, 6> track_quantities = {{
    {"position_{u}", "its travel since the start",
     [](RunningConveyor& track, Instant now) { return track.track().travel(to_seconds(now)); }, measures},
    {track_velocity, "its velocity, signed",
     [](RunningConveyor& track, Instant now) { return track.track().velocity(to_seconds(now)); }, measures},
    {"encoder_counts", "counts of its encoder",
     [](RunningConveyor& track, Instant) { return static_cast<double>(track.encoder->count()); }, whole, with_encoder},
    {"lost_counts", "counts that the encoder lost above its maximum rate",
     [](RunningConveyor& track, Instant) { return static_cast<double>(track.encoder->lost()); }, amount, with_encoder},
    {"word", "the sender's last complete word",
     [](RunningConveyor& track, Instant) { return static_cast<double>(track.sender->word()); }, whole,
     [](const RunningConveyor& track) { return track.sender != nullptr; }},
    {"parts", "number of parts that reached the sensor",
     [](RunningConveyor& track, Instant now) { return static_cast<double>(track.sensor->parts(now)); }, whole,
     [](const RunningConveyor& track) { return track.sensor != nullptr; }},
}};

inline constexpr std::array<QuantityRow<RunningScanner>, 7> scanner_quantities = {{
    {"spot_x_mm", "position of the spot in the field, X",
     [](RunningScanner& scanner, Instant) { return scanner.station().spot().x; }, measures},
    {"spot_y_mm", "the same, Y", [](RunningScanner& scanner, Instant) { return scanner.station().spot().y; }, measures},
    {"light", "1 while the laser is on, else 0",
     [](RunningScanner& scanner, Instant) { return scanner.station().gate().on() ? 1.0 : 0.0; }, yes_no},
    {"marked_mm", "length of all marks on the part",
     [](RunningScanner& scanner, Instant) { return scanner.workpiece().length_mm(); }, measures},
    {"energy_j", "laser energy on the part",
     [](RunningScanner& scanner, Instant) { return scanner.workpiece().energy_j(); }, measures},
    {"points", "stored points of the marks",
     [](RunningScanner& scanner, Instant) { return static_cast<double>(scanner.workpiece().points().size()); }, amount},
    {"lost_points", "points beyond max_points",
     [](RunningScanner& scanner, Instant) { return static_cast<double>(scanner.workpiece().lost_points()); }, amount},
}};

}  // namespace motionrack::rack::quantity_tables
