// The list commands of rtc5sim.h: each is put into the list that set_start_list opened.
#include <motionrack/frontends/rtc5sim/calls.hpp>

using motionrack::rtc5::Op;
using namespace motionrack::rtc5sim;

// ---- Lists: the path
// ---------------------------------------------------------------------------------------------------

void n_jump_abs(UINT CardNo, long X, long Y) {
    put(CardNo, Op::jump_abs, X, Y);
}
void jump_abs(long X, long Y) {
    n_jump_abs(selected(), X, Y);
}
void n_jump_rel(UINT CardNo, long dX, long dY) {
    put(CardNo, Op::jump_rel, dX, dY);
}
void jump_rel(long dX, long dY) {
    n_jump_rel(selected(), dX, dY);
}
void n_mark_abs(UINT CardNo, long X, long Y) {
    put(CardNo, Op::mark_abs, X, Y);
}
void mark_abs(long X, long Y) {
    n_mark_abs(selected(), X, Y);
}
void n_mark_rel(UINT CardNo, long dX, long dY) {
    put(CardNo, Op::mark_rel, dX, dY);
}
void mark_rel(long dX, long dY) {
    n_mark_rel(selected(), dX, dY);
}
void n_arc_abs(UINT CardNo, long X, long Y, double Angle) {
    put(CardNo, Op::arc_abs, X, Y, Angle);
}
void arc_abs(long X, long Y, double Angle) {
    n_arc_abs(selected(), X, Y, Angle);
}
void n_arc_rel(UINT CardNo, long dX, long dY, double Angle) {
    put(CardNo, Op::arc_rel, dX, dY, Angle);
}
void arc_rel(long dX, long dY, double Angle) {
    n_arc_rel(selected(), dX, dY, Angle);
}
void n_timed_jump_abs(UINT CardNo, long X, long Y, double T) {
    put(CardNo, Op::timed_jump_abs, X, Y, T);
}
void timed_jump_abs(long X, long Y, double T) {
    n_timed_jump_abs(selected(), X, Y, T);
}
void n_timed_jump_rel(UINT CardNo, long dX, long dY, double T) {
    put(CardNo, Op::timed_jump_rel, dX, dY, T);
}
void timed_jump_rel(long dX, long dY, double T) {
    n_timed_jump_rel(selected(), dX, dY, T);
}
void n_timed_mark_abs(UINT CardNo, long X, long Y, double T) {
    put(CardNo, Op::timed_mark_abs, X, Y, T);
}
void timed_mark_abs(long X, long Y, double T) {
    n_timed_mark_abs(selected(), X, Y, T);
}
void n_timed_mark_rel(UINT CardNo, long dX, long dY, double T) {
    put(CardNo, Op::timed_mark_rel, dX, dY, T);
}
void timed_mark_rel(long dX, long dY, double T) {
    n_timed_mark_rel(selected(), dX, dY, T);
}
void n_micro_vector_abs(UINT CardNo, long X, long Y, long LasOn, long LasOff) {
    put(CardNo, Op::micro_vector_abs, X, Y, LasOn, LasOff);
}
void micro_vector_abs(long X, long Y, long LasOn, long LasOff) {
    n_micro_vector_abs(selected(), X, Y, LasOn, LasOff);
}
void n_micro_vector_rel(UINT CardNo, long dX, long dY, long LasOn, long LasOff) {
    put(CardNo, Op::micro_vector_rel, dX, dY, LasOn, LasOff);
}
void micro_vector_rel(long dX, long dY, long LasOn, long LasOff) {
    n_micro_vector_rel(selected(), dX, dY, LasOn, LasOff);
}

// ---- Lists: speeds, delays, laser, outputs
// -----------------------------------------------------------------------------

void n_set_end_of_list(UINT CardNo) {
    put(CardNo, Op::set_end_of_list);
}
void set_end_of_list() {
    n_set_end_of_list(selected());
}
void n_list_nop(UINT CardNo) {
    put(CardNo, Op::list_nop);
}
void list_nop() {
    n_list_nop(selected());
}
void n_long_delay(UINT CardNo, UINT Delay) {
    put(CardNo, Op::long_delay, Delay);
}
void long_delay(UINT Delay) {
    n_long_delay(selected(), Delay);
}
void n_set_jump_speed(UINT CardNo, double Speed) {
    put(CardNo, Op::set_jump_speed, Speed);
}
void set_jump_speed(double Speed) {
    n_set_jump_speed(selected(), Speed);
}
void n_set_mark_speed(UINT CardNo, double Speed) {
    put(CardNo, Op::set_mark_speed, Speed);
}
void set_mark_speed(double Speed) {
    n_set_mark_speed(selected(), Speed);
}
void n_set_scanner_delays(UINT CardNo, UINT Jump, UINT Mark, UINT Polygon) {
    put(CardNo, Op::set_scanner_delays, Jump, Mark, Polygon);
}
void set_scanner_delays(UINT Jump, UINT Mark, UINT Polygon) {
    n_set_scanner_delays(selected(), Jump, Mark, Polygon);
}
void n_set_laser_delays(UINT CardNo, long LaserOnDelay, UINT LaserOffDelay) {
    put(CardNo, Op::set_laser_delays, LaserOnDelay, LaserOffDelay);
}
void set_laser_delays(long LaserOnDelay, UINT LaserOffDelay) {
    n_set_laser_delays(selected(), LaserOnDelay, LaserOffDelay);
}
void n_laser_on_list(UINT CardNo, UINT Period) {
    put(CardNo, Op::laser_on_list, Period);
}
void laser_on_list(UINT Period) {
    n_laser_on_list(selected(), Period);
}
void n_laser_signal_on_list(UINT CardNo) {
    put(CardNo, Op::laser_signal_on_list);
}
void laser_signal_on_list() {
    n_laser_signal_on_list(selected());
}
void n_laser_signal_off_list(UINT CardNo) {
    put(CardNo, Op::laser_signal_off_list);
}
void laser_signal_off_list() {
    n_laser_signal_off_list(selected());
}
void n_write_io_port_list(UINT CardNo, UINT Value) {
    put(CardNo, Op::write_io_port_list, Value);
}
void write_io_port_list(UINT Value) {
    n_write_io_port_list(selected(), Value);
}

// ---- Lists: processing on the fly
// --------------------------------------------------------------------------------------

void n_set_fly_x(UINT CardNo, double ScaleX) {
    put(CardNo, Op::set_fly_x, ScaleX);
}
void set_fly_x(double ScaleX) {
    n_set_fly_x(selected(), ScaleX);
}
void n_set_fly_y(UINT CardNo, double ScaleY) {
    put(CardNo, Op::set_fly_y, ScaleY);
}
void set_fly_y(double ScaleY) {
    n_set_fly_y(selected(), ScaleY);
}
void n_set_fly_z(UINT CardNo, double ScaleZ, UINT EncoderNo) {
    put(CardNo, Op::set_fly_z, ScaleZ, EncoderNo);
}
void set_fly_z(double ScaleZ, UINT EncoderNo) {
    n_set_fly_z(selected(), ScaleZ, EncoderNo);
}
void n_set_fly_rot(UINT CardNo, double Resolution) {
    put(CardNo, Op::set_fly_rot, Resolution);
}
void set_fly_rot(double Resolution) {
    n_set_fly_rot(selected(), Resolution);
}
void n_set_fly_2d(UINT CardNo, double ScaleX, double ScaleY) {
    put(CardNo, Op::set_fly_2d, ScaleX, ScaleY);
}
void set_fly_2d(double ScaleX, double ScaleY) {
    n_set_fly_2d(selected(), ScaleX, ScaleY);
}
void n_activate_fly_xy(UINT CardNo, double ScaleX, double ScaleY) {
    put(CardNo, Op::activate_fly_xy, ScaleX, ScaleY);
}
void activate_fly_xy(double ScaleX, double ScaleY) {
    n_activate_fly_xy(selected(), ScaleX, ScaleY);
}
void n_activate_fly_2d(UINT CardNo, double ScaleX, double ScaleY) {
    put(CardNo, Op::activate_fly_2d, ScaleX, ScaleY);
}
void activate_fly_2d(double ScaleX, double ScaleY) {
    n_activate_fly_2d(selected(), ScaleX, ScaleY);
}
void n_set_fly_x_pos(UINT CardNo, double ScaleX) {
    put(CardNo, Op::set_fly_x_pos, ScaleX);
}
void set_fly_x_pos(double ScaleX) {
    n_set_fly_x_pos(selected(), ScaleX);
}
void n_set_fly_y_pos(UINT CardNo, double ScaleY) {
    put(CardNo, Op::set_fly_y_pos, ScaleY);
}
void set_fly_y_pos(double ScaleY) {
    n_set_fly_y_pos(selected(), ScaleY);
}
void n_set_fly_rot_pos(UINT CardNo, double Resolution) {
    put(CardNo, Op::set_fly_rot_pos, Resolution);
}
void set_fly_rot_pos(double Resolution) {
    n_set_fly_rot_pos(selected(), Resolution);
}
void n_fly_return(UINT CardNo, long X, long Y) {
    put(CardNo, Op::fly_return, X, Y);
}
void fly_return(long X, long Y) {
    n_fly_return(selected(), X, Y);
}
void n_fly_return_z(UINT CardNo, long X, long Y, long Z) {
    put(CardNo, Op::fly_return_z, X, Y, Z);
}
void fly_return_z(long X, long Y, long Z) {
    n_fly_return_z(selected(), X, Y, Z);
}
void n_set_rot_center_list(UINT CardNo, long X, long Y) {
    put(CardNo, Op::set_rot_center_list, X, Y);
}
void set_rot_center_list(long X, long Y) {
    n_set_rot_center_list(selected(), X, Y);
}
void n_park_position(UINT CardNo, UINT Mode, long X, long Y) {
    put(CardNo, Op::park_position, Mode, X, Y);
}
void park_position(UINT Mode, long X, long Y) {
    n_park_position(selected(), Mode, X, Y);
}
void n_park_return(UINT CardNo, UINT Mode, long X, long Y) {
    put(CardNo, Op::park_return, Mode, X, Y);
}
void park_return(UINT Mode, long X, long Y) {
    n_park_return(selected(), Mode, X, Y);
}
void n_set_mcbsp_in_list(UINT CardNo, UINT Mode, double Scale) {
    put(CardNo, Op::set_mcbsp_in_list, Mode, Scale);
}
void set_mcbsp_in_list(UINT Mode, double Scale) {
    n_set_mcbsp_in_list(selected(), Mode, Scale);
}
void n_set_multi_mcbsp_in_list(UINT CardNo, UINT Ctrl, UINT P, UINT Mode) {
    put(CardNo, Op::set_multi_mcbsp_in_list, Ctrl, P, Mode);
}
void set_multi_mcbsp_in_list(UINT Ctrl, UINT P, UINT Mode) {
    n_set_multi_mcbsp_in_list(selected(), Ctrl, P, Mode);
}

// ---- Lists: waits, overflow, starts
// ------------------------------------------------------------------------------------

void n_store_encoder(UINT CardNo, UINT Pos) {
    put(CardNo, Op::store_encoder, Pos);
}
void store_encoder(UINT Pos) {
    n_store_encoder(selected(), Pos);
}
void n_wait_for_encoder(UINT CardNo, long Value, UINT EncoderNo) {
    put(CardNo, Op::wait_for_encoder, Value, EncoderNo);
}
void wait_for_encoder(long Value, UINT EncoderNo) {
    n_wait_for_encoder(selected(), Value, EncoderNo);
}
void n_wait_for_encoder_mode(UINT CardNo, long Value, UINT EncoderNo, long Mode) {
    put(CardNo, Op::wait_for_encoder_mode, Value, EncoderNo, Mode);
}
void wait_for_encoder_mode(long Value, UINT EncoderNo, long Mode) {
    n_wait_for_encoder_mode(selected(), Value, EncoderNo, Mode);
}
void n_wait_for_encoder_in_range(UINT CardNo, long EncXmin, long EncXmax, long EncYmin, long EncYmax) {
    put(CardNo, Op::wait_for_encoder_in_range, EncXmin, EncXmax, EncYmin, EncYmax);
}
void wait_for_encoder_in_range(long EncXmin, long EncXmax, long EncYmin, long EncYmax) {
    n_wait_for_encoder_in_range(selected(), EncXmin, EncXmax, EncYmin, EncYmax);
}
void n_wait_for_mcbsp(UINT CardNo, UINT Axis, long Value, long Mode) {
    put(CardNo, Op::wait_for_mcbsp, Axis, Value, Mode);
}
void wait_for_mcbsp(UINT Axis, long Value, long Mode) {
    n_wait_for_mcbsp(selected(), Axis, Value, Mode);
}
void n_set_fly_limits(UINT CardNo, long Xmin, long Xmax, long Ymin, long Ymax) {
    put(CardNo, Op::set_fly_limits, Xmin, Xmax, Ymin, Ymax);
}
void set_fly_limits(long Xmin, long Xmax, long Ymin, long Ymax) {
    n_set_fly_limits(selected(), Xmin, Xmax, Ymin, Ymax);
}
void n_set_fly_limits_z(UINT CardNo, long Zmin, long Zmax) {
    put(CardNo, Op::set_fly_limits_z, Zmin, Zmax);
}
void set_fly_limits_z(long Zmin, long Zmax) {
    n_set_fly_limits_z(selected(), Zmin, Zmax);
}
void n_if_fly_x_overflow(UINT CardNo, long Mode) {
    put(CardNo, Op::if_fly_x_overflow, Mode);
}
void if_fly_x_overflow(long Mode) {
    n_if_fly_x_overflow(selected(), Mode);
}
void n_if_fly_y_overflow(UINT CardNo, long Mode) {
    put(CardNo, Op::if_fly_y_overflow, Mode);
}
void if_fly_y_overflow(long Mode) {
    n_if_fly_y_overflow(selected(), Mode);
}
void n_if_fly_z_overflow(UINT CardNo, long Mode) {
    put(CardNo, Op::if_fly_z_overflow, Mode);
}
void if_fly_z_overflow(long Mode) {
    n_if_fly_z_overflow(selected(), Mode);
}
void n_if_not_fly_x_overflow(UINT CardNo, long Mode) {
    put(CardNo, Op::if_not_fly_x_overflow, Mode);
}
void if_not_fly_x_overflow(long Mode) {
    n_if_not_fly_x_overflow(selected(), Mode);
}
void n_if_not_fly_y_overflow(UINT CardNo, long Mode) {
    put(CardNo, Op::if_not_fly_y_overflow, Mode);
}
void if_not_fly_y_overflow(long Mode) {
    n_if_not_fly_y_overflow(selected(), Mode);
}
void n_if_not_fly_z_overflow(UINT CardNo, long Mode) {
    put(CardNo, Op::if_not_fly_z_overflow, Mode);
}
void if_not_fly_z_overflow(long Mode) {
    n_if_not_fly_z_overflow(selected(), Mode);
}
void n_clear_fly_overflow(UINT CardNo, UINT Mode) {
    put(CardNo, Op::clear_fly_overflow, Mode);
}
void clear_fly_overflow(UINT Mode) {
    n_clear_fly_overflow(selected(), Mode);
}
void n_set_ext_start_delay_list(UINT CardNo, long Delay, UINT EncoderNo) {
    put(CardNo, Op::set_ext_start_delay_list, Delay, EncoderNo);
}
void set_ext_start_delay_list(long Delay, UINT EncoderNo) {
    n_set_ext_start_delay_list(selected(), Delay, EncoderNo);
}
void n_simulate_ext_start(UINT CardNo, long Delay, UINT EncoderNo) {
    put(CardNo, Op::simulate_ext_start, Delay, EncoderNo);
}
void simulate_ext_start(long Delay, UINT EncoderNo) {
    n_simulate_ext_start(selected(), Delay, EncoderNo);
}
void n_set_control_mode_list(UINT CardNo, UINT Mode) {
    put(CardNo, Op::set_control_mode_list, Mode);
}
void set_control_mode_list(UINT Mode) {
    n_set_control_mode_list(selected(), Mode);
}
void n_set_encoder_speed(UINT CardNo, UINT EncoderNo, double Speed, double Smooth) {
    put(CardNo, Op::set_encoder_speed, EncoderNo, Speed, Smooth);
}
void set_encoder_speed(UINT EncoderNo, double Speed, double Smooth) {
    n_set_encoder_speed(selected(), EncoderNo, Speed, Smooth);
}

// ---- Lists: transforms
// -------------------------------------------------------------------------------------------------

void n_set_matrix_list(UINT CardNo, UINT HeadNo, UINT Ind1, UINT Ind2, double Mij, UINT at_once) {
    put(CardNo, Op::set_matrix_list, HeadNo, Ind1, Ind2, Mij, at_once);
}
void set_matrix_list(UINT HeadNo, UINT Ind1, UINT Ind2, double Mij, UINT at_once) {
    n_set_matrix_list(selected(), HeadNo, Ind1, Ind2, Mij, at_once);
}
void n_set_offset_list(UINT CardNo, UINT HeadNo, long XOffset, long YOffset, UINT at_once) {
    put(CardNo, Op::set_offset_list, HeadNo, XOffset, YOffset, at_once);
}
void set_offset_list(UINT HeadNo, long XOffset, long YOffset, UINT at_once) {
    n_set_offset_list(selected(), HeadNo, XOffset, YOffset, at_once);
}
void n_set_angle_list(UINT CardNo, UINT HeadNo, double Angle, UINT at_once) {
    put(CardNo, Op::set_angle_list, HeadNo, Angle, at_once);
}
void set_angle_list(UINT HeadNo, double Angle, UINT at_once) {
    n_set_angle_list(selected(), HeadNo, Angle, at_once);
}
void n_set_scale_list(UINT CardNo, UINT HeadNo, double Scale, UINT at_once) {
    put(CardNo, Op::set_scale_list, HeadNo, Scale, at_once);
}
void set_scale_list(UINT HeadNo, double Scale, UINT at_once) {
    n_set_scale_list(selected(), HeadNo, Scale, at_once);
}
