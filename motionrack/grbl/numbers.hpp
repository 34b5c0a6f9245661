// Grbl's error and alarm numbers, except those of G-code lines (control::gcode::GrblStatus).
#pragma once

namespace motionrack::grbl {

enum Error : int {
    reset_now = -2,     ///< the line is answered, and the session must be reset
    answer_later = -1,  ///< the answer to the line is deferred
    error_none = 0,
    error_letter = 1,  ///< a G-code word does not begin with a letter
    error_bad_number = 2,
    error_unknown = 3,  ///< unknown $ command or setting, or a read-only one
    error_negative = 4,
    error_no_homing = 5,
    error_short_pulse = 6,
    error_not_idle = 8,
    error_locked = 9,
    error_line_length = 11,
    error_jog = 16,
    error_unsupported = 20,
    error_no_feed = 22,
    error_no_axis_words = 26,
    error_unused_words = 36
};

enum Alarm : int {
    alarm_none = 0,
    alarm_hard_limit = 1,
    alarm_soft_limit = 2,
    alarm_reset = 3,          ///< stopped in motion
    alarm_probe_initial = 4,  ///< the probe is triggered before the move, or released before a move away
    alarm_probe_contact = 5,  ///< no contact, or no release, during the move
    alarm_homing_reset = 6,
    alarm_homing_door = 7,
    alarm_homing_pull_off = 8,  ///< the switch was found, but its edge was not
    alarm_homing_no_switch = 9
};

}  // namespace motionrack::grbl
