// What a rack file says, as plain structs with units: cards in slots, axes of the machine, wires, the controller's
// settings.
//
//   rack file (TOML) --read_rack--> RackConfig --(rack)--> running cards, wires and parts
//                        |
//                        +--> every mistake with its place, and warnings
#pragma once

#include <cstdint>
#include <filesystem>
#include <motionrack/base/result.hpp>
#include <motionrack/control/limits.hpp>
#include <motionrack/rack/config_marking.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

// ---- Cards

/// How wide a card's bus is.
enum class BusWidth : std::uint8_t { bits16, bits8 };
/// The two chips that a card of type mcx314 may have.
enum class Mcx314Variant : std::uint8_t { mcx314, mcx314as };
/// Where the sources do not agree: the speed of a drive with V <= SV, where + software limits begin.
enum class Mcx314SlowDrives : std::uint8_t { at_v, at_sv };
enum class Mcx314SoftwareLimits : std::uint8_t { beyond, at };

/// Settings of a card of type mcx314.
struct Mcx314Settings {
    Mcx314Variant variant = Mcx314Variant::mcx314;
    Mcx314SlowDrives slow_drives = Mcx314SlowDrives::at_v;
    Mcx314SoftwareLimits software_limits = Mcx314SoftwareLimits::beyond;
    std::int64_t ao_after_reset = 8;     ///< 0 .. 65,535 pulses
    std::int64_t clock_hz = 16'000'000;  ///< only this: the model's tick is 125 ns
    BusWidth bus = BusWidth::bits16;     ///< on 8 bits a register takes two accesses
    std::int64_t bus_access_ns = 250;    ///< 0 .. 100,000 ns for an access
    std::int64_t host_latency_us = 50;   ///< 0 .. 10,000 us from an interrupt to the host's first access
};

/// How O1 and O2 of a DataBoard 4002 are counted, and how often in a period of the encoder.
enum class Databoard4002Counting : std::uint8_t { quadrature_4, quadrature_2, quadrature_1, up_down };

/// Settings of a card of type databoard4002: straps, the version of its program, its place on the bus.
struct Databoard4002Settings {
    std::int64_t select = 13;  ///< 0 .. 31: its number on the bus of all such cards
    Databoard4002Counting counting = Databoard4002Counting::quadrature_4;
    std::int64_t first_pair = 0;          ///< 0 .. 3: strap pair A-B, C-D, E-F, G-H
    bool single_ended = false;            ///< encoder lines up to 50 kHz instead of 100 kHz
    bool zeroing = true;                  ///< enabling the zero or reference event arms the zeroing
    bool quit_zeroes = true;              ///< the command Q zeroes what P and N have set
    std::string trim;                     ///< see databoard4002::trim_from_text
    std::int64_t version = 32;            ///< 0 .. 255: what the command V answers
    std::int64_t pass_ticks = 1;          ///< 1 .. 4,000 ticks of 2.5 us
    std::int64_t byte_time_ns = 100'000;  ///< 2,500 .. 100,000,000 ns
    std::int64_t bus_access_ns = 1'000;   ///< 0 .. 100,000 ns
};

/// Settings of a card of type ioflex02.
struct Ioflex02Settings {
    std::int64_t base_address = 0x2300;  ///< 0 .. FF00h, a multiple of 100h: its place on the bus of such cards
    std::int64_t serial = 1;             ///< 0 .. 65,535
    double configuration_ms = 2'000;     ///< 0 .. 60,000 ms from the image's last byte to the running project
    bool loaded = true;                  ///< a project runs from power-up, without the host loading it
    std::string image;                 ///< its compressed image in hexadecimal digits; empty: the one that is built in
    std::int64_t bus_access_ns = 500;  ///< 0 .. 100,000 ns
};

/// What a card of a grating bus is: the first one of a rack is the host unless it is said.
enum class GratingRole : std::uint8_t { first_is_host, host, slave, remote };
/// Which way a level shifter of such a card works.
enum class GratingShifter : std::uint8_t { as_role, out, in };

/// Settings of a card of type grating_bus; the model's are in cards/grating_bus/model/settings.hpp.
struct GratingBusSettings {
    GratingRole role = GratingRole::first_is_host;
    std::int64_t scales = 4;                                   ///< 1 .. 128 scales of a frame
    std::int64_t first = 0;                                    ///< 0 .. 127: address of the first one
    std::string addresses;                                     ///< the list of addresses, see addresses_from_text
    double t1_ns = 20, t2_ns = 30, t3_ns = 30, clock_ns = 10;  ///< 0.1 .. 6,000 ns
    double period_us = 200;                                    ///< 1 .. 100,000 us
    double offset_ns = 0;                                      ///< 0 .. 1e8 ns, at most a period
    GratingShifter clock_shifter = GratingShifter::as_role;
    GratingShifter address_shifter = GratingShifter::as_role;
    bool checks = true;
    std::int64_t seed = 1;            ///< 0 .. 2^31 - 1
    std::int64_t bus_access_ns = 40;  ///< 0 .. 100,000 ns
};

/// Settings of a card of type grating_decoder.
struct GratingDecoderSettings {
    std::int64_t scales = 4;           ///< 1 .. 128
    double latch_ns = 10;              ///< 0 .. 6,000 ns
    double output_ns = 20;             ///< 0.1 .. 6,000 ns
    std::int64_t bus_access_ns = 500;  ///< 0 .. 100,000 ns
};

/// Settings of a card of type rtc5; the model's are in cards/rtc5/model/settings.hpp.
struct Rtc5Settings {
    std::int64_t list_memory = 1 << 20;  ///< 16 .. 1,048,576 positions
};

/// One card; only the settings of its own type mean something. Defaults of the members are the rack file's defaults.
struct RackCard {
    std::string name;             ///< as the wires call it: letters, digits, '_'
    std::string type = "mcx314";  ///< a name in card_types()
    std::optional<int> slot;      ///< 0 .. 20; always set by read_rack (the lowest free slot if the file says none)
    Mcx314Settings mcx314;
    Databoard4002Settings databoard4002;
    Ioflex02Settings ioflex02;
    GratingBusSettings grating_bus;
    GratingDecoderSettings grating_decoder;
    Rtc5Settings rtc5;
};

// ---- Axes

enum class AxisKind : std::uint8_t {
    linear,  ///< X Y Z: positions in mm
    rotary   ///< A B C: positions in degrees
};

/// The stepping motor of an axis; rates are pulses (microsteps) a second.
struct RackMotor {
    double start_stop_hz = 2000;   ///< it starts and stops at up to this rate without losing steps
    double pull_out_hz = 200'000;  ///< above this rate it loses steps
};

/// A servo amplifier with a DC motor and its tacho, in place of a stepping motor: the axis follows a voltage.
struct RackServo {
    double speed_per_volt = 100;        ///< mm/s or degrees/s for a volt
    std::optional<double> top_speed;    ///< saturation of the amplifier; absent: the speed at 10 V
    double top_accel = 5000;            ///< at the amplifier's current limit, without a load
    double friction = 50;               ///< per second squared: how fast it comes to rest without current
    double lag_ms = 10;                 ///< time constant of the speed
    double dead_band_v = 0.005;         ///< V below which the amplifier does nothing
    double load = 0;                    ///< the load's inertia in units of the motor's own
    std::optional<double> hold_within;  ///< after a move the card keeps the axis within; absent: it lets go

    /// The greatest speed that it reaches.
    double fastest() const { return top_speed.value_or(10 * speed_per_volt); }
};

/// Switches of an axis by the machine position (mm or degrees) where they act; absent: there is no such switch.
struct RackSwitches {
    std::optional<double> limit_minus;  ///< active at and below
    std::optional<double> limit_plus;   ///< active at and above
    std::optional<double> home;         ///< active at and below
    std::optional<double> cam_from;     ///< a reference cam: active from here
    std::optional<double> cam_to;       ///< to here
    double hysteresis = 0.05;           ///< mm or degrees to go back before a switch is released
    double bounce_ms = 1.0;             ///< ms that contacts bounce at each change; 0: clean edges

    bool has_cam() const { return cam_from && cam_to; }
};

enum class HomingDirection : std::uint8_t { minus, plus };

/// How an axis is homed; see control/homing.hpp.
struct RackHoming {
    std::int64_t type = 2;                               ///< 1 .. 4: control::HomeType
    HomingDirection direction = HomingDirection::minus;  ///< in which the home switch is searched
    std::optional<double> speed;                         ///< of the search; absent: a quarter of max_speed
    std::optional<double> slow_speed;                    ///< of the last approach; absent: a quarter of start_speed
    std::optional<double> position;                      ///< what home is called; absent: where the switch's edge is
    std::optional<double> index_after;  ///< how far behind the switch the index is; absent: wherever it is first
    double clearance = 0.1;             ///< mm or degrees driven on after the switch is released
    std::int64_t order = 0;             ///< axes of the lowest order are homed first, those of the same together
};

/// One axis of the machine. Positions and speeds are in mm (linear) or degrees (rotary), the axis' "unit", and seconds.
struct RackAxis {
    char letter = 'X';  ///< X Y Z A B C
    AxisKind kind = AxisKind::linear;
    std::string card;     ///< the card's name
    std::string channel;  ///< one letter of the card's channels; empty on a card that has but one
    std::int64_t motor_steps_per_rev = 200;
    std::int64_t microsteps = 16;  ///< pulses for one full step
    double lead_mm = 5;            ///< linear: travel for one motor turn
    double gear_ratio = 90;        ///< rotary: motor turns for one turn of the axis
    double max_velocity = 100;
    double max_accel = 1000;
    double max_jerk = 20'000;  ///< 0: trapezoids
    double max_velocity_step = 2;
    double min_position = 0;
    double max_position = 300;
    double start_position = 0;                   ///< where the machine stands when the rack starts
    std::int64_t encoder_counts_per_rev = 4000;  ///< quadrature counts (4 a line) for one motor turn; 0: no encoder
    bool reversed = false;  ///< the motor is mounted the other way round; the direction signal is inverted to match
    std::optional<double> following_error_warning, following_error_alarm;  ///< see following_warning(); 0: none
    RackMotor motor;                                                       ///< without a servo
    std::optional<RackServo> servo;
    RackSwitches switches;
    RackHoming homing;

    /// 0 .. 5: the index in control::axis_letters.
    int index() const;
    /// "mm" or "deg".
    std::string_view unit() const { return kind == AxisKind::linear ? "mm" : "deg"; }
    /// Pulses for one motor turn, exact; of a servo the counts of its encoder.
    std::int64_t pulses_per_rev() const { return servo ? encoder_counts_per_rev : motor_steps_per_rev * microsteps; }
    /// Motor turns for one mm or degree.
    double revs_per_unit() const { return kind == AxisKind::linear ? 1 / lead_mm : gear_ratio / 360; }
    /// Pulses for one mm or degree, correctly rounded for linear axes, within 1 unit of the last place for rotary ones.
    double pulses_per_unit() const;
    /// Encoder counts for one mm or degree; 0 without an encoder.
    double counts_per_unit() const;
    /// The pulse rate at max_speed.
    double max_pulse_hz() const { return max_velocity * pulses_per_unit(); }
    /// By how much the encoder may be off from what drives the axis before the machine is stopped, and before it is
    /// told: mm or degrees; 0: by anything.
    double following_alarm() const;
    double following_warning() const;
};

/// An axis of that letter with the rack file's defaults (positions 0 .. 300 mm or 0 .. 360 degrees).
RackAxis default_axis(char letter);

// ---- Probe

/// A touch probe and the block that it touches, machine coordinates in mm; along an axis without both bounds the block
/// goes on for ever.
struct RackProbe {
    std::optional<double> x_from, x_to, y_from, y_to, z_from, z_to;

    std::optional<double> from(int axis) const { return axis == 0 ? x_from : axis == 1 ? y_from : z_from; }
    std::optional<double> to(int axis) const { return axis == 0 ? x_to : axis == 1 ? y_to : z_to; }
};

// ---- Stages

/// The grating scale of a stage; see parts::LinearScaleSettings.
struct RackScale {
    double pitch_um = 20;               ///< 0.001 .. 1000 um, whole pm
    std::int64_t interpolation = 4096;  ///< 4 .. 65,536, a multiple of 4: counts of a pitch
    bool reversed = false;              ///< counts down where the stage goes up
    double zero_mm = 0;                 ///< where it shows 0
    double max_count_rate_mhz = 20;     ///< 0.001 .. 1000 million counts a second
    std::optional<double> index_mm;     ///< where the reference mark is
    double dirt_at_mm = 0;              ///< where the dirt of the fault scale.dirt begins
};

/// Where a stage's servo brings it.
enum class StageProfile : std::uint8_t { hold, scan, steps };

/// The loop that the processor of a stage's card closes, and where it goes.
struct RackStageServo {
    double bandwidth_hz = 250;     ///< 1 .. 10,000 Hz: the open loop crosses 1
    std::optional<double> p_v_um;  ///< gains; absent: they follow from the bandwidth
    std::optional<double> i_v_um_s;
    std::optional<double> d_v_s_um;
    double limit_um = 100;   ///< 0 .. 1e6 um: a greater following error opens the loop; 0: none
    double compute_us = 20;  ///< 0 .. 100,000 us from the frame to the voltage
    StageProfile profile = StageProfile::hold;
    double from_mm = 0, to_mm = 10;  ///< scan: it is at constant speed between
    double step_mm = 1;              ///< steps: not 0
    std::int64_t steps = 4;          ///< steps: so many up, then as many down
    double every_ms = 100;           ///< steps: at least as long as one takes
    double speed_mm_s = 80;
    double accel_mm_s2 = 8'000;
    double jerk_mm_s3 = 1e6;
    double delay_ms = 0;  ///< the profile begins then
};

/// A linear motor stage with its scale, driven by a motion card's analog output; see parts::LinearStageSettings.
struct RackStage {
    std::string name;
    std::string card;         ///< of type grating_bus
    std::int64_t output = 0;  ///< 0 .. 3: the card's analog output
    std::int64_t input = 0;   ///< 0 .. 127: number of its scale at the decoder
    double accel_per_volt_m_s2 = 5;
    double top_accel_m_s2 = 50;
    double top_speed_m_s = 2;
    double viscous_per_s = 0;
    double coulomb_m_s2 = 0;
    double load = 0;
    std::optional<double> start_mm;  ///< absent: where its servo's profile begins
    double end_minus_mm = -1000;
    double end_plus_mm = 1000;
    RackScale scale;
    std::optional<RackStageServo> servo;  ///< absent: nobody drives it
};

// ---- Wires

enum class EndOwner : std::uint8_t { card, axis, track, estop, probe };

/// One end of a wire: pin `pin` of cards[index] ("xpp"), end `pin` of axes[index] (see axis_ends()) or tracks[index]
/// (see track_ends()), or the emergency stop or the probe (pin empty).
struct WireEnd {
    EndOwner owner = EndOwner::card;
    int index = 0;
    std::string pin;
    friend bool operator==(const WireEnd&, const WireEnd&) = default;
};

/// `from` (an output) drives `to` (an input). An output may drive many inputs; an input has one wire at most, and
/// without one it is open.
struct RackWire {
    WireEnd from;
    WireEnd to;
    bool by_default = true;  ///< from the default rule, not from the file
    bool link = false;       ///< it is a part of a PulseLink or an EncoderLink, not switched edge by edge
};

/// Pulses and encoder tracks of the wires, joined into what they carry: a position as a function of time.
/// The pulses of that channel of cards[card] turn the motor of axes[axis].
struct PulseLink {
    int axis = 0;
    int card = 0;
    int channel = 0;
    friend bool operator==(const PulseLink&, const PulseLink&) = default;
};

/// The encoder of axes[axis] is at the encoder inputs of that channel; `swapped`: track A at input B, so that it counts
/// backwards.
struct EncoderLink {
    int axis = 0;
    int card = 0;
    int channel = 0;
    bool swapped = false;
    friend bool operator==(const EncoderLink&, const EncoderLink&) = default;
};

// ---- The rack

/// How the controller drives paths where the part program does not say.
struct RackController {
    double default_path_tolerance_mm = 0.01;  ///< for G64 without P
    std::string profile = "trapezoid";        ///< of the speed along paths: trapezoid or jerk_limited
    double arc_tolerance_mm = 0.002;          ///< greatest distance of an arc from the short lines that stand for it
};

/// The contacts for people; see safety_contacts.hpp.
struct RackSafety {
    std::int64_t estop_channels = 1;    ///< 2: the emergency stop has the wires estop1 and estop2
    double estop_discrepancy_ms = 500;  ///< so long they may be unlike
    bool door = false;                  ///< there is a door, with the wire door
};

/// A whole rack, checked: every name is known, every wire has its two ends.
struct RackConfig {
    std::string name = "rack";
    std::vector<RackCard> cards;  ///< in the order of the file
    std::vector<RackAxis> axes;   ///< in the order X Y Z A B C
    std::optional<RackProbe> probe;
    std::vector<RackStage> stages;      ///< in the order of the file
    std::vector<RackConveyor> tracks;   ///< belts, then tables, each in the order of the file
    std::vector<RackScanner> scanners;  ///< in the order of the file
    std::vector<RackWire> wires;        ///< the default rule with the file's changes; sorted by `to`: cards, axes, pins
    std::vector<WireEnd> open;          ///< inputs of cards that the file leaves open; a contact's input is active then
    std::vector<PulseLink> pulse_links;  ///< follow from `wires`; an axis without one has a motor that nobody drives
    std::vector<EncoderLink> encoder_links;  ///< follow from `wires`; one at most for each channel
    RackController controller;
    RackSafety safety;

    /// The axis of that letter, or nullptr.
    const RackAxis* axis(char letter) const;
    /// The card of that name, or nullptr.
    const RackCard* card(std::string_view card_name) const;
    /// The belt or table of that name, or nullptr.
    const RackConveyor* track(std::string_view track_name) const;
    /// Whether the axis is on a card that positions it by itself.
    bool positions_alone(const RackAxis& axis) const;
    /// Whether the axis has the switch that homing on its card needs.
    bool can_home(const RackAxis& axis) const {
        return axis.switches.home || (axis.switches.has_cam() && positions_alone(axis));
    }
    /// Whether every axis is on a card that positions it by itself, so that none can move along a path together.
    bool point_to_point() const;
    /// Paths are driven with limited jerk.
    bool jerk_limited() const { return controller.profile == "jerk_limited" && !point_to_point(); }
    /// What each axis may do, for the planner; axes that the rack has not are not present.
    control::MachineLimits limits() const;
    /// "motion.xpp", "X.step", "estop", "probe".
    std::string end_name(const WireEnd& end) const;
};

/// What reading a rack file gave: a config exactly if there are no errors. Both lists are sorted by place.
struct RackReading {
    std::optional<RackConfig> config;
    std::vector<Error> errors;
    std::vector<Error> warnings;
};

/// Reads a rack file, or the text of one: what has a line end or '=' in it is text, anything else the path of a file.
RackReading read_rack(std::string_view path_or_text);

/// Reads the text of a rack file. `file` stands in the errors. Never throws; any text gives a config or errors.
RackReading read_rack_text(std::string_view text, std::string_view file = {});

/// Reads a rack file of at most 1 MB. Errors: io if it cannot be read, then those of the text.
RackReading read_rack_file(const std::filesystem::path& path);

/// The reference page of the rack file (Markdown): sections, keys, units, ranges, defaults, card types and their pins.
std::string rack_file_reference();

}  // namespace motionrack::rack
