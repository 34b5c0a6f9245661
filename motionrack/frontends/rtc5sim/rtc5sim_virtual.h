/* ---- The virtual cards ---- */

/* Further functions, not of the board: errors as sentences, rack files, time, the inputs of a card and its laser.
 * rtc5sim.h includes this header, rtc5sim_virtual.h. */
#ifndef RTC5SIM_VIRTUAL_H
#define RTC5SIM_VIRTUAL_H

#include <rtc5sim.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the sentence of the last error of this thread, or ""; valid until the next error. */
RTC5_API const char* rtc5sim_last_error(void);
RTC5_API void rtc5sim_clear_error(void);

/* Sets the function that is called after each error, in its thread, with the sentence; NULL ends the calls. */
typedef void (*rtc5sim_error_handler)(const char* sentence, void* user);
RTC5_API void rtc5sim_on_error(rtc5sim_error_handler handler, void* user);

/* Replaces the cards by the cards of type rtc5 of a rack file (its path or its text), in the order of the file from
 * card 1 on: on the rack's wires, in its time, with its belts, sensors and scan heads. A file with mistakes is refused,
 * with all of them in the sentence, and the cards are unchanged; so is the address of a real card, which has no live
 * port. rtc5sim_close closes them, as free_rtc5_dll does; the next call creates cards by RTC5SIM_CARDS. Return 0, or
 * -1. */
RTC5_API int rtc5sim_open(const char* rack);
RTC5_API int rtc5sim_close(void);

/* Read or set a true value of a part of that rack: "line.position_mm", "head.marked_mm", "line.speed_mm_s". The names
 * are those of mr_part_get. Return 0, or -1. */
RTC5_API int rtc5sim_part_get(const char* part_dot_quantity, double* value);
RTC5_API int rtc5sim_part_set(const char* part_dot_quantity, double value);

/* Sets the duration of a query from now on: 0 .. 1,000,000,000 us, a multiple of 10. */
RTC5_API int rtc5sim_question_us(int64_t us);

/* Advances all cards by us, a multiple of 10 us; those of a rack by 1,000,000,000,000 us at most. Returns 0, or -1. */
RTC5_API int rtc5sim_advance_us(int64_t us);

/* Advances all cards until no list runs, nothing moves and no start is pending, at most by max_us. Returns 1 at
 * standstill, 0 if the time ended before, -1 after an error. */
RTC5_API int rtc5sim_run(int64_t max_us);

/* Returns the virtual time since the first call, us; -1 after an error. */
RTC5_API int64_t rtc5sim_now_us(void);

/* Set inputs of a card: the speed of an encoder (Encoder 0, 1), up to 1e9 counts/s; an encoder count (neither for a
 * card of a rack); a McBSP word; a start signal; a stop signal. They take effect within the next 10 us. Return 0, or
 * -1. */
RTC5_API int rtc5sim_encoder_speed(UINT CardNo, UINT Encoder, double counts_per_s);
RTC5_API int rtc5sim_encoder_count(UINT CardNo, UINT Encoder, int32_t count);
RTC5_API int rtc5sim_receive(UINT CardNo, uint32_t word);
RTC5_API int rtc5sim_start(UINT CardNo);
RTC5_API int rtc5sim_stop(UINT CardNo);

/* Reads the position of head A of a card (bits) and whether its laser is on; null pointers are skipped. Takes no time.
 * Returns 0, or -1. */
RTC5_API int rtc5sim_output(UINT CardNo, int32_t* x, int32_t* y, int* laser);

/* Reads the McBSP word that a card sent in the last 10 us; 0 if it sends nothing. Takes no time. Returns 0, or -1. */
RTC5_API int rtc5sim_sent(UINT CardNo, int32_t* word);

/* Sets the function that is called while cards run, with the output of head A in consecutive ticks of 10 us: x and y in
 * bits, and the laser's on time in each tick in units of 0.5 us, 0 .. 20. The arrays are valid until it returns; it
 * must not call functions of this library. NULL ends the calls, which makes runs faster. */
typedef void (*rtc5sim_samples_handler)(void* user, UINT CardNo, int64_t first_tick, const int32_t* x, const int32_t* y,
                                        const uint8_t* laser, size_t n);
RTC5_API void rtc5sim_on_samples(rtc5sim_samples_handler handler, void* user);

/* Returns a note on the file of table TableNo 1 .. 4, or "": its checksum was not checked, because the checksum of its
 * program (before version 4.0) is not known. The text is valid until the next call of the thread. */
RTC5_API const char* rtc5sim_table_note(UINT CardNo, UINT TableNo);

/* Returns the meaning of the bits of get_marking_info, one line per bit; valid until the next call of the thread. */
RTC5_API const char* rtc5sim_marking_info_text(UINT bits);

#ifdef __cplusplus
}
#endif

#endif
