/* Motionrack for C and for every language that can call C: a rack of motion-control cards in virtual time.
 *
 * Link with libmotionrack.so (-lmotionrack). The whole interface is C99 and has no types of C++.
 *
 * A program that moves axis X of an MCX314 by 100 pulses:
 *
 *     mr_rack *rack = NULL;
 *     uint16_t low = 0;
 *     if (mr_rack_open("card.c1 = \"mcx314\"", &rack) != MR_OK) {
 *         fprintf(stderr, "%s\n", mr_last_error());
 *         return 1;
 *     }
 *     mr_write16(rack, "c1", 0x0e, 0);           WR7: data, high word
 *     mr_write16(rack, "c1", 0x0c, 100);         WR6: data, low word
 *     mr_write16(rack, "c1", 0x00, 0x0106);      WR0: axis X, command 06h: P = 100
 *     mr_write16(rack, "c1", 0x00, 0x0120);      WR0: axis X, command 20h: drive + by P
 *     mr_advance_ns(rack, 1000000000);           a second passes
 *     mr_write16(rack, "c1", 0x00, 0x0110);      WR0: axis X, command 10h: LP to RR6, RR7
 *     mr_read16(rack, "c1", 0x0c, &low);         RR6: 100
 *     mr_rack_close(rack);
 *
 * Errors. Every function that returns int returns MR_OK (0) or one of the codes below, and mr_last_error() then tells in
 * a sentence what was wrong, what the limits are and what was (not) done. After an error the rack is as it was before
 * the call. A null pointer is MR_BAD_CALL; a pointer to something else, or to a rack that was closed, is not noticed.
 *
 * Threads. A rack belongs to one thread at a time: let no two calls with the same rack overlap. Different racks know
 * nothing of each other and may run in different threads at once. mr_last_error() is kept for each thread.
 *
 * Time. The rack's time is virtual: it passes in mr_advance_ns and, for as long as the card's bus takes, in the
 * functions that read and write registers; nowhere else. The same calls give the same world, bit for bit.
 *
 * Strings are UTF-8 and end with a zero byte; the library keeps none of the pointers that it is given.
 */
#ifndef MOTIONRACK_C_H
#define MOTIONRACK_C_H

#include <stdint.h>

#if defined(__GNUC__)
#define MR_API __attribute__((visibility("default")))
#else
#define MR_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* What a function returns. */
enum mr_result {
    MR_OK = 0,
    MR_BAD_CALL = 1,  /* a null pointer, a name that the rack does not have, a value that is none */
    MR_BAD_INPUT = 2, /* the rack file is wrong; mr_last_error() has a line for each mistake */
    MR_REFUSED = 3,   /* outside a limit, or something that this card cannot do */
    MR_IO = 5,        /* a file could not be read or written */
    MR_INTERNAL = 6   /* out of memory, or a mistake in the library */
};

/* A running rack. */
typedef struct mr_rack mr_rack;

/* ---- Racks ---- */

/* Opens a rack and starts it at time 0. The string is the path of a rack file or, if it has a '=' or a line end in it,
 * the text of one. "card.c1 = \"mcx314\"" is a whole rack: the card alone, each of its channels with an ideal axis that
 * follows every pulse (X Y Z A at the channels x y z u of an mcx314: 1000 pulses and 1000 encoder counts a mm or
 * degree), no switches, all inputs inactive. *out is set to NULL if it fails.
 * MR_BAD_CALL, MR_BAD_INPUT, MR_IO, MR_INTERNAL. */
MR_API int mr_rack_open(const char *toml_path_or_text, mr_rack **out);

/* Ends a rack and frees it; a recording that runs is ended first. NULL: nothing is done. */
MR_API void mr_rack_close(mr_rack *rack);

/* The sentence of the last error in this thread, "" if there was none. Valid until the next error in this thread. */
MR_API const char *mr_last_error(void);

/* ---- Time ---- */

/* Lets the world run for ns nanoseconds: 0 .. 1,000,000,000,000,000 (11.5 days) a call, 14 years in all.
 * MR_BAD_CALL, MR_REFUSED. */
MR_API int mr_advance_ns(mr_rack *rack, uint64_t ns);

/* The rack's time since it was opened, in whole ns. 0 for NULL. */
MR_API uint64_t mr_now_ns(const mr_rack *rack);

/* ---- The host's bus ---- */

/* One access of the host to a card, with all its effects, as on the real bus: 8 bits for cards with byte ports (as IN
 * and OUT), 16 or 32 bits for cards with registers of that width. `offset` is the byte offset of the register (the port's
 * number), as the card's reference page lists them. An access takes bus_access_ns of the rack file (250 ns if it says
 * none): virtual time passes before the card sees it. `value` is left alone if it fails.
 * MR_BAD_CALL (null, no such card), MR_REFUSED (the card's bus is of another width; nothing at that offset). */
MR_API int mr_read8(mr_rack *rack, const char *card, uint32_t port, uint8_t *value);
MR_API int mr_write8(mr_rack *rack, const char *card, uint32_t port, uint8_t value);
MR_API int mr_read16(mr_rack *rack, const char *card, uint32_t offset, uint16_t *value);
MR_API int mr_write16(mr_rack *rack, const char *card, uint32_t offset, uint16_t value);
MR_API int mr_read32(mr_rack *rack, const char *card, uint32_t offset, uint32_t *value);
MR_API int mr_write32(mr_rack *rack, const char *card, uint32_t offset, uint32_t value);

#ifdef __cplusplus
}
#endif

#endif
