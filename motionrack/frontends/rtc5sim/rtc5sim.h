/* The RTC5's commands for C, under their documented names, on virtual cards: a marking job written against the board's
 * library runs on them unchanged. Passing parts, position words, starts and the laser's output are further calls
 * (rtc5sim_..).
 *
 * Link with librtc5sim.so (-lrtc5sim). A line on a belt of 100 mm/s, at 5,184 bits/mm:
 *
 *     simulate_encoder(1);
 *     set_start_list(1);
 *     set_mark_speed(2592);             // 500 mm/s
 *     set_fly_x(0.5184);                // 5,184 bits/mm * 100 mm/s / 1,000,000 counts/s
 *     mark_abs(51840, 0);
 *     fly_return(0, 0);
 *     set_end_of_list();
 *     execute_list(1);
 *     do get_status(&busy, &position); while (busy);
 *
 * Names, order and types of the arguments are those of the manual; on Windows long has 32 bits, here it may have more.
 * Commands not listed here are not implemented.
 *
 * Cards. The environment variable RTC5SIM_CARDS sets the number of cards, 1 .. 16; default 1. Each function exists
 * twice: for the selected card, initially card 1, and, in rtc5sim_cards.h, as n_.. with the card's number as first
 * argument.
 *
 * Time. The time is virtual and common to all cards. It advances in rtc5sim_advance_us(), in rtc5sim_run() and in
 * queries (get_status, read_status, get_encoder, read_encoder, get_mcbsp, read_mcbsp, read_multi_mcbsp,
 * get_marking_info, get_startstop_info, get_io_status, get_value, measurement_status, load_list): by 10 us each, or by
 * the value of rtc5sim_question_us(). Other functions take no time. A program that sleeps 1 ms between queries should
 * set 1,000 us.
 *
 * Errors. A call that is out of range, or not possible at present, is refused: it changes nothing, sets the sentence of
 * rtc5sim_last_error() (per thread) and the bits of get_last_error() and get_error(), and calls the handler of
 * rtc5sim_on_error().
 *
 * Threads. Functions may be called from any thread; concurrent calls are serialised. Cards and the selection belong to
 * the process.
 */
#ifndef RTC5SIM_H
#define RTC5SIM_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define RTC5_API __attribute__((visibility("default")))
#else
#define RTC5_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef unsigned int UINT;

/* An address as a number, an argument of some commands: (ULONG_PTR)values. It points to numbers of 32 bits on every
 * system. */
typedef uintptr_t ULONG_PTR;

/* Bits of get_last_error and get_error, as in the manual: init_rtc5_dll found no card; unknown card number; invalid
 * parameter; a list is running, or the card moves; the list is full or not open, or no data are available. */
enum rtc5_error { RTC5_NO_CARD = 1, RTC5_ACCESS_DENIED = 2, RTC5_PARAM_ERROR = 16, RTC5_BUSY = 32, RTC5_REJECTED = 64 };

/* ---- Cards ---- */

/* A program may begin with init_rtc5_dll, which returns 0. Card numbers are 1 .. rtc5_count_cards(); select_rtc returns
 * the number, or 0 for an unknown card. These four functions apply to the process and have no n_.. */
RTC5_API UINT init_rtc5_dll(void);
RTC5_API UINT rtc5_count_cards(void);
RTC5_API UINT select_rtc(UINT CardNo);
RTC5_API void free_rtc5_dll(void);

/* ---- Errors ---- */

/* Error bits: enum rtc5_error. get_last_error returns those of the previous command, get_error those since reset_error.
 * Bits of the board that virtual cards never set: 4 not sent, 8 no answer, 128 ignored, 256 wrong version. A list
 * command with an invalid parameter is not stored in the list (the board stores a list_nop). */
RTC5_API UINT get_error(void);
RTC5_API UINT get_last_error(void);
RTC5_API void reset_error(UINT Code);

/* ---- Files and tables ---- */

/* load_program_file resets the card to its power-up state; it ignores the name. load_correction_file loads a .ct5 file
 * as table No 1 .. 4, a null pointer a 1:1 table; Dim is 2 or 3 (3D parts of a file are not used). It returns 0; 1 the
 * file is damaged (its checksum does not match, K is 0 although one is known, the table cannot be inverted); 3 the file
 * cannot be read; 10 an invalid parameter; 11 an unknown card. After an error the table is unchanged. The numbers were
 * not checked against the manual. The checksum of programs before version 4.0 is not known: their files are loaded, and
 * rtc5sim_table_note reports that the checksum was not checked. ParaNo 0 .. 15 are the words of the table's header; 1
 * is K in bits/mm. load_fly_2d_table returns 0, 1 or 3; a null pointer removes the table. */
RTC5_API UINT load_program_file(const char* Path);
RTC5_API UINT load_correction_file(const char* Name, UINT No, UINT Dim);
RTC5_API void select_cor_table(UINT HeadA, UINT HeadB);
RTC5_API double get_table_para(UINT TableNo, UINT ParaNo);
RTC5_API double get_head_para(UINT HeadNo, UINT ParaNo);
RTC5_API long load_fly_2d_table(const char* Name, UINT No);

/* ---- Running lists ---- */

/* List commands are stored in the list of set_start_list: list 1 (odd numbers) or 2 (even numbers), also while it runs.
 * load_list opens a list only if it does not run (1, 2; 0: the free list, 3: the free list that ran to its end) and
 * returns its number, or 0: then no list is open. Pos of these functions and of execute_list_pos counts from the start
 * of the list; a Pos behind its end is taken as 0. Elsewhere Pos counts from 0 in the whole list memory. Mem2 of
 * config_list may be -1: the remaining memory. get_status: bit 0 a list is running, 7 the card moves by itself, 15
 * paused; Pos is the present position in the list. read_status: bits 0, 1 list 1, 2 is being loaded; 2, 3 its end was
 * stored; 4, 5 it is running; 6, 7 it ran to its end. load_sub: the commands up to list_return become subroutine Index,
 * 0 .. 1023, in list 3; without a command before list_return the subroutine is removed. */
RTC5_API void config_list(UINT Mem1, UINT Mem2);
RTC5_API void set_start_list(UINT ListNo);
RTC5_API void set_start_list_1(void);
RTC5_API void set_start_list_2(void);
RTC5_API void set_start_list_pos(UINT ListNo, UINT Pos);
RTC5_API UINT load_list(UINT ListNo, UINT Pos);
RTC5_API void load_sub(UINT Index);
RTC5_API UINT get_input_pointer(void);
RTC5_API UINT get_list_space(void);
RTC5_API void execute_list(UINT ListNo);
RTC5_API void execute_list_1(void);
RTC5_API void execute_list_2(void);
RTC5_API void execute_list_pos(UINT ListNo, UINT Pos);
RTC5_API void execute_at_pointer(UINT Pos);
RTC5_API void auto_change(void);
RTC5_API void start_loop(void);
RTC5_API void quit_loop(void);
RTC5_API void pause_list(void);
RTC5_API void restart_list(void);
RTC5_API void stop_execution(void);
RTC5_API void get_status(UINT* Status, UINT* Pos);
RTC5_API UINT read_status(void);
RTC5_API void goto_xy(long X, long Y);

/* ---- Settings ---- */

/* HeadNo 1 A, 2 B, 3 both, 4 both before the correction. at_once 0, 1, 3: within the next 10 us; 2: with the next jump.
 * Ranges are those of the list commands. EdgeLevel and MinJumpDelay are in 10 us, JumpLengthLimit is in bits. */
RTC5_API void set_jump_speed_ctrl(double Speed);
RTC5_API void set_mark_speed_ctrl(double Speed);
RTC5_API void set_delay_mode(UINT VarPoly, UINT DirectMove3D, UINT EdgeLevel, UINT MinJumpDelay, UINT JumpLengthLimit);
RTC5_API void set_matrix(UINT HeadNo, double M11, double M12, double M21, double M22, UINT at_once);
RTC5_API void set_offset(UINT HeadNo, long XOffset, long YOffset, UINT at_once);
RTC5_API void set_angle(UINT HeadNo, double Angle, UINT at_once);
RTC5_API void set_scale(UINT HeadNo, double Scale, UINT at_once);
RTC5_API void set_hi(UINT HeadNo, double GalvoGainX, double GalvoGainY, long GalvoOffsetX, long GalvoOffsetY);
RTC5_API void set_control_mode(UINT Mode);
RTC5_API void write_io_port(UINT Value);
RTC5_API UINT get_io_status(void);

/* ---- Encoders and starts ---- */

/* simulate_encoder: 0 off, 1 X, 2 Y, 3 both, at 1,000,000 counts/s. Tracking errors are in 10 us, 0 .. 65,535; Speed is
 * in counts/ms, Smooth 0 .. 1. External starts require bit 0 of set_control_mode; Delay is the track delay in counts,
 * Pos the position at which the list starts. get_startstop_info: bit 0 a list was started, 1 externally; 2 a list was
 * stopped, 3 externally; 4 no stop signal, 9 the laser is enabled, 11 a start was lost. */
RTC5_API void simulate_encoder(UINT EncoderNo);
RTC5_API void get_encoder(long* Encoder0, long* Encoder1);
RTC5_API void read_encoder(long* Encoder0_1, long* Encoder1_1, long* Encoder0_2, long* Encoder1_2);
RTC5_API void set_rot_center(long X, long Y);
RTC5_API void set_fly_tracking_error(UINT TrackingErrorX, UINT TrackingErrorY);
RTC5_API void init_fly_2d(long OffsetX, long OffsetY);
RTC5_API void get_fly_2d_offset(long* OffsetX, long* OffsetY);
RTC5_API void set_encoder_speed_ctrl(UINT EncoderNo, double Speed, double Smooth);
RTC5_API void set_ext_start_delay(long Delay, UINT EncoderNo);
RTC5_API void set_extstartpos(UINT Pos);
RTC5_API void simulate_ext_start_ctrl(void);
RTC5_API void simulate_ext_stop(void);
RTC5_API UINT get_marking_info(void);
RTC5_API UINT get_startstop_info(void);

/* ---- McBSP ---- */

/* Words of 32 bits arrive by rtc5sim_receive. get_mcbsp returns the present word and stores it in location 0;
 * read_mcbsp returns memory location 0 .. 3, read_multi_mcbsp type 0 .. 7. set_mcbsp_in: Mode 1 X, 2 Y, 3 both.
 * set_mcbsp_x, _y, _rot and _matrix configure online positioning, which apply_mcbsp applies to a head.
 *
 * Locations. Location 0 is updated from the first set_fly_x_pos, set_fly_y_pos, set_fly_rot_pos or set_mcbsp_in on,
 * also after fly_return, a scale of 0 and load_program_file. set_mcbsp_in also fills other locations: Mode 1 location 1
 * with the word, Mode 2 location 2, Mode 3 location 1 with X, 2 with Y and 3 with the word. set_multi_mcbsp_in stores
 * consecutive words in 0, 1, 2, 3 in turn, online positioning in 1 or 2. read_mcbsp of an empty location, and get_mcbsp
 * before the first word, return 0 and set the bit RTC5_REJECTED and a sentence with the missing call.
 *
 * Finding the scale. Run a list with set_fly_x_pos(0), which fills location 0 without a correction. With the part at
 * standstill: start = read_mcbsp(0); move the part and stop it; end = read_mcbsp(0); measure the distance in mm. i =
 * (end - start) / distance in bits/mm, and the scale is K / i. If the sender has one axis, the word is its position. If
 * it has two, X is the low half and Y the high half, both signed:
 *
 *     x = (int16_t)(word & 0xffff);
 *     y = (int16_t)(word >> 16);
 *
 * Compute i for each axis, with the distance along X and along Y; set_mcbsp_in(3, 0) stores both in locations 1 and 2.
 * A difference of halves beyond +-32,767 has wrapped: move less.
 *
 * set_mcbsp_out sends two signals (see "Signals and recording") in turn, one word per 10 us; set_mcbsp_out_ptr up to 8,
 * whose numbers are at SignalPtr; Number 0 ends it. rtc5sim_sent returns the words. The serial frame is not simulated:
 * mcbsp_init accepts delays of 0 .. 2 bits, mcbsp_init_spi 0 or 1, set_mcbsp_freq 1 .. 50,000,000 Hz, which it returns;
 * they have no effect. */
RTC5_API void mcbsp_init(UINT XDelay, UINT RDelay);
RTC5_API void mcbsp_init_spi(UINT ClockLevel, UINT ClockDelay);
RTC5_API UINT set_mcbsp_freq(UINT Freq);
RTC5_API long get_mcbsp(void);
RTC5_API long read_mcbsp(UINT No);
RTC5_API long read_multi_mcbsp(UINT No);
RTC5_API void set_mcbsp_in(UINT Mode, double Scale);
RTC5_API void set_multi_mcbsp_in(UINT Ctrl, UINT P, UINT Mode);
RTC5_API void set_mcbsp_x(double ScaleX);
RTC5_API void set_mcbsp_y(double ScaleY);
RTC5_API void set_mcbsp_rot(double Resolution);
RTC5_API void set_mcbsp_matrix(void);
RTC5_API void apply_mcbsp(UINT HeadNo, UINT at_once);
RTC5_API void set_mcbsp_out(UINT Signal1, UINT Signal2);
RTC5_API void set_mcbsp_out_ptr(UINT Number, ULONG_PTR SignalPtr);

/* ---- Signals and recording ---- */

/* set_trigger and set_trigger4 (lists) record. measurement_status: Busy is not 0 during a recording; Pos + 1 is the
 * number of samples. get_waveform copies the first Number samples of Channel 1 .. 4 to Ptr, an array of int32_t.
 * stop_trigger ends a recording and keeps its samples. get_value returns a signal of the last 10 us. Signals:
 *
 *     0               1 while the laser is on
 *     1, 2; 4, 5      X, Y reported by head A, head B: the output, without the mirrors' lag
 *     7, 8, 9         X, Y, Z after the correction
 *     10, 11; 13, 14  X, Y of head A, head B after the table
 *     12, 15          Z at the output
 *     16, 17; 18, 19  as 1, 2; 4, 5 while the laser is on, else -524288
 *     20, 21; 22, 23  X, Y output of head A, head B
 *     25, 26; 28, 29  X, Y of head A, head B after matrix and offset, before the table
 *     35              the 16 digital outputs
 *     43, 44          counts of encoder 0, 1
 *     45              the mark speed, bits/ms */
RTC5_API long get_value(UINT Signal);
RTC5_API void measurement_status(UINT* Busy, UINT* Pos);
RTC5_API void get_waveform(UINT Channel, UINT Number, ULONG_PTR Ptr);
RTC5_API void stop_trigger(void);

/* ---- Laser signals ---- */

/* The laser is simulated as a gate, on or off. disable_laser switches it off and keeps it off until enable_laser; it is
 * enabled initially. Its mode and pulses are accepted without effect and are not stored in lists. */
RTC5_API void enable_laser(void);
RTC5_API void disable_laser(void);
RTC5_API void set_laser_mode(UINT Mode);
RTC5_API void set_laser_control(UINT Ctrl);
RTC5_API void set_standby(UINT HalfPeriod, UINT PulseLength);
RTC5_API void set_laser_pulses_ctrl(UINT HalfPeriod, UINT PulseLength);
RTC5_API void set_firstpulse_killer(UINT Length);
RTC5_API void set_qswitch_delay(UINT Delay);
RTC5_API void set_laser_pulses(UINT HalfPeriod, UINT PulseLength);
RTC5_API void set_laser_timing(UINT HalfPeriod, UINT PulseLength1, UINT PulseLength2, UINT TimeBase);
RTC5_API void set_firstpulse_killer_list(UINT Length);
RTC5_API void set_qswitch_delay_list(UINT Delay);

/* ---- Lists: the path ---- */

/* Straight lines and arcs from the present position; marks with the laser on. X, Y are in bits, clipped to 24 bits; dX,
 * dY are relative to the present position; T is in us. Angle is in degrees about the centre X, Y, positive clockwise. A
 * micro vector takes 10 us; LasOn and LasOff, in 0.5 us, switch the laser within it if they are 0 .. 19. */
RTC5_API void jump_abs(long X, long Y);
RTC5_API void jump_rel(long dX, long dY);
RTC5_API void mark_abs(long X, long Y);
RTC5_API void mark_rel(long dX, long dY);
RTC5_API void arc_abs(long X, long Y, double Angle);
RTC5_API void arc_rel(long dX, long dY, double Angle);
RTC5_API void timed_jump_abs(long X, long Y, double T);
RTC5_API void timed_jump_rel(long dX, long dY, double T);
RTC5_API void timed_mark_abs(long X, long Y, double T);
RTC5_API void timed_mark_rel(long dX, long dY, double T);
RTC5_API void micro_vector_abs(long X, long Y, long LasOn, long LasOff);
RTC5_API void micro_vector_rel(long dX, long dY, long LasOn, long LasOff);

/* ---- Lists: speeds, delays, laser, outputs ---- */

/* Speeds are in bits/ms, clipped to 1.6 .. 800,000; scanner delays and the times of long_delay and laser_on_list in
 * 10 us; laser delays in 0.5 us. They apply from the next command on. */
RTC5_API void set_end_of_list(void);
RTC5_API void list_nop(void);
RTC5_API void long_delay(UINT Delay);
RTC5_API void set_jump_speed(double Speed);
RTC5_API void set_mark_speed(double Speed);
RTC5_API void set_scanner_delays(UINT Jump, UINT Mark, UINT Polygon);
RTC5_API void set_laser_delays(long LaserOnDelay, UINT LaserOffDelay);
RTC5_API void laser_on_list(UINT Period);
RTC5_API void laser_signal_on_list(void);
RTC5_API void laser_signal_off_list(void);
RTC5_API void write_io_port_list(UINT Value);

/* ---- Lists: wobbel and subroutines ---- */

/* set_wobbel superimposes an ellipse on marks: amplitudes in bits across and along the motion, clipped to 131,071, Freq
 * in Hz, clipped to -6,000 .. 6,000; 0 is off. list_call continues at the position Pos, sub_call in a subroutine of
 * load_sub, up to list_return; at most 63 nested calls. An impossible call and a return without a call are a
 * list_nop. */
RTC5_API void set_wobbel(UINT Transversal, UINT Longitudinal, double Freq);
RTC5_API void list_call(UINT Pos);
RTC5_API void sub_call(UINT Index);
RTC5_API void list_return(void);

/* ---- Lists: processing on the fly ---- */

/* The card corrects the position every 10 us for the motion of the part. Scale is in bits per count (encoders) or bits
 * per bit (McBSP words); 0 is off. Resolution is in counts (or bits) per revolution, positive counter-clockwise; below
 * 100 it is off. set_fly_.. set their encoders to 0, activate_fly_.. do not. fly_return ends all corrections and jumps
 * to X, Y: end a job with it. */
RTC5_API void set_fly_x(double ScaleX);
RTC5_API void set_fly_y(double ScaleY);
RTC5_API void set_fly_z(double ScaleZ, UINT EncoderNo);
RTC5_API void set_fly_rot(double Resolution);
RTC5_API void set_fly_2d(double ScaleX, double ScaleY);
RTC5_API void activate_fly_xy(double ScaleX, double ScaleY);
RTC5_API void activate_fly_2d(double ScaleX, double ScaleY);
RTC5_API void set_fly_x_pos(double ScaleX);
RTC5_API void set_fly_y_pos(double ScaleY);
RTC5_API void set_fly_rot_pos(double Resolution);
RTC5_API void fly_return(long X, long Y);
RTC5_API void fly_return_z(long X, long Y, long Z);
RTC5_API void set_rot_center_list(long X, long Y);
RTC5_API void park_position(UINT Mode, long X, long Y);
RTC5_API void park_return(UINT Mode, long X, long Y);
RTC5_API void set_mcbsp_in_list(UINT Mode, double Scale);
RTC5_API void set_multi_mcbsp_in_list(UINT Ctrl, UINT P, UINT Mode);

/* ---- Lists: waits, overflow, starts ---- */

/* A wait holds the position while the correction continues. Mode > 0: until the count is at least Value; < 0: until it
 * is at most Value; 0: until it passes Value upwards (Value > 0) or downwards. EncoderNo is 0, 1; Axis 0 is X, 1 is Y.
 * The command after if_.. is skipped if the condition is false: Mode 0 tests both limits of set_fly_limits, > 0 the
 * upper one, < 0 the lower one. */
RTC5_API void store_encoder(UINT Pos);
RTC5_API void wait_for_encoder(long Value, UINT EncoderNo);
RTC5_API void wait_for_encoder_mode(long Value, UINT EncoderNo, long Mode);
RTC5_API void wait_for_encoder_in_range(long EncXmin, long EncXmax, long EncYmin, long EncYmax);
RTC5_API void wait_for_mcbsp(UINT Axis, long Value, long Mode);
RTC5_API void set_fly_limits(long Xmin, long Xmax, long Ymin, long Ymax);
RTC5_API void set_fly_limits_z(long Zmin, long Zmax);
RTC5_API void if_fly_x_overflow(long Mode);
RTC5_API void if_fly_y_overflow(long Mode);
RTC5_API void if_fly_z_overflow(long Mode);
RTC5_API void if_not_fly_x_overflow(long Mode);
RTC5_API void if_not_fly_y_overflow(long Mode);
RTC5_API void if_not_fly_z_overflow(long Mode);
RTC5_API void clear_fly_overflow(UINT Mode);
RTC5_API void set_ext_start_delay_list(long Delay, UINT EncoderNo);
RTC5_API void simulate_ext_start(long Delay, UINT EncoderNo);
RTC5_API void set_control_mode_list(UINT Mode);
RTC5_API void set_encoder_speed(UINT EncoderNo, double Speed, double Smooth);

/* ---- Lists: McBSP and recording ---- */

/* As the commands without _list. Period is in 10 us; 0 ends the recording. The first sample is taken immediately, then
 * one per period while a list runs: at most 1,048,576 (set_trigger) or 524,288 (set_trigger4). */
RTC5_API void get_mcbsp_list(void);
RTC5_API void set_mcbsp_x_list(double ScaleX);
RTC5_API void set_mcbsp_y_list(double ScaleY);
RTC5_API void set_mcbsp_rot_list(double Resolution);
RTC5_API void set_mcbsp_matrix_list(void);
RTC5_API void apply_mcbsp_list(UINT HeadNo, UINT at_once);
RTC5_API void set_trigger(UINT Period, UINT Signal1, UINT Signal2);
RTC5_API void set_trigger4(UINT Period, UINT Signal1, UINT Signal2, UINT Signal3, UINT Signal4);

/* ---- Lists: transforms ---- */

/* As set_matrix, set_offset, set_angle and set_scale; Ind1, Ind2 are row and column of the coefficient, 0 or 1. */
RTC5_API void set_matrix_list(UINT HeadNo, UINT Ind1, UINT Ind2, double Mij, UINT at_once);
RTC5_API void set_offset_list(UINT HeadNo, long XOffset, long YOffset, UINT at_once);
RTC5_API void set_angle_list(UINT HeadNo, double Angle, UINT at_once);
RTC5_API void set_scale_list(UINT HeadNo, double Scale, UINT at_once);

#ifdef __cplusplus
}
#endif

#include <rtc5sim_cards.h>
#include <rtc5sim_virtual.h>

#endif
