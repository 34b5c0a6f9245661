// Contents of a rack file as plain structs with units: cards in slots, axes of the machine, wires, the controller's
// settings.
//
//   rack file (TOML) --read_rack--> RackConfig --(rack)--> running cards, wires and parts
//                        |
//                        +--> every error with its location, and warnings
#pragma once

#include <cstdint>
#include <filesystem>
#include <motionrack/base/result.hpp>
#include <motionrack/control/limits.hpp>
#include <motionrack/rack/config_marking.hpp>
#include <motionrack/rack/settings_box.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

// ---- Cards

/// A card. Default values of the members and of its settings are the rack file's defaults.
struct RackCard {
    std::string name;         ///< name in wires: letters, digits, '_'
    std::string type;         ///< a name in card_type_names(); empty: unknown, which is an error of the file
    std::optional<int> slot;  ///< 0 .. 20; always set by read_rack (the lowest free slot if the file gives none)
    SettingsBox settings;     ///< an object that only the plug-in of its type knows
};

// ---- Axes

enum class AxisKind : std::uint8_t {
    linear,  ///< X Y Z: positions in mm
    rotary   ///< A B C: positions in degrees
};

/// Stepping motor of an axis; rates are pulses (microsteps) a second.
struct RackMotor {
    double start_stop_hz = 2000;   ///< highest rate at which it starts and stops without step loss
    double pull_out_hz = 200'000;  ///< step loss above this rate
};

/// A servo amplifier with a DC motor and tachometer instead of a stepping motor: the axis follows a voltage.
struct RackServo {
    double velocity_per_volt = 100;             ///< mm/s or degrees/s per volt
    std::optional<double> saturation_velocity;  ///< saturation of the amplifier; absent: the velocity at 10 V
    double current_limit_accel = 5000;          ///< at the current limit without load, mm/s2 or degrees/s2
    double coulomb_friction = 50;               ///< deceleration without current, mm/s2 or degrees/s2
    double time_constant_ms = 10;               ///< time constant of the velocity
    double dead_band_v = 0.005;                 ///< amplifier output is 0 below this voltage, V
    double load_inertia_ratio = 0;              ///< load inertia in units of the motor's own inertia
    std::optional<double> position_window;      ///< window of position hold, mm or degrees; absent: no hold

    /// Returns the velocity at which the amplifier saturates, mm/s or degrees/s.
    double saturation() const { return saturation_velocity.value_or(10 * velocity_per_volt); }
};

/// Switches of an axis by the machine position (mm or degrees) at which they act; absent: not fitted.
struct RackSwitches {
    std::optional<double> limit_minus;  ///< active at and below
    std::optional<double> limit_plus;   ///< active at and above
    std::optional<double> home;         ///< active at and below
    std::optional<double> cam_from;     ///< start of the reference cam
    std::optional<double> cam_to;       ///< end of the reference cam
    double hysteresis = 0.05;           ///< switch hysteresis, mm or degrees
    double bounce_ms = 1.0;             ///< contact bounce at each change, ms; 0: clean edges

    bool has_cam() const { return cam_from && cam_to; }
};

enum class HomingDirection : std::uint8_t { minus, plus };

/// Homing of an axis; see control/homing.hpp.
struct RackHoming {
    std::int64_t method = 2;                                    ///< method, 1 .. 4: control::HomingMethod
    HomingDirection search_direction = HomingDirection::minus;  ///< search direction of the home switch
    std::optional<double> search_velocity;                      ///< search velocity; absent: a quarter of max_velocity
    std::optional<double> latch_velocity;  ///< latch velocity; absent: a quarter of max_velocity_step
    std::optional<double> home_offset;     ///< position at home, mm or degrees; absent: of the switch's edge
    std::optional<double> index_after;  ///< distance from the switch to the index; absent: as found by the first homing
    double backoff = 0.1;               ///< further travel after the switch is released, mm or degrees
    std::int64_t sequence = 0;  ///< axes with the lowest number are homed first, axes with equal numbers together
};

/// One axis of the machine. Positions are in mm (linear) or degrees (rotary), the axis' "unit"; time is in seconds.
struct RackAxis {
    char letter = 'X';  ///< X Y Z A B C
    AxisKind kind = AxisKind::linear;
    std::string card;     ///< name of the card
    std::string channel;  ///< one letter of the card's channels; empty on a card with a single channel
    std::int64_t motor_steps_per_rev = 200;
    std::int64_t microsteps = 16;  ///< pulses per full step
    double lead_mm = 5;            ///< linear: travel per motor revolution
    double gear_ratio = 90;        ///< rotary: motor revolutions per revolution of the axis
    double max_velocity = 100;
    double max_accel = 1000;
    double max_jerk = 20'000;  ///< 0: trapezoidal profile
    double max_velocity_step = 2;
    double min_limit = 0;
    double max_limit = 300;
    double initial_position = 0;                 ///< machine position when the rack starts
    std::int64_t encoder_counts_per_rev = 4000;  ///< quadrature counts (4 per line) per motor revolution; 0: no encoder
    bool reversed = false;  ///< the motor is mounted in reverse; the direction signal is inverted to match
    std::optional<double> following_error_warning, following_error_alarm;  ///< see following_warning(); 0: none
    RackMotor motor;                                                       ///< without a servo only
    std::optional<RackServo> servo;
    RackSwitches switches;
    RackHoming homing;

    /// Index in control::axis_letters, 0 .. 5.
    int index() const;
    /// "mm" or "deg".
    std::string_view unit() const { return kind == AxisKind::linear ? "mm" : "deg"; }
    /// Pulses per motor revolution, exact; for a servo, encoder counts.
    std::int64_t pulses_per_rev() const { return servo ? encoder_counts_per_rev : motor_steps_per_rev * microsteps; }
    /// Motor revolutions per mm or degree.
    double revs_per_unit() const { return kind == AxisKind::linear ? 1 / lead_mm : gear_ratio / 360; }
    /// Pulses per mm or degree: correctly rounded for linear axes, within 1 unit of the last place for rotary ones.
    double pulses_per_unit() const;
    /// Encoder counts per mm or degree; 0 without an encoder.
    double counts_per_unit() const;
    /// Pulse rate at max_velocity.
    double max_pulse_hz() const { return max_velocity * pulses_per_unit(); }
    /// Following-error limits in mm or degrees. Above following_alarm() the machine stops; above following_warning() it
    /// reports a warning. 0: no limit.
    double following_alarm() const;
    double following_warning() const;
};

/// Returns an axis of that letter with the rack file's defaults (positions 0 .. 300 mm or 0 .. 360 degrees).
RackAxis default_axis(char letter);

// ---- Probe

/// A touch probe and the workpiece that it touches, in machine coordinates, mm. An axis without both bounds does not
/// limit the workpiece.
struct RackProbe {
    std::optional<double> x_min, x_max, y_min, y_max, z_min, z_max;

    std::optional<double> lower(int axis) const { return axis == 0 ? x_min : axis == 1 ? y_min : z_min; }
    std::optional<double> upper(int axis) const { return axis == 0 ? x_max : axis == 1 ? y_max : z_max; }
};

// ---- Stages

/// The grating scale of a stage; see parts::LinearScaleSettings.
struct RackScale {
    double pitch_um = 20;               ///< 0.001 .. 1000 um, whole pm
    std::int64_t interpolation = 4096;  ///< counts per pitch: 4 .. 65,536, a multiple of 4
    bool reversed = false;              ///< counts down while the stage moves up
    double zero_offset_mm = 0;          ///< position of count 0
    double max_count_rate_mhz = 20;     ///< million counts per second: 0.001 .. 1000
    std::optional<double> index_mm;     ///< position of the reference mark
    double dirt_position_mm = 0;        ///< start of the dirt of the fault scale.dirt
};

/// Motion of a stage's servo.
enum class StageProfile : std::uint8_t { hold, scan, steps };

/// Control loop on the processor of a stage's card, and its motion.
struct RackStageServo {
    double bandwidth_hz = 250;      ///< 1 .. 10,000 Hz: crossover of the open loop
    std::optional<double> kp_v_um;  ///< gains; absent: derived from the bandwidth
    std::optional<double> ki_v_um_s;
    std::optional<double> kd_v_s_um;
    double max_following_error_um = 100;  ///< 0 .. 1e6 um: a greater following error opens the loop; 0: no limit
    double control_delay_us = 20;         ///< delay from the frame to the voltage, 0 .. 100,000 us
    StageProfile profile = StageProfile::hold;
    double from_mm = 0, to_mm = 10;  ///< scan: range of constant velocity
    double step_mm = 1;              ///< steps: not 0
    std::int64_t steps = 4;          ///< steps: number of steps up, and of steps down after them
    double step_period_ms = 100;     ///< steps: step period, at least the duration of one step
    double max_velocity_mm_s = 80;
    double max_accel_mm_s2 = 8'000;
    double max_jerk_mm_s3 = 1e6;
    double delay_ms = 0;  ///< from the start of the rack to the start of the profile
};

/// A linear motor stage with its scale, driven by a motion card's analog output; see parts::LinearStageSettings.
struct RackStage {
    std::string name;
    std::string card;         ///< one whose type drives stages, see StageDrive
    std::int64_t output = 0;  ///< analog output of the card, 0 .. 3
    std::int64_t input = 0;   ///< number of the stage's scale at the decoder, 0 .. 127
    double accel_per_volt_m_s2 = 5;
    double current_limit_accel_m_s2 = 50;
    double saturation_velocity_m_s = 2;
    double viscous_friction_per_s = 0;
    double coulomb_friction_m_s2 = 0;
    double load_mass_ratio = 0;
    std::optional<double> start_mm;  ///< absent: start of the servo's profile
    double hard_stop_minus_mm = -1000;
    double hard_stop_plus_mm = 1000;
    RackScale scale;
    std::optional<RackStageServo> servo;  ///< absent: the stage is not driven
};

// ---- Lamps

/// A signal lamp of the machine; see parts::SignalLamp.
struct RackLamp {
    std::string name;
    bool active_low = false;  ///< lit while its input is low
};

// ---- Wires

enum class EndOwner : std::uint8_t { card, axis, track, estop, probe, stage, lamp };

/// One end of a wire: pin `pin` of cards[index] ("xpp"), or signal `pin` of axes[index], tracks[index] or lamps[index]
/// (see part_signals.hpp). With an empty pin: the emergency stop or the probe.
struct WireEnd {
    EndOwner owner = EndOwner::card;
    int index = 0;
    std::string pin;
    friend bool operator==(const WireEnd&, const WireEnd&) = default;
};

/// `from` (an output) drives `to` (an input). An output may drive several inputs. An input has at most one wire;
/// without a wire it is open.
struct RackWire {
    WireEnd from;
    WireEnd to;
    bool by_default = true;  ///< from the default rule, not from the file
    bool link = false;       ///< part of a PulseLink or an EncoderLink, not switched edge by edge
};

/// Step and direction wires as one link, which carries a position as a function of time: the pulses of channel
/// `channel` of cards[card] turn the motor of axes[axis].
struct PulseLink {
    int axis = 0;
    int card = 0;
    int channel = 0;
    friend bool operator==(const PulseLink&, const PulseLink&) = default;
};

/// Encoder wires as one link: the encoder of axes[axis] is connected to the inputs of channel `channel` of cards[card].
/// `swapped`: track A at input B, so that it counts backwards.
struct EncoderLink {
    int axis = 0;
    int card = 0;
    int channel = 0;
    bool swapped = false;
    friend bool operator==(const EncoderLink&, const EncoderLink&) = default;
};

// ---- The rack

/// Path settings of the controller where the part program does not set them.
struct RackController {
    double default_path_tolerance_mm = 0.01;  ///< for G64 without P
    std::string profile = "trapezoid";        ///< velocity profile along paths: trapezoid or jerk_limited
    double arc_tolerance_mm = 0.002;          ///< maximum distance between an arc and its chords
};

/// Operator safety contacts; see safety_contacts.hpp.
struct RackSafety {
    std::int64_t estop_channels = 1;    ///< 2: the emergency stop has the wires estop1 and estop2
    double estop_discrepancy_ms = 500;  ///< longest permitted difference of the two channels
    bool door = false;                  ///< the machine has a door, with the wire door
};

/// A complete, checked rack: every name is known, every wire has two ends.
struct RackConfig {
    std::string name = "rack";
    std::vector<RackCard> cards;  ///< in the order of the file
    std::vector<RackAxis> axes;   ///< in the order X Y Z A B C
    std::optional<RackProbe> probe;
    std::vector<RackStage> stages;       ///< in the order of the file
    std::vector<RackConveyor> tracks;    ///< belts, then tables, each in the order of the file
    std::vector<RackScanner> scanners;   ///< in the order of the file
    std::vector<RackLamp> lamps;         ///< in the order of the file
    std::vector<RackWire> wires;         ///< default rule with the file's changes; sorted by `to`: cards, axes, pins
    std::vector<WireEnd> open;           ///< card inputs that the file leaves open; an open contact input is active
    std::vector<PulseLink> pulse_links;  ///< derived from `wires`; the motor of an axis without one is not driven
    std::vector<EncoderLink> encoder_links;  ///< derived from `wires`; at most one per channel
    RackController controller;
    RackSafety safety;

    /// Returns the axis of that letter, or nullptr.
    const RackAxis* axis(char letter) const;
    /// Returns the card of that name, or nullptr.
    const RackCard* card(std::string_view card_name) const;
    /// Returns the belt or table of that name, or nullptr.
    const RackConveyor* track(std::string_view track_name) const;
    /// Returns true if the axis' card positions it by itself.
    bool positions_alone(const RackAxis& axis) const;
    /// Returns true if the axis has the switch that homing on its card needs.
    bool can_home(const RackAxis& axis) const {
        return axis.switches.home || (axis.switches.has_cam() && positions_alone(axis));
    }
    /// Returns true if every axis' card positions it by itself, so that axes cannot follow a path together.
    bool point_to_point() const;
    /// Returns true if paths are planned with limited jerk.
    bool jerk_limited() const { return controller.profile == "jerk_limited" && !point_to_point(); }
    /// Axis limits for the planner; axes missing from the rack are not present.
    control::MachineLimits limits() const;
    /// Returns "motion.xpp", "X.step", "estop" or "probe".
    std::string end_name(const WireEnd& end) const;
};

/// Result of reading a rack file: a config if and only if `errors` is empty. Both lists are sorted by location.
struct RackReading {
    std::optional<RackConfig> config;
    std::vector<Error> errors;
    std::vector<Error> warnings;
};

/// Reads a rack file or its text. A string with a line end or '=' is a text; any other string is a path.
RackReading read_rack(std::string_view path_or_text);

/// Reads the text of a rack file. `file` is used in errors. Never throws; any text gives a config or errors.
RackReading read_rack_text(std::string_view text, std::string_view file = {});

/// Reads a rack file of at most 1 MB. Errors: io if it cannot be read, then the errors of the text.
RackReading read_rack_file(const std::filesystem::path& path);

/// Reference page of the rack file (Markdown): sections, keys, units, ranges, defaults, card types and their pins.
std::string rack_file_reference();

}  // namespace motionrack::rack
