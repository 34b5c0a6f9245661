// Sections [axis.X] of a rack file: their keys. The reader of the file reads them, with the ideal axes of a card alone.
#include <fmt/format.h>

#include <array>
#include <motionrack/rack/card_types.hpp>
#include <motionrack/rack/part_sections.hpp>

namespace motionrack::rack {

namespace {

constexpr std::array<std::string_view, 2> axis_kinds = {"linear", "rotary"};

constexpr std::array<Field, 18> axis_table = {
    required(field<&RackAxis::card>("card", 1, 32, "", "name of the card that drives the axis"), "required"),
    absent_means(field<&RackAxis::channel>("channel", 1, 1, "", "the card's channel"), "the only one of its card"),
    absent_means(with_choices(field<&RackAxis::kind>("kind", 0, 0, "", "X Y Z are linear, A B C rotary"), axis_kinds),
                 "by the letter"),
    field<&RackAxis::motor_steps_per_rev>("motor_steps_per_rev", 1, 1'000'000, "",
                                          "full steps of a motor turn; not of a servo"),
    field<&RackAxis::microsteps>("microsteps", 1, 1024, "", "pulses of a full step; not of a servo"),
    only_in(field<&RackAxis::lead_mm>("lead_mm", 0.001, 10'000, "mm", "travel of a motor turn"), "mm"),
    only_in(field<&RackAxis::gear_ratio>("gear_ratio", 0.001, 100'000, "", "motor turns of a turn of the axis"), "deg"),
    formerly("max_speed_{u}_s",
             field<&RackAxis::max_velocity>("max_velocity_{u}_s", 0.000001, 1e6, "{u}/s", "maximum velocity")),
    field<&RackAxis::max_accel>("max_accel_{u}_s2", 0.001, 1e9, "{u}/s2", "maximum acceleration"),
    field<&RackAxis::max_jerk>("max_jerk_{u}_s3", 0, 1e12, "{u}/s3", "maximum jerk; 0: trapezoids"),
    formerly("start_speed_{u}_s", field<&RackAxis::max_velocity_step>("max_velocity_step_{u}_s", 0.000001, 1e6, "{u}/s",
                                                                      "velocity step that the motor can follow")),
    formerly("min_{u}", field<&RackAxis::min_limit>("min_limit_{u}", -1e7, 1e7, "{u}", "minimum commanded position")),
    formerly("max_{u}", field<&RackAxis::max_limit>("max_limit_{u}", -1e7, 1e7, "{u}", "maximum commanded position")),
    formerly("start_{u}", field<&RackAxis::initial_position>("initial_position_{u}", -1e7, 1e7, "{u}",
                                                             "initial position of the machine")),
    field<&RackAxis::encoder_counts_per_rev>("encoder_counts_per_rev", 0, 10'000'000, "",
                                             "quadrature counts (4 a line) of a motor turn; 0: no encoder"),
    field<&RackAxis::reversed>("reversed", 0, 1, "",
                               "the motor is mounted reversed; the direction signal is inverted to match"),
    absent_means(field<&RackAxis::following_error_warning>(
                     "following_error_warning_{u}", 0, 1e6, "{u}",
                     "following error (commanded position against encoder counts) of a warning; 0: none"),
                 "half of the alarm's"),
    absent_means(field<&RackAxis::following_error_alarm>(
                     "following_error_alarm_{u}", 0, 1e6, "{u}",
                     "following error that stops the machine and invalidates the position; 0: none"),
                 "1, at least 4 counts; for a servo at least its travel in 0.1 s at maximum velocity"),
};

constexpr std::array<Field, 2> motor_table = {
    field<&RackMotor::start_stop_hz>("start_stop_hz", 1, 1e7, "Hz",
                                     "maximum pulse rate (microsteps/s) for starts and stops"),
    field<&RackMotor::pull_out_hz>("pull_out_hz", 1, 1e7, "Hz", "pulse rate (microsteps/s) above which it loses steps"),
};

constexpr std::array<Field, 8> servo_table = {
    formerly("speed_per_volt_{u}_s", field<&RackServo::velocity_per_volt>("velocity_per_volt_{u}_s", 0.000001, 1e6,
                                                                          "{u}/s", "velocity per volt")),
    absent_means(
        formerly("top_speed_{u}_s", field<&RackServo::saturation_velocity>("saturation_velocity_{u}_s", 0.000001, 1e7,
                                                                           "{u}/s", "saturation of the amplifier")),
        "the velocity at 10 V"),
    formerly("top_accel_{u}_s2",
             field<&RackServo::current_limit_accel>("current_limit_accel_{u}_s2", 0.001, 1e9, "{u}/s2",
                                                    "acceleration at the amplifier's current limit, without the load")),
    formerly("friction_{u}_s2", field<&RackServo::coulomb_friction>("coulomb_friction_{u}_s2", 0, 1e9, "{u}/s2",
                                                                    "deceleration without current")),
    formerly("lag_ms", field<&RackServo::time_constant_ms>("time_constant_ms", 0.1, 10'000, "ms",
                                                           "time constant of the velocity, without the load")),
    field<&RackServo::dead_band_v>("dead_band_v", 0, 5, "V", "voltage below which the amplifier does not react"),
    formerly("load", field<&RackServo::load_inertia_ratio>("load_inertia_ratio", 0, 1000, "",
                                                           "inertia of the load in units of the motor's own")),
    absent_means(formerly("hold_within_{u}",
                          field<&RackServo::position_window>("position_window_{u}", 0, 1e6, "{u}",
                                                             "in-position window of the card's position lock")),
                 "no lock"),
};

constexpr std::array<Field, 7> switch_table = {
    absent_means(field<&RackSwitches::limit_minus>("limit_minus_{u}", -1e7, 1e7, "{u}", "active at and below"),
                 "no such switch"),
    absent_means(field<&RackSwitches::limit_plus>("limit_plus_{u}", -1e7, 1e7, "{u}", "active at and above"),
                 "no such switch"),
    absent_means(field<&RackSwitches::home>("home_{u}", -1e7, 1e7, "{u}", "active at and below"), "no such switch"),
    absent_means(field<&RackSwitches::cam_from>("cam_from_{u}", -1e7, 1e7, "{u}", "a reference cam: active from here"),
                 "no cam"),
    absent_means(field<&RackSwitches::cam_to>("cam_to_{u}", -1e7, 1e7, "{u}", "to here"), "no cam"),
    field<&RackSwitches::hysteresis>("hysteresis_{u}", 0, 100, "{u}", "switch hysteresis"),
    field<&RackSwitches::bounce_ms>("bounce_ms", 0, 100, "ms", "bounce time of the contacts; 0: clean edges"),
};

constexpr std::array<std::string_view, 2> directions = {"minus", "plus"};

constexpr std::array<Field, 8> homing_table = {
    formerly("home_type",
             field<&RackHoming::method>(
                 "method", 1, 4, "",
                 "1 stop at the switch, 2 then again slowly, 3 as 1, then to the index, 4 as 2, then to the index "
                 "(unlike HomeType4, which ends at the switch)")),
    with_choices(
        formerly("direction", field<&RackHoming::search_direction>("search_direction", 0, 0, "",
                                                                   "direction of the search for the home switch")),
        directions),
    absent_means(formerly("speed_{u}_s", field<&RackHoming::search_velocity>("search_velocity_{u}_s", 0.000001, 1e6,
                                                                             "{u}/s", "velocity of the search")),
                 "a quarter of the maximum velocity"),
    absent_means(formerly("slow_speed_{u}_s", field<&RackHoming::latch_velocity>(
                                                  "latch_velocity_{u}_s", 0.000001, 1e6, "{u}/s",
                                                  "velocity of the last approach, at most the velocity step")),
                 "a quarter of the velocity step; of a servo all of it"),
    absent_means(formerly("position_{u}",
                          field<&RackHoming::home_offset>("home_offset_{u}", -1e7, 1e7, "{u}", "position of home")),
                 "position of the switch edge; methods 3 and 4: plus index_after, and one of both keys is required"),
    absent_means(field<&RackHoming::index_after>("index_after_{u}", 0, 1000, "{u}",
                                                 "distance from the switch to the index (methods 3 and 4); one that is "
                                                 "off by more than a quarter of a motor turn is rejected"),
                 "the first index; in a served machine that of its first search"),
    formerly("clearance_{u}",
             field<&RackHoming::backoff>("backoff_{u}", 0, 1000, "{u}", "distance moved after the switch is released")),
    formerly("order", field<&RackHoming::sequence>("sequence", 0, 5, "",
                                                   "0 is homed first; axes of the same number home together")),
};

const RackAxis& default_axis_of(bool rotary) {
    static const RackAxis linear = default_axis('X'), turning = default_axis('A');
    return rotary ? turning : linear;
}
const void* axis_defaults(bool rotary) {
    return &default_axis_of(rotary);
}
template <auto member>
const void* axis_default(bool rotary) {
    return &(default_axis_of(rotary).*member);
}

/// Returns the description of the key `channel`, with the channel names of the first card type that has several.
std::string channel_doc() {
    const CardType& type = *find_card_type(card_types_that(has_channels).front());
    const int count = type.channel_count();
    std::string names;
    for (int channel = 0; channel < count; ++channel)
        names += fmt::format("{}{}",
                             channel == 0          ? ""
                             : channel + 1 < count ? ", "
                                                   : " or ",
                             type.channel_name(channel));
    return fmt::format("the card's channel ({} of an {})", names, type.name);
}

std::span<const Field> axis_fields() {
    static const std::string channel = channel_doc();
    static const auto table = with_doc(axis_table, "channel", channel);
    return table;
}

constexpr std::array<std::string_view, 1> axis_keys = {"axis"};
constexpr std::array<PartSection, 5> axis_section_rows = {{
    {"[axis.NAME]", "NAME is X, Y, Z (linear, mm) or A, B, C (rotary, degrees).", axis_fields, axis_defaults},
    {"[axis.NAME.motor]", "Pulses are microsteps.", rows_of<motor_table>, axis_default<&RackAxis::motor>},
    {"[axis.NAME.servo]",
     "A servo amplifier with a DC motor and its tacho, in place of the stepping motor; with the section, even an empty "
     "one, the axis follows a voltage. The model is a first-order lag with a current limit.",
     rows_of<servo_table>, default_object<RackServo>},
    {"[axis.NAME.switches]", "Machine positions where they act.", rows_of<switch_table>,
     axis_default<&RackAxis::switches>},
    {"[axis.NAME.homing]", "How `motionrack home` finds the home switch.", rows_of<homing_table>,
     axis_default<&RackAxis::homing>},
}};

}  // namespace

constinit const PartSections axis_sections = {axis_keys, axis_section_rows, nullptr, nullptr};

}  // namespace motionrack::rack
