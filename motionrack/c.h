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
 *     mr_write16(rack, "c1", 0x0e, 0);        // WR7: data, high word
 *     mr_write16(rack, "c1", 0x0c, 100);      // WR6: data, low word
 *     mr_write16(rack, "c1", 0x00, 0x0106);   // WR0: axis X, command 06h: P = 100
 *     mr_write16(rack, "c1", 0x00, 0x0120);   // WR0: axis X, command 20h: drive + by P
 *     mr_advance_ns(rack, 1000000000);        // a second passes
 *     mr_write16(rack, "c1", 0x00, 0x0110);   // WR0: axis X, command 10h: LP to RR6, RR7
 *     mr_read16(rack, "c1", 0x0c, &low);      // RR6: 100
 *     mr_rack_close(rack);
 *
 * Errors. Every function that returns int returns MR_OK (0) or one of the codes below, and mr_last_error() then has
 * a sentence with the cause, the limits and the effect. After an error the rack is as it was
 * before the call. A null pointer is MR_BAD_CALL; a pointer to something else, or to a rack that was closed, is not
 * detected. mr_run_program and mr_home report an error after which something has moved.
 *
 * Threads. A rack belongs to one thread at a time: calls with the same rack must not overlap. Different racks are
 * independent and may run in different threads at once. mr_last_error() is kept for each thread.
 *
 * Time. The rack's time is virtual: it passes in mr_advance_ns, mr_run_program and mr_home and, for as long as the
 * card's bus takes, in the functions that read and write registers; nowhere else. The same calls give the same world,
 * bit for bit.
 *
 * Call-backs. A call-back of passing time (mr_on_condition, the progress of a program) may call every function of
 * this file but those that advance time, mr_snapshot and mr_rack_close, which return MR_REFUSED with the rack of the
 * call-back. It must return: no longjmp, no exception.
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
    MR_BAD_CALL = 1,  /* a null pointer, a name that the rack does not have, an invalid value */
    MR_BAD_INPUT = 2, /* a rack file or part program is wrong; mr_last_error() has a line for each mistake */
    MR_REFUSED = 3,   /* outside a limit, or something that this card cannot do */
    MR_MACHINE = 4,   /* the machine stopped the motion (limit switch, alarm), or its position was lost */
    MR_IO = 5,        /* a file could not be read or written */
    MR_INTERNAL = 6,  /* out of memory, or a mistake in the library */
    MR_STOPPED = 7    /* a call-back asked for a stop, and the axes came to rest */
};

/* A running rack. */
typedef struct mr_rack mr_rack;

/* ---- Racks ---- */

/* Opens a rack and starts it at time 0. The string is the path of a rack file or, if it has a '=' or a line end in it,
 * the text of one. "card.c1 = \"mcx314\"" is a whole rack: the card alone, each of its channels with an ideal axis that
 * follows every pulse (X Y Z A at the channels x y z u of an mcx314: 1000 pulses and 1000 encoder counts a mm or
 * degree), no switches, all inputs inactive. *out is set to NULL if it fails.
 * MR_BAD_CALL, MR_BAD_INPUT, MR_IO, MR_INTERNAL. */
MR_API int mr_rack_open(const char* toml_path_or_text, mr_rack** out);

/* Ends a rack and frees it; a recording that runs is ended first, and if that fails mr_last_error() tells what became
 * of it. NULL: nothing is done; neither is anything in a call-back of this rack. */
MR_API void mr_rack_close(mr_rack* rack);

/* The sentence of the last error in this thread, "" if there was none. Valid until the next error in this thread. */
MR_API const char* mr_last_error(void);

/* The version of the library: three numbers with dots between them. */
MR_API const char* mr_version(void);

/* ---- Time ---- */

/* Lets the world run for ns nanoseconds: 0 .. 1,000,000,000,000,000 (11.5 days) a call, 14 years in all.
 * MR_BAD_CALL, MR_REFUSED. */
MR_API int mr_advance_ns(mr_rack* rack, uint64_t ns);

/* The rack's time since it was opened, in whole ns. 0 for NULL. */
MR_API uint64_t mr_now_ns(const mr_rack* rack);

/* ---- The host's bus ---- */

/* One access of the host to a card, with all its effects, as on the real bus: 8 bits for cards with byte ports (as IN
 * and OUT), 16 or 32 bits for cards with registers of that width (an mcx314: 16, or 8 where its section of the rack
 * file says bus = "8-bit"). `offset` is the byte offset of the register (the port's number), as the card's reference
 * page lists them; of an ioflex02, which shares its bus with others, base_address of the rack file and that offset. An
 * access takes bus_access_ns of the rack file, which the reference page of rack files gives a default for each kind of
 * card (mcx314 250 ns, databoard4002 1000 ns): virtual time passes before the card sees it. `value` is left alone if it
 * fails. MR_BAD_CALL (null, no such card), MR_REFUSED (the card's bus is of another width; nothing at that offset). */
MR_API int mr_read8(mr_rack* rack, const char* card, uint32_t port, uint8_t* value);
MR_API int mr_write8(mr_rack* rack, const char* card, uint32_t port, uint8_t value);
MR_API int mr_read16(mr_rack* rack, const char* card, uint32_t offset, uint16_t* value);
MR_API int mr_write16(mr_rack* rack, const char* card, uint32_t offset, uint16_t value);
MR_API int mr_read32(mr_rack* rack, const char* card, uint32_t offset, uint32_t* value);
MR_API int mr_write32(mr_rack* rack, const char* card, uint32_t offset, uint32_t value);

/* A register or value of a card by its name, without any effect; it takes no time.
 *   "RR0"        as the card's reference page names it; one that exists once an axis is that of the axis whose
 * registers
 *                the bus shows
 *   "x.RR1"      that of one axis, not the one on the bus; also written values: "x.WR2", "x.P", and counters: "x.LP",
 *                "x.EP", and "x.CV", "x.CA", the present speed and acceleration, in the card's units
 * Counters and positions are signed: cast *value to int64_t. For an unknown name the error lists the known ones.
 * MR_BAD_CALL. */
MR_API int mr_peek(mr_rack* rack, const char* card, const char* register_name, uint64_t* value);

/* ---- Frames of a grating bus ---- */

enum { MR_MAX_SCALES = 128 }; /* of a frame */

/* The scales of one instant, as a card of type grating_bus holds them. Entries from `words` on are 0. A count is the
 * low 32 bits of its scale's, signed: (int32_t)((uint32_t)now - (uint32_t)before) is the distance between two frames,
 * while that is less than 2^31. */
typedef struct mr_frame {
    uint32_t sequence;                /* number of the bus' period, wraps */
    uint32_t words;                   /* 1 .. MR_MAX_SCALES: scales of the frame */
    int64_t time_100ps;               /* the instant of HOLD, in 100 ps since the rack was opened */
    int32_t counts[MR_MAX_SCALES];    /* of each word */
    uint8_t addresses[MR_MAX_SCALES]; /* 0 .. 127: which scale each word is of, as the host addressed it */
} mr_frame;

/* The frame that the card has published last: claims its buffer, copies it by the card's registers, gives the buffer
 * back and checks the CRC. That takes bus_access_ns of the rack file for each of some 12 + 3 words accesses, also where
 * it is refused. `frame` is left alone if it fails. MR_BAD_CALL (null, no such card, one of another type), MR_REFUSED
 * (no frame yet; the last one is stale, two periods old, and its positions must not be used; its CRC is wrong). */
MR_API int mr_frame_read(mr_rack* rack, const char* card, mr_frame* frame);

/* The same with the next frame that was not read yet: the world runs until there is one, for timeout_ns (0 ..
 * 1,000,000,000,000,000) at most. MR_BAD_CALL, MR_REFUSED (those of mr_frame_read; no frame came within that time). */
MR_API int mr_frame_wait(mr_rack* rack, const char* card, uint64_t timeout_ns, mr_frame* frame);

/* ---- Wires ---- */

/* Wires are called CARD.PIN ("c1.xlmtp"), NAME.END for the ends of an axis' parts ("X.limit_plus"), or "estop" (low
 * while the button is pressed); the page of the rack file lists pins and ends. A digital wire is 0 or 1: the line's
 * level, so that an input which acts at Low reads 0 while it acts. An analog wire is its value in SI units; one that
 * carries a number (an rtc5's xout, yout, mcbsp) is that number. */

/* The level of a wire. MR_BAD_CALL (null, no such wire). */
MR_API int mr_wire_get(mr_rack* rack, const char* wire, double* value);

/* Drives a wire from outside, from this instant on: 0 or 1 for a digital one. What drove it before is cut off until the
 * wire is released: value NAN. Inputs of cards, switches, the index track and estop can be driven. The two inputs of an
 * encoder (xeca, xecb) are taken over together: the encoder is cut off, the other input keeps the level that it had,
 * and the card counts what the inputs do until both are released; its counter goes on from where it is. MR_BAD_CALL
 * (null, no such wire), MR_REFUSED (an output; another value). */
MR_API int mr_wire_set(mr_rack* rack, const char* wire, double value);

/* ---- The machine ---- */

/* The true value of a part, independent of all counters: "X.position_mm". The quantities of an axis (mm or deg by its
 * kind):
 *   position_mm       the true position of the table
 *   speed_mm_s        velocity of the table by the rotor, signed
 *   position_pulses   the rotor in microsteps since the start
 *   position_counts   counts of its encoder since the start (with an encoder)
 *   pulses            pulses that came to the motor, + less -
 *   lost_pulses       pulses that the rotor did not follow
 *   in_step           1 while the rotor follows the pulses, else 0
 *   top_speed_mm_s    the peak velocity so far
 *   limit_minus       1 while the machine is at that switch, independent of its wire (if it has one)
 *   limit_plus        the same for the switch at the + end
 *   home              the same for the home switch
 *   cam               1 while the machine is on its reference cam
 *   drive_v           the voltage at the servo amplifier
 * Of a stage:
 *   position_mm       the true position of the stage
 *   speed_mm_s        its velocity, signed
 *   drive_v           the voltage at its amplifier
 *   scale_mm          its position by its scale
 *   scale_counts      counts of its scale
 *   lost_counts       counts that its scale has lost
 *   trusted           1 while its scale has lost none, else 0
 *   closed            1 while its loop is closed, else 0 (with a servo)
 *   following_nm      following error at the last frame: commanded - measured (with a servo)
 *   following_peak_nm the peak following error so far, absolute (with a servo)
 *   following_rms_nm  the RMS following error so far (with a servo)
 *   wanted_mm         its commanded position (with a servo)
 *   unused_frames     frames that its loop could not use (with a servo)
 * Of a belt or a rotary table (mm or deg by its kind):
 *   position_mm       its travel since the start
 *   speed_mm_s        its velocity, signed
 *   encoder_counts    counts of its encoder
 *   lost_counts       counts that the encoder lost above its maximum rate
 *   word              the sender's last complete word
 *   parts             number of parts that reached the sensor
 * Of a scan head:
 *   spot_x_mm         position of the spot in the field, X
 *   spot_y_mm         the same, Y
 *   light             1 while the laser is on, else 0
 *   marked_mm         length of all marks on the part
 *   energy_j          laser energy on the part
 *   points            stored points of the marks
 *   lost_points       points beyond max_points
 * For an unknown name the error lists the known ones. MR_BAD_CALL. */
MR_API int mr_part_get(mr_rack* rack, const char* part_dot_quantity, double* value);

/* Pushes a part by hand: position_mm (position_deg) and position_pulses can be set. A motor in step moves to the
 * nearest position of the same electrical phase, a multiple of four full steps away, as a real one under current does:
 * read the quantity for the result. Of a belt or table speed_mm_s (speed_deg_s) can be set.
 * MR_BAD_CALL; MR_REFUSED (read-only; not a number; more than 10,000,000 microsteps away). */
MR_API int mr_part_set(mr_rack* rack, const char* part_dot_quantity, double value);

/* Injects a fault, or repairs it: fault "NAME" or "NAME=VALUE" (without a value: 1), target the axis ("X")
 * or, for the last three and those of an encoder's tracks, a belt or table by its name.
 *   motor.stall              the axle is blocked; 0 releases it
 *   motor.lose_steps         the rotor falls back by about VALUE pulses (whole electrical cycles), at most 10,000,000
 *   motor.push               the rotor is moved by about VALUE microsteps, at most 10,000,000 either way
 *   encoder.broken_a         track A reads Low; 0 repairs it. One fault of the encoder at a time
 *   encoder.broken_b         track B reads Low
 *   encoder.swapped          the tracks are swapped
 *   limit_minus.stuck_open   the switch never acts; 0 repairs it
 *   limit_minus.stuck_closed the switch always acts
 *   limit_plus.stuck_open    and so on
 *   limit_plus.stuck_closed
 *   home.stuck_open
 *   home.stuck_closed
 *   motor.load               a servo's load becomes VALUE times its own inertia
 *   encoder.inverted_a       if the tracks are wires (to an ioflex02): track A is inverted; 0 repairs it
 *   encoder.inverted_b       track B
 *   encoder.noise            VALUE wrong levels from now on, 0.5 to 10 us each
 *   encoder.jitter           edges are up to VALUE seconds late
 *   encoder.dirt             VALUE adjacent lines of the disc are dirty and not read
 *   encoder.overspeed        above VALUE edges a second lines are lost; 0 repairs it
 *   encoder.eccentricity     the disc has an eccentricity of VALUE counts
 *   drive.speed              a belt or table moves at VALUE mm/s or degrees/s from now on; 0: standstill
 *   drive.profile            back to the profile of the rack file
 *   sender.silent            the sender is silent; 0 repairs it
 * Stages and cards have faults, too ("scale.lose" of a stage, "off" of a card): mr_faults lists those of a rack.
 * MR_BAD_CALL (null, no such fault or target), MR_REFUSED (the axis has no such part; the value). */
MR_API int mr_fault(mr_rack* rack, const char* fault, const char* target);

/* A quantity of the rack, for mr_quantities. */
typedef struct mr_quantity {
    const char* name;    /* as mr_part_get takes it: "X.position_mm" */
    const char* meaning; /* "the true position of the table" */
    const char* unit;    /* "mm", "deg/s", "counts"; "": it has none */
    double min, max;     /* range of its values, infinite if unbounded; if it can be set: the range of mr_part_set */
    int can_set;         /* 1: by mr_part_set, else 0 */
} mr_quantity;

/* Calls `tell` with each quantity that this rack has: of its axes, stages, belts, tables and scan heads, as above, then
 * of its cards. The texts hold until `tell` returns. MR_BAD_CALL, MR_INTERNAL. */
MR_API int mr_quantities(mr_rack* rack, void (*tell)(void* user, const mr_quantity* quantity), void* user);

/* A fault that can be injected, for mr_faults. */
typedef struct mr_fault_info {
    const char* name;    /* as mr_fault takes it: "motor.push" */
    const char* target;  /* "X" */
    const char* meaning; /* what the value does */
    const char* unit;    /* of the value: "microsteps"; "": it has none */
    double min, max;     /* what the value may be */
} mr_fault_info;

/* Calls `tell` with each fault that something in this rack can have: axes, cards, stages, belts and tables. The texts
 * hold until `tell` returns. MR_BAD_CALL, MR_INTERNAL. */
MR_API int mr_faults(mr_rack* rack, void (*tell)(void* user, const mr_fault_info* fault), void* user);

/* ---- The controller ---- */

/* How a program is run; all of it may be 0. */
typedef struct mr_run_options {
    const char* tools; /* path of a tool table (LinuxCNC's .tbl) for G43, G41, G42; NULL: there is none */
    int block_delete;  /* not 0: lines that begin with '/' are left out */
    /* Called about every 50 ms of virtual time with the time since the program began, the line that is driven and how
     * many lines there are. An answer other than 0 stops the program: the axes come to rest along the path. NULL: none.
     */
    int (*progress)(void* user, double seconds, int64_t line, int64_t lines);
    void* user; /* for progress */
} mr_run_options;

/* What came of a program. */
typedef struct mr_run_result {
    int ok;               /* 1: it was driven to its end, and nothing was lost or broken on the way; else 0 */
    int line, column;     /* of the first error, from 1; 0: it has none */
    double seconds;       /* virtual time that it took */
    double path_mm;       /* length of its path in X, Y, Z */
    double deviation_mm;  /* how far the machine was from the program at most, by the positions of the last mr_home */
    const char* sentence; /* how it ended, and each error, a line each; holds until the next program or mr_home of
                           * this rack, and its end */
} mr_run_result;

/* Runs a part program (G-code) on the rack's controller, as `motionrack run` does, from its first line to standstill:
 * at any time, one after the other. `path_or_text` is the path of a file, beside which its subprograms lie, or, if it
 * has a line end in it, the text. All of it is read first: if anything is wrong, nothing moves, and mr_last_error() has
 * a line for each mistake, with line and column. Wires may be driven, faults injected and recordings begun before;
 * during it counters are recorded every 50 ms. A program begins where the controller has the axes: where the rack file
 * says that the machine stands, or where mr_home found it, and on from there by the pulses that the card has sent
 * since, by whatever command (of a servo by what its motor has turned). What a host wrote into the card's counters
 * does not count. G-code modes and offsets are reset, and an mcx314 is initialised again: the
 * host's register values and outputs are lost, and EP begins at 0. An axis whose position an earlier program or mr_home
 * has lost keeps programs from beginning until it is homed. `options` and `result` may be NULL; `result` and mr_report
 * are of this program alone. MR_BAD_CALL, MR_BAD_INPUT, MR_IO and MR_REFUSED (the rack has no axes; an axis moves, or
 * its position was lost; a host wrote to the counter of a databoard4002; a call-back called): nothing moved.
 * MR_MACHINE, MR_STOPPED: it moved. MR_INTERNAL. */
MR_API int mr_run_program(mr_rack* rack, const char* path_or_text, const mr_run_options* options,
                          mr_run_result* result);

/* Homes axes as `motionrack home` does: "XY" or "x, y"; NULL or "": every axis that has a home switch. How each
 * searches is said in the rack file. MR_BAD_CALL; MR_REFUSED (no such axis; it has no home switch; a call-back called;
 * an emergency stop, and then the bus took its time): nothing moved; MR_MACHINE (a switch was not found, the machine
 * stopped): the axes stand. */
MR_API int mr_home(mr_rack* rack, const char* axes);

/* What the command line prints of the rack's last mr_run_program or mr_home: lines of text; "" if nothing has moved by
 * them. Holds until the next of them, and the rack's end. */
MR_API const char* mr_report(const mr_rack* rack);

/* ---- The whole world ---- */

/* Makes a copy of the whole world, cards, wires, machine, time: a rack of its own that must be closed by itself. The
 * same calls from here on do the same in both; the positions of its axes, valid or not, go with it. But a driver's
 * memory belongs to its host: the first mr_home of a copy initialises its cards again. A recording and the
 * call-back of mr_on_condition stay with the first. *copy is set to NULL if it fails. MR_BAD_CALL, MR_REFUSED (a
 * call-back called), MR_INTERNAL. */
MR_API int mr_snapshot(mr_rack* rack, mr_rack** copy);

/* Equal worlds have equal hashes: time, cards, wires, parts and the history of the wires. How the time was cut into
 * calls of mr_advance_ns does not matter. A recording may be seen in it (pins that cards drive on demand are driven for
 * it), so compare worlds that were recorded alike. 0 for NULL. */
MR_API uint64_t mr_state_hash(const mr_rack* rack);

/* Reports the conditions of the rack: an early access, an illegal transition, an end of travel. Oldest first, those
 * with numbers above `since` (0: all); numbers begin with 1, and the last 4096 are kept. `at_100ps`: the instant at
 * which it happened, in 100 ps; `card`: the name of the card, or of another part; `code`: of this kind of card;
 * `sentence`: for the user. Both texts hold until `tell` returns, which may call functions of this file but
 * mr_rack_close. MR_BAD_CALL, MR_INTERNAL. */
MR_API int mr_conditions(mr_rack* rack, uint64_t since,
                         void (*tell)(void* user, uint64_t number, int64_t at_100ps, const char* card, int code,
                                      const char* sentence),
                         void* user);

/* From now on `call` gets each condition when it happens, as mr_conditions tells it: in their order, none twice, none
 * left out but those beyond 4096 at once. Time stands at that instant, so what it looks at is the world of
 * then, and what it does (drive a wire, inject a fault, begin a recording) happens then; in mr_run_program and mr_home
 * it comes at most 50 ms later. What happens in mr_read and mr_write, mr_frame_wait, mr_wire_set, mr_part_set and
 * mr_fault comes before they return. The world goes on as it would without. NULL: no more. MR_BAD_CALL, MR_INTERNAL. */
MR_API int mr_on_condition(mr_rack* rack,
                           void (*call)(void* user, uint64_t number, int64_t at_100ps, const char* card, int code,
                                        const char* sentence),
                           void* user);

/* ---- Recordings ---- */

/* Begins to record signals into a file: *.vcd (for GTKWave, PulseView, sigrok-cli), *.csv (time_s, signal, value: each
 * change a line) or *.h5 (HDF5, as the page of recordings has it: wires/X/step/time and value). Levels are 0 and 1;
 * voltages are in V, counters and words of a bus numbers. `signals`: patterns with * and ?, separated by blanks or
 * commas ("X.* c1.xlmtp"); NULL or "": every wire, the pulses of each axis (X.step, X.dir), its encoder tracks
 * (X.enc_a, X.enc_b) and the card's counters (c1.xlp, c1.xep), these once a millisecond. Pins that a card drives on
 * demand (c1.xpp) are recorded if a pattern names them. One recording at a time; one that mr_trace_stop could not end
 * is given up for the new one. MR_BAD_CALL (null, no signal fits), MR_REFUSED (another ending; one runs already),
 * MR_IO. */
MR_API int mr_trace_start(mr_rack* rack, const char* path, const char* signals);

/* The unit of time of VCD files that are begun from now on: 0.1, 1, 10, 100 or 1000 ns, or such a part of a second; 0,
 * as at first: the coarsest that shows every edge that cards and parts drive, 100 ns at most; wires that you drive at
 * shorter intervals need a finer one. sigrok-cli makes a sample of each unit: let it read a fine one with
 * -I vcd:downsample=N. MR_BAD_CALL, MR_REFUSED (another unit). */
MR_API int mr_trace_unit(mr_rack* rack, double ns);

/* Ends the recording and its file. MR_BAD_CALL, MR_REFUSED (none runs), MR_IO (the file could not be written whole: the
 * recording goes on; make room and end it again, or begin another. What an *.h5 file had is lost then: begin another).
 */
MR_API int mr_trace_stop(mr_rack* rack);

#ifdef __cplusplus
}
#endif

#endif
