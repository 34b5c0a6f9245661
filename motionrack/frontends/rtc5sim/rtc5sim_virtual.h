/* ---- The virtual cards ---- */

/* Functions that a board does not have: errors as sentences, rack files, time, the inputs of a card and its laser.
 * rtc5sim.h includes this header, rtc5sim_virtual.h. */
#ifndef RTC5SIM_VIRTUAL_H
#define RTC5SIM_VIRTUAL_H

#include <rtc5sim.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The sentence of the last error of this thread, "" if there was none; the text holds until the next error. */
RTC5_API const char* rtc5sim_last_error(void);
RTC5_API void rtc5sim_clear_error(void);

/* Called after each error, from its thread, with the sentence; a null pointer ends the calls. */
typedef void (*rtc5sim_error_handler)(const char* sentence, void* user);
RTC5_API void rtc5sim_on_error(rtc5sim_error_handler handler, void* user);

/* The cards become those of type rtc5 of a rack file (its path, or the text itself), card 1 is the first in the file:
 * on the rack's wires, in its time, with its belts, sensors and scan heads. A file with mistakes is refused, with all
 * of them in the sentence, and the cards stay as they are. rtc5sim_close ends them, as free_rtc5_dll does; the next use
 * makes others as RTC5SIM_CARDS says. 0, or -1. */
RTC5_API int rtc5sim_open(const char* rack);
RTC5_API int rtc5sim_close(void);

/* Reads or sets the true value of a part of that rack: "line.position_mm", "head.marked_mm", "line.speed_mm_s". The
 * names are those of mr_part_get. 0, or -1. */
RTC5_API int rtc5sim_part_get(const char* part_dot_quantity, double* value);
RTC5_API int rtc5sim_part_set(const char* part_dot_quantity, double value);

/* Sets the duration of a query from now on: 0 .. 1,000,000,000 us, a multiple of 10. */
RTC5_API int rtc5sim_question_us(int64_t us);

/* Advances all cards by us, a multiple of 10 us; 0, or -1. */
RTC5_API int rtc5sim_advance_us(int64_t us);

/* Advances all cards until no list runs, nothing moves and no start is pending, at most by max_us. Returns 1 at
 * standstill, 0 if the time ended before, -1 after an error. */
RTC5_API int rtc5sim_run(int64_t max_us);

/* Virtual time since the first call; -1 if it failed. */
RTC5_API int64_t rtc5sim_now_us(void);

/* Inputs of a card: an encoder (Encoder 0, 1) that counts at this speed, up to 1e9 counts/s; an encoder count to set
 * (both not for a card of a rack); a McBSP word; a start signal; a stop signal. They act within the next 10 us. 0, or
 * -1. */
RTC5_API int rtc5sim_encoder_speed(UINT CardNo, UINT Encoder, double counts_per_s);
RTC5_API int rtc5sim_encoder_count(UINT CardNo, UINT Encoder, int32_t count);
RTC5_API int rtc5sim_receive(UINT CardNo, uint32_t word);
RTC5_API int rtc5sim_start(UINT CardNo);
RTC5_API int rtc5sim_stop(UINT CardNo);

/* Where head A of a card is (bits) and whether its laser is on; null pointers are left out. Takes no time. 0, or -1. */
RTC5_API int rtc5sim_output(UINT CardNo, int32_t* x, int32_t* y, int* laser);

/* The McBSP word that a card sent in the last 10 us, 0 while it sends nothing. Takes no time. 0, or -1. */
RTC5_API int rtc5sim_sent(UINT CardNo, int32_t* word);

/* Called while cards run, with what head A does in consecutive ticks of 10 us: x and y in bits, and for how many half-
 * microseconds of it, 0 .. 20, the laser is on. The arrays hold until it returns; it must not call functions of this
 * library. A null pointer ends the calls, and runs are faster. */
typedef void (*rtc5sim_samples_handler)(void* user, UINT CardNo, int64_t first_tick, const int32_t* x, const int32_t* y,
                                        const uint8_t* laser, size_t n);
RTC5_API void rtc5sim_on_samples(rtc5sim_samples_handler handler, void* user);

/* Returns a note on the file of table TableNo 1 .. 4: its checksum was not checked, because its program (before
 * version 4.0) has an unknown one; "" without a note. The text holds until the next call of the thread. */
RTC5_API const char* rtc5sim_table_note(UINT CardNo, UINT TableNo);

/* Returns the meaning of the bits of get_marking_info, a line each; holds until the next call of the thread. */
RTC5_API const char* rtc5sim_marking_info_text(UINT bits);

#ifdef __cplusplus
}
#endif

#endif
