/* The DataBoard 4002 for C: each command of the card, its status and events, complete moves and slopes, on a virtual
 * card or on a real one.
 *
 * Link with libdataboard4002lib.so (-ldataboard4002lib). A program that moves the axis to 1000 counts and prints where
 * it is:
 *
 *     int counts, card = databoard4002_open("card.c1 = \"databoard4002\"", 13);
 *     databoard4002_set_rate(card, 15984);         // 400 kHz / (16384 - 15984) = 1000 pulses/s
 *     databoard4002_move_to(card, 1000, 10000);    // until it is there, at most 10 s
 *     if (databoard4002_position(card, &counts) == 0) printf("%d\n", counts);
 *
 * The same program drives a real card: databoard4002_open("port:/dev/port,offset=0x300,gap_ns=1000", 13). With NULL in
 * place of the text, the environment variable MOTIONRACK_RACK names the rack file or the real card.
 *
 * Cards. `card` is the handle that databoard4002_open() has returned.
 *
 * Units. Positions are counts of the encoder, times milliseconds. A rate r is the frequency 400 kHz / (16384 - r) at
 * the output FOUT; the voltage of the analog output is that of the card's trim table. What each command does is in the
 * rules of the card, motionrack/cards/databoard4002/RULES.md.
 *
 * Errors. On an error a function returns -1, sets the sentence of databoard4002_last_error() (per thread), and stores
 * no answer. A value out of its range is refused before anything is written. Errors are also: no card answers (STAT
 * reads FFh); the card is not Ready within 20 ms; the computer refuses an access to a real card, after which its bus is
 * not accessed any more. Without an error a function returns 0, if nothing else is said.
 *
 * Time. A real card has the computer's time. The time of a virtual card advances in waiting functions, in
 * databoard4002_advance_ms(), and by the bus time of each access, so that a loop that polls databoard4002_status()
 * ends.
 *
 * Threads. Functions may be called from any thread. Calls of one card are made one after another; a call that waits
 * lets those of other cards pass. databoard4002_stop() ends the call of its card that waits.
 */
#ifndef DATABOARD4002LIB_H
#define DATABOARD4002LIB_H

#include <stdint.h>

#if defined(__GNUC__) && !defined(_WIN32)
#define DATABOARD4002_API __attribute__((visibility("default")))
#else
#define DATABOARD4002_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Cards ---- */

/* Opens the card with this number on its bus: 0 .. 255, in a rack the card's key card_number (13 by default). A virtual
 * card: `place` is the path of a rack file or its text ("card.c1 = \"databoard4002\""), an independent rack with its
 * own clock. A real card: uio:PATH, memory:PATH or port:PATH, followed by ,offset=N ,stride=N ,map=N ,interrupt=PATH
 * ,gap_ns=N as needed. NULL: another card of the bus that was opened last; where none is open, the place that the
 * environment variable MOTIONRACK_RACK names. Waits until the card is Ready, at most 1 s, switches its events off and
 * clears its reset mark (C4, W, V); nothing is started, and a move continues. Refused if the card is open already, if a
 * program of motionrack has the real bus open, or if no card answers. Returns the card's handle, 1 or greater, or -1.
 */
DATABOARD4002_API int databoard4002_open(const char* place, int number);

/* Closes a card; the last card of a bus also closes the bus. A move continues to its target: stop it first. The same
 * holds for the end of the program. */
DATABOARD4002_API int databoard4002_close(int card);

/* ---- Stops ---- */

/* Stops the card (Q), from any thread, also while another thread waits in a call, which ends with an error. The stop
 * holds: until databoard4002_reset_stop() all commands are errors but Q, events and those that read. */
DATABOARD4002_API int databoard4002_stop(int card);

/* Ends the stop; nothing moves by itself. */
DATABOARD4002_API int databoard4002_reset_stop(int card);

/* ---- Errors ---- */

/* Returns the sentence of the last error in this thread since databoard4002_clear_error(), or "". Valid until the next
 * error in this thread. */
DATABOARD4002_API const char* databoard4002_last_error(void);

DATABOARD4002_API void databoard4002_clear_error(void);

/* ---- Commands ---- */

/* A: the present position is 0. */
DATABOARD4002_API int databoard4002_athome(int card);

/* D: sets how far lock lets the position deviate, 0 .. 8,388,607 counts. */
DATABOARD4002_API int databoard4002_set_deviation(int card, int counts);

/* D: reads the present position minus the requested one, in counts. */
DATABOARD4002_API int databoard4002_deviation(int card, int* counts);

/* G: starts what N, P, R and S specify, and returns at once; switches lock off. */
DATABOARD4002_API int databoard4002_go(int card);

/* I: without effect; the maker's programs send it. */
DATABOARD4002_API int databoard4002_initialise(int card);

/* L: goes back to the requested position whenever it deviates by more than D. */
DATABOARD4002_API int databoard4002_lock(int card);

/* M: slope mode and lock off. */
DATABOARD4002_API int databoard4002_manual(int card);

/* N: sets the target relative to the position at the next G, -8,388,608 .. 8,388,607 counts. */
DATABOARD4002_API int databoard4002_set_number(int card, int counts);

/* O: slope mode on, the rate at its maximum. */
DATABOARD4002_API int databoard4002_on_regulation(int card);

/* P: sets the absolute target of the next G, -8,388,608 .. 8,388,607 counts. */
DATABOARD4002_API int databoard4002_set_target(int card, int counts);

/* P: reads the present position, in counts. */
DATABOARD4002_API int databoard4002_position(int card, int* counts);

/* Q: stops; N and P are zeroed, the rate stays. Unlike databoard4002_stop() it waits for the call of another thread,
 * and it does not hold. */
DATABOARD4002_API int databoard4002_quit(int card);

/* R: sets the rate at once, 0 .. 16,383; 0 switches the relay off. */
DATABOARD4002_API int databoard4002_set_rate(int card, int rate);

/* R: reads the present rate; negative backwards, 0 at standstill. */
DATABOARD4002_API int databoard4002_rate(int card, int* rate);

/* V: reads the version of the card's program. */
DATABOARD4002_API int databoard4002_version(int card, int* version);

/* W: clears the reset mark in EVENT. */
DATABOARD4002_API int databoard4002_clear_watch_out(int card);

/* ---- Status and events ---- */

/* Bits of STAT. */
enum databoard4002_stat {
    DATABOARD4002_STAT_INT = 0x01,   /* an interrupt is asked for */
    DATABOARD4002_STAT_EVENT = 0x02, /* an enabled event has happened */
    DATABOARD4002_STAT_ZERO = 0x04,  /* the zero pulse input is active */
    DATABOARD4002_STAT_REF = 0x08,   /* the reference input is active */
    DATABOARD4002_STAT_EMS = 0x10,   /* the emergency stop input is active */
    DATABOARD4002_STAT_ESR = 0x20,   /* the right end stop is active */
    DATABOARD4002_STAT_ESL = 0x40,   /* the left end stop is active */
    DATABOARD4002_STAT_READY = 0x80  /* the card takes an access */
};

/* Bits of the EVENT word; all but the last can be enabled. */
enum databoard4002_event {
    DATABOARD4002_POSITION = 0x01, /* the position was reached or passed */
    DATABOARD4002_ZERO = 0x02,     /* the zero pulse was seen; the position is 0 there */
    DATABOARD4002_REF = 0x04,      /* the reference was seen; the position is 0 there */
    DATABOARD4002_STOP = 0x20,     /* an end stop or the emergency stop became active */
    DATABOARD4002_WATCH_OUT = 0x80 /* the card was reset */
};

/* Reads STAT, bits of enum databoard4002_stat, at any time. */
DATABOARD4002_API int databoard4002_status(int card, int* word);

/* Enables these events (C4), a sum of bits of enum databoard4002_event without WATCH_OUT, and reads the EVENT word,
 * which it frees: the events that happened before. */
DATABOARD4002_API int databoard4002_enable_events(int card, int events, int* word);

/* Enables no events, and reads the EVENT word, which it frees. */
DATABOARD4002_API int databoard4002_disable_events(int card, int* word);

/* Resets the card (C3), waits until it is Ready again, at most 1 s, and clears its reset mark. Position, rate and slope
 * are cleared. */
DATABOARD4002_API int databoard4002_reset(int card);

/* ---- Complete moves ---- */

/* Move to a position, or by a way with its direction, with the present rate, mode and slope, and wait for the end, 1 ..
 * 600,000 ms: then Q ends the move, which is an error. An end stop in the direction of the move, the emergency stop and
 * a reset of the card are errors, too. counts: -8,388,608 .. 8,388,607, also for the end of the move, and at most
 * 8,388,607 away. */
DATABOARD4002_API int databoard4002_move_to(int card, int counts, int milliseconds);
DATABOARD4002_API int databoard4002_move_by(int card, int counts, int milliseconds);

/* Moves slowly until a mark sets the position to 0, and stops (M, Q). marks: DATABOARD4002_ZERO, DATABOARD4002_REF, or
 * both for both at once. `last`: where the search ends at the latest, -8,388,608 .. 8,388,607 counts. rate: 1 ..
 * 16,383. */
DATABOARD4002_API int databoard4002_find_zero(int card, int marks, int last, int rate, int milliseconds);

/* ---- Slope ---- */

/* Writes a slope of 48 intervals (S), which moves follow after databoard4002_on_regulation(). `speed` between the
 * ramps: 1 .. 400,000 counts/s; `acceleration` of both ramps: 1 .. 100,000,000 counts/s2. counts_per_1000_pulses: 1 ..
 * 1,000,000, of a motor that follows FOUT. counts_per_volt: 1 .. 10,000,000 counts/s, of a motor that follows the
 * voltage; 0: it follows FOUT. */
DATABOARD4002_API int databoard4002_design_slope(int card, int speed, int acceleration, int counts_per_1000_pulses,
                                                 int counts_per_volt);

/* ---- Time ---- */

/* Advances the time of a virtual card, or sleeps, 0 .. 600,000 ms; databoard4002_stop() ends the sleep. */
DATABOARD4002_API int databoard4002_advance_ms(int card, int milliseconds);

/* Returns the card's time in microseconds: that of its rack since it was opened, or the computer's monotonic clock. */
DATABOARD4002_API int64_t databoard4002_now_us(int card);

/* ---- The virtual card ---- */

/* Reads a register or value of a virtual card by its name ("STAT", "POSITION", "MOVING"), without side effects; time
 * does not advance. */
DATABOARD4002_API int databoard4002_peek(int card, const char* name, int64_t* value);

/* Forces a wire of the rack ("c1.esr", "c1.ems") to 0 or 1; NAN releases it. */
DATABOARD4002_API int databoard4002_set_wire(int card, const char* wire, double value);

#ifdef __cplusplus
}
#endif

#endif
