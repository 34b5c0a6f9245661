/* The commands of rtc5sim.h on the card CardNo instead of the selected one; that header includes this one. */
#ifndef RTC5SIM_CARDS_H
#define RTC5SIM_CARDS_H

#include <rtc5sim.h>

#ifdef __cplusplus
extern "C" {
#endif

RTC5_API UINT n_get_error(UINT CardNo);
RTC5_API UINT n_get_last_error(UINT CardNo);
RTC5_API void n_reset_error(UINT CardNo, UINT Code);
RTC5_API UINT n_load_program_file(UINT CardNo, const char* Path);
RTC5_API UINT n_load_correction_file(UINT CardNo, const char* Name, UINT No, UINT Dim);
RTC5_API void n_select_cor_table(UINT CardNo, UINT HeadA, UINT HeadB);
RTC5_API double n_get_table_para(UINT CardNo, UINT TableNo, UINT ParaNo);
RTC5_API double n_get_head_para(UINT CardNo, UINT HeadNo, UINT ParaNo);
RTC5_API long n_load_fly_2d_table(UINT CardNo, const char* Name, UINT No);
RTC5_API void n_config_list(UINT CardNo, UINT Mem1, UINT Mem2);
RTC5_API void n_set_start_list(UINT CardNo, UINT ListNo);
RTC5_API void n_set_start_list_1(UINT CardNo);
RTC5_API void n_set_start_list_2(UINT CardNo);
RTC5_API UINT n_get_input_pointer(UINT CardNo);
RTC5_API UINT n_get_list_space(UINT CardNo);
RTC5_API void n_execute_list(UINT CardNo, UINT ListNo);
RTC5_API void n_execute_list_1(UINT CardNo);
RTC5_API void n_execute_list_2(UINT CardNo);
RTC5_API void n_execute_at_pointer(UINT CardNo, UINT Pos);
RTC5_API void n_auto_change(UINT CardNo);
RTC5_API void n_start_loop(UINT CardNo);
RTC5_API void n_quit_loop(UINT CardNo);
RTC5_API void n_pause_list(UINT CardNo);
RTC5_API void n_restart_list(UINT CardNo);
RTC5_API void n_stop_execution(UINT CardNo);
RTC5_API void n_get_status(UINT CardNo, UINT* Status, UINT* Pos);
RTC5_API void n_goto_xy(UINT CardNo, long X, long Y);
RTC5_API void n_set_jump_speed_ctrl(UINT CardNo, double Speed);
RTC5_API void n_set_mark_speed_ctrl(UINT CardNo, double Speed);
RTC5_API void n_set_delay_mode(UINT CardNo, UINT VarPoly, UINT DirectMove3D, UINT EdgeLevel, UINT MinJumpDelay,
                               UINT JumpLengthLimit);
RTC5_API void n_set_matrix(UINT CardNo, UINT HeadNo, double M11, double M12, double M21, double M22, UINT at_once);
RTC5_API void n_set_offset(UINT CardNo, UINT HeadNo, long XOffset, long YOffset, UINT at_once);
RTC5_API void n_set_angle(UINT CardNo, UINT HeadNo, double Angle, UINT at_once);
RTC5_API void n_set_scale(UINT CardNo, UINT HeadNo, double Scale, UINT at_once);
RTC5_API void n_set_hi(UINT CardNo, UINT HeadNo, double GalvoGainX, double GalvoGainY, long GalvoOffsetX,
                       long GalvoOffsetY);
RTC5_API void n_set_control_mode(UINT CardNo, UINT Mode);
RTC5_API void n_write_io_port(UINT CardNo, UINT Value);
RTC5_API UINT n_get_io_status(UINT CardNo);
RTC5_API void n_simulate_encoder(UINT CardNo, UINT EncoderNo);
RTC5_API void n_get_encoder(UINT CardNo, long* Encoder0, long* Encoder1);
RTC5_API void n_read_encoder(UINT CardNo, long* Encoder0_1, long* Encoder1_1, long* Encoder0_2, long* Encoder1_2);
RTC5_API void n_set_rot_center(UINT CardNo, long X, long Y);
RTC5_API void n_set_fly_tracking_error(UINT CardNo, UINT TrackingErrorX, UINT TrackingErrorY);
RTC5_API void n_init_fly_2d(UINT CardNo, long OffsetX, long OffsetY);
RTC5_API void n_get_fly_2d_offset(UINT CardNo, long* OffsetX, long* OffsetY);
RTC5_API void n_set_encoder_speed_ctrl(UINT CardNo, UINT EncoderNo, double Speed, double Smooth);
RTC5_API void n_set_ext_start_delay(UINT CardNo, long Delay, UINT EncoderNo);
RTC5_API void n_set_extstart_pos(UINT CardNo, UINT Pos);
RTC5_API void n_simulate_ext_start_ctrl(UINT CardNo);
RTC5_API void n_simulate_ext_stop(UINT CardNo);
RTC5_API UINT n_get_marking_info(UINT CardNo);
RTC5_API UINT n_get_startstop_info(UINT CardNo);
RTC5_API long n_read_mcbsp(UINT CardNo, UINT No);
RTC5_API long n_read_multi_mcbsp(UINT CardNo, UINT No);
RTC5_API void n_set_mcbsp_in(UINT CardNo, UINT Mode, double Scale);
RTC5_API void n_set_multi_mcbsp_in(UINT CardNo, UINT Ctrl, UINT P, UINT Mode);
RTC5_API void n_set_mcbsp_x(UINT CardNo, double ScaleX);
RTC5_API void n_set_mcbsp_y(UINT CardNo, double ScaleY);
RTC5_API void n_set_mcbsp_rot(UINT CardNo, double Resolution);
RTC5_API void n_set_mcbsp_matrix(UINT CardNo);
RTC5_API void n_apply_mcbsp(UINT CardNo, UINT HeadNo, UINT at_once);
RTC5_API void n_set_laser_mode(UINT CardNo, UINT Mode);
RTC5_API void n_set_laser_control(UINT CardNo, UINT Ctrl);
RTC5_API void n_set_standby(UINT CardNo, UINT HalfPeriod, UINT PulseLength);
RTC5_API void n_set_laser_pulses_ctrl(UINT CardNo, UINT HalfPeriod, UINT PulseLength);
RTC5_API void n_set_firstpulse_killer(UINT CardNo, UINT Length);
RTC5_API void n_set_qswitch_delay(UINT CardNo, UINT Delay);
RTC5_API void n_set_laser_pulses(UINT CardNo, UINT HalfPeriod, UINT PulseLength);
RTC5_API void n_set_firstpulse_killer_list(UINT CardNo, UINT Length);
RTC5_API void n_set_qswitch_delay_list(UINT CardNo, UINT Delay);
RTC5_API void n_jump_abs(UINT CardNo, long X, long Y);
RTC5_API void n_jump_rel(UINT CardNo, long dX, long dY);
RTC5_API void n_mark_abs(UINT CardNo, long X, long Y);
RTC5_API void n_mark_rel(UINT CardNo, long dX, long dY);
RTC5_API void n_arc_abs(UINT CardNo, long X, long Y, double Angle);
RTC5_API void n_arc_rel(UINT CardNo, long dX, long dY, double Angle);
RTC5_API void n_timed_jump_abs(UINT CardNo, long X, long Y, double T);
RTC5_API void n_timed_jump_rel(UINT CardNo, long dX, long dY, double T);
RTC5_API void n_timed_mark_abs(UINT CardNo, long X, long Y, double T);
RTC5_API void n_timed_mark_rel(UINT CardNo, long dX, long dY, double T);
RTC5_API void n_micro_vector_abs(UINT CardNo, long X, long Y, long LasOn, long LasOff);
RTC5_API void n_micro_vector_rel(UINT CardNo, long dX, long dY, long LasOn, long LasOff);
RTC5_API void n_set_end_of_list(UINT CardNo);
RTC5_API void n_list_nop(UINT CardNo);
RTC5_API void n_long_delay(UINT CardNo, UINT Delay);
RTC5_API void n_set_jump_speed(UINT CardNo, double Speed);
RTC5_API void n_set_mark_speed(UINT CardNo, double Speed);
RTC5_API void n_set_scanner_delays(UINT CardNo, UINT Jump, UINT Mark, UINT Polygon);
RTC5_API void n_set_laser_delays(UINT CardNo, long LaserOnDelay, UINT LaserOffDelay);
RTC5_API void n_laser_on_list(UINT CardNo, UINT Period);
RTC5_API void n_laser_signal_on_list(UINT CardNo);
RTC5_API void n_laser_signal_off_list(UINT CardNo);
RTC5_API void n_write_io_port_list(UINT CardNo, UINT Value);
RTC5_API void n_set_fly_x(UINT CardNo, double ScaleX);
RTC5_API void n_set_fly_y(UINT CardNo, double ScaleY);
RTC5_API void n_set_fly_z(UINT CardNo, double ScaleZ, UINT EncoderNo);
RTC5_API void n_set_fly_rot(UINT CardNo, double Resolution);
RTC5_API void n_set_fly_2d(UINT CardNo, double ScaleX, double ScaleY);
RTC5_API void n_activate_fly_xy(UINT CardNo, double ScaleX, double ScaleY);
RTC5_API void n_activate_fly_2d(UINT CardNo, double ScaleX, double ScaleY);
RTC5_API void n_set_fly_x_pos(UINT CardNo, double ScaleX);
RTC5_API void n_set_fly_y_pos(UINT CardNo, double ScaleY);
RTC5_API void n_set_fly_rot_pos(UINT CardNo, double Resolution);
RTC5_API void n_fly_return(UINT CardNo, long X, long Y);
RTC5_API void n_fly_return_z(UINT CardNo, long X, long Y, long Z);
RTC5_API void n_set_rot_center_list(UINT CardNo, long X, long Y);
RTC5_API void n_park_position(UINT CardNo, UINT Mode, long X, long Y);
RTC5_API void n_park_return(UINT CardNo, UINT Mode, long X, long Y);
RTC5_API void n_set_mcbsp_in_list(UINT CardNo, UINT Mode, double Scale);
RTC5_API void n_set_multi_mcbsp_in_list(UINT CardNo, UINT Ctrl, UINT P, UINT Mode);
RTC5_API void n_store_encoder(UINT CardNo, UINT Pos);
RTC5_API void n_wait_for_encoder(UINT CardNo, long Value, UINT EncoderNo);
RTC5_API void n_wait_for_encoder_mode(UINT CardNo, long Value, UINT EncoderNo, long Mode);
RTC5_API void n_wait_for_encoder_in_range(UINT CardNo, long EncXmin, long EncXmax, long EncYmin, long EncYmax);
RTC5_API void n_wait_for_mcbsp(UINT CardNo, UINT Axis, long Value, long Mode);
RTC5_API void n_set_fly_limits(UINT CardNo, long Xmin, long Xmax, long Ymin, long Ymax);
RTC5_API void n_set_fly_limits_z(UINT CardNo, long Zmin, long Zmax);
RTC5_API void n_if_fly_x_overflow(UINT CardNo, long Mode);
RTC5_API void n_if_fly_y_overflow(UINT CardNo, long Mode);
RTC5_API void n_if_fly_z_overflow(UINT CardNo, long Mode);
RTC5_API void n_if_not_fly_x_overflow(UINT CardNo, long Mode);
RTC5_API void n_if_not_fly_y_overflow(UINT CardNo, long Mode);
RTC5_API void n_if_not_fly_z_overflow(UINT CardNo, long Mode);
RTC5_API void n_clear_fly_overflow(UINT CardNo, UINT Mode);
RTC5_API void n_set_ext_start_delay_list(UINT CardNo, long Delay, UINT EncoderNo);
RTC5_API void n_simulate_ext_start(UINT CardNo, long Delay, UINT EncoderNo);
RTC5_API void n_set_control_mode_list(UINT CardNo, UINT Mode);
RTC5_API void n_set_encoder_speed(UINT CardNo, UINT EncoderNo, double Speed, double Smooth);
RTC5_API void n_set_matrix_list(UINT CardNo, UINT HeadNo, UINT Ind1, UINT Ind2, double Mij, UINT at_once);
RTC5_API void n_set_offset_list(UINT CardNo, UINT HeadNo, long XOffset, long YOffset, UINT at_once);
RTC5_API void n_set_angle_list(UINT CardNo, UINT HeadNo, double Angle, UINT at_once);
RTC5_API void n_set_scale_list(UINT CardNo, UINT HeadNo, double Scale, UINT at_once);

#ifdef __cplusplus
}
#endif

#endif
