/* Motionrack for C and for every language that can call C: a rack of motion-control cards in virtual time.
 *
 * Link with libmotionrack.so (-lmotionrack). The interface is plain C99, without C++ types.
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
 *     mr_advance_ns(rack, 1000000000);        // advances virtual time by 1 s
 *     mr_write16(rack, "c1", 0x00, 0x0110);   // WR0: axis X, command 10h: LP to RR6, RR7
 *     mr_read16(rack, "c1", 0x0c, &low);      // RR6: 100
 *     mr_rack_close(rack);
 *
 * Errors. Every function that returns int returns MR_OK (0) or one of the codes below. After an error mr_last_error()
 * returns a sentence with the cause, the limits and the effect, and the rack is unchanged; only mr_run_program and
 * mr_home may fail after a motion. A null pointer gives MR_BAD_CALL. Invalid pointers and closed racks are not
 * detected.
 *
 * Threads. A rack belongs to one thread at a time: calls with the same rack must not overlap. Different racks are
 * independent and may run in different threads at once. mr_last_error() is kept per thread.
 *
 * Time. The rack's time is virtual. It advances only in mr_advance_ns, mr_frame_wait, mr_run_program and mr_home, and
 * by the duration of a bus access in the functions that read and write registers. Equal calls give equal results, bit
 * for bit.
 *
 * Call-backs. A call-back during a call (mr_on_condition, the progress of a program) may call every function of this
 * file except those that advance time, mr_snapshot and mr_rack_close: with the rack of the call-back these return
 * MR_REFUSED. It must return normally: no longjmp, no exception.
 *
 * Strings are UTF-8 and end with a zero byte. The library copies its arguments; no pointer is kept after a call.
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

/* Result of a function. */
enum mr_result {
    MR_OK = 0,
    MR_BAD_CALL = 1,  /* a null pointer, a name that the rack does not have, an invalid value */
    MR_BAD_INPUT = 2, /* an invalid rack file or part program; mr_last_error() has one line per mistake */
    MR_REFUSED = 3,   /* outside a limit, or not supported by this card */
    MR_MACHINE = 4,   /* the machine stopped the motion (limit switch, alarm), or its position was lost */
    MR_IO = 5,        /* a file could not be read or written */
    MR_INTERNAL = 6,  /* out of memory, or an error in the library */
    MR_STOPPED = 7    /* a call-back requested a stop; the axes are at standstill */
};

/* A running rack. */
typedef struct mr_rack mr_rack;

/* ---- Racks ---- */

/* Opens a rack and starts it at time 0. The string is the path of a rack file or, if it contains a '=' or a line end,
 * the text of one. "card.c1 = \"mcx314\"" is a complete rack: one card, each channel with an ideal axis that follows
 * every pulse (X Y Z A at the channels x y z u of an mcx314: 1000 pulses and 1000 encoder counts per mm or degree), no
 * switches, all inputs inactive. All cards are virtual: the address of a real one (port:PATH, memory:PATH, uio:PATH) is
 * refused, with the library that opens it, or the reason why none does. On failure *out is NULL. MR_BAD_CALL,
 * MR_BAD_INPUT, MR_IO, MR_INTERNAL. */
MR_API int mr_rack_open(const char* toml_path_or_text, mr_rack** out);

/* Ends a running recording, then closes and frees the rack. mr_last_error() reports a recording that could not be
 * ended. Has no effect for NULL or in a call-back of this rack. */
MR_API void mr_rack_close(mr_rack* rack);

/* Returns the sentence of the last error in this thread, or "". Valid until the next error in this thread. */
MR_API const char* mr_last_error(void);

/* Returns the version of the library: three numbers, separated by dots. */
MR_API const char* mr_version(void);

/* ---- Time ---- */

/* Advances virtual time by ns nanoseconds: 0 .. 1,000,000,000,000,000 (11.5 days) per call, 14 years in total.
 * MR_BAD_CALL, MR_REFUSED. */
MR_API int mr_advance_ns(mr_rack* rack, uint64_t ns);

/* Returns the virtual time since the rack was opened, in whole ns; 0 for NULL. */
MR_API uint64_t mr_now_ns(const mr_rack* rack);

/* ---- The host's bus ---- */

/* Executes one access of the host to a card, with all its effects, as on the real bus: 8 bits for cards with byte ports
 * (IN and OUT), 16 or 32 bits for cards with registers of that width (an mcx314: 16 bits, or 8 bits if its section of
 * the rack file has bus = "8-bit"). `offset` is the byte offset of the register, or the number of the port, from the
 * card's reference page; for an ioflex02, which shares its bus with others, base_address of the rack file plus that
 * offset. Virtual time advances by bus_access_ns of the rack file before the card receives the access; the reference
 * page of rack files has the default of each card type (mcx314 250 ns, databoard4002 1000 ns). On failure *value is
 * unchanged. MR_BAD_CALL (null, unknown card), MR_REFUSED (a bus of another width; no register at that offset). */
MR_API int mr_read8(mr_rack* rack, const char* card, uint32_t port, uint8_t* value);
MR_API int mr_write8(mr_rack* rack, const char* card, uint32_t port, uint8_t value);
MR_API int mr_read16(mr_rack* rack, const char* card, uint32_t offset, uint16_t* value);
MR_API int mr_write16(mr_rack* rack, const char* card, uint32_t offset, uint16_t value);
MR_API int mr_read32(mr_rack* rack, const char* card, uint32_t offset, uint32_t* value);
MR_API int mr_write32(mr_rack* rack, const char* card, uint32_t offset, uint32_t value);

/* Reads a register or value of a card by its name, without side effects; virtual time does not advance.
 *   "RR0"        a name of the card's reference page; of a register per axis: the one that the bus shows at present
 *   "x.RR1"      the register of that axis; also written values: "x.WR2", "x.P", counters: "x.LP", "x.EP", and the
 *                present speed and acceleration in the card's units: "x.CV", "x.CA"
 * Counters and positions are signed: cast *value to int64_t. For an unknown name the error lists the known names.
 * MR_BAD_CALL. */
MR_API int mr_peek(mr_rack* rack, const char* card, const char* register_name, uint64_t* value);

/* ---- Frames of a grating bus ---- */

enum { MR_MAX_SCALES = 128 }; /* scales per frame */

/* Counts of all scales at one instant, as a card of type grating_bus publishes them. Entries from `words` on are 0. A
 * count has the low 32 bits of its scale's count, signed: (int32_t)((uint32_t)now - (uint32_t)before) is the distance
 * between two frames if it is less than 2^31. */
typedef struct mr_frame {
    uint32_t sequence;                /* number of the bus period; wraps */
    uint32_t words;                   /* 1 .. MR_MAX_SCALES: number of scales in the frame */
    int64_t time_100ps;               /* instant of HOLD, in 100 ps since the rack was opened */
    int32_t counts[MR_MAX_SCALES];    /* count of each word */
    uint8_t addresses[MR_MAX_SCALES]; /* 0 .. 127: address of the scale of each word, as the host addressed it */
} mr_frame;

/* Reads the frame that the card published last: claims its buffer, copies it through the card's registers, releases the
 * buffer and checks the CRC. Takes about 12 + 3 * words accesses of bus_access_ns each, also if the call is refused. On
 * failure *frame is unchanged. MR_BAD_CALL (null, unknown card, card of another type), MR_REFUSED (no frame yet; the
 * frame is stale, two periods old, and its positions must not be used; its CRC is wrong). */
MR_API int mr_frame_read(mr_rack* rack, const char* card, mr_frame* frame);

/* Waits for the next unread frame, advancing virtual time by at most timeout_ns (0 .. 1,000,000,000,000,000), and reads
 * it. MR_BAD_CALL, MR_REFUSED (those of mr_frame_read; no frame within that time). */
MR_API int mr_frame_wait(mr_rack* rack, const char* card, uint64_t timeout_ns, mr_frame* frame);

/* ---- Wires ---- */

/* Names of wires: CARD.PIN ("c1.xlmtp"), NAME.END for the signals of an axis' parts ("X.limit_plus"), or "estop" (low
 * while the button is pressed); the reference page of rack files lists pins and signals. The value of a digital wire is
 * the level of the line, 0 or 1: an active-low input reads 0 while it is active. An analog wire has its value in SI
 * units; a wire that carries a number (xout, yout and mcbsp of an rtc5) has that number. */

/* Reads the value of a wire. MR_BAD_CALL (null, unknown wire). */
MR_API int mr_wire_get(mr_rack* rack, const char* wire, double* value);

/* Forces a wire to a value from this instant on, 0 or 1 for a digital wire; NAN releases it. While it is forced, its
 * driver is disconnected. Inputs of cards, switches, the index track and estop can be forced. The two inputs of an
 * encoder (xeca, xecb) are forced together: the encoder is disconnected, the other input keeps its level, and the card
 * counts the edges of the inputs until both are released; its counter continues from its value. MR_BAD_CALL (null,
 * unknown wire), MR_REFUSED (an output; an invalid value). */
MR_API int mr_wire_set(mr_rack* rack, const char* wire, double value);

/* ---- The machine ---- */

/* Reads a true value of the simulated machine, independent of all counters: "X.position_mm". Quantities of an axis (mm
 * or deg by its kind):
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
 * Of a signal lamp:
 *   lit               1 while it shines, else 0
 * For an unknown name the error lists the known names. MR_BAD_CALL. */
MR_API int mr_part_get(mr_rack* rack, const char* part_dot_quantity, double* value);

/* Moves a part by hand: sets position_mm (position_deg) or position_pulses. A motor in step moves to the nearest
 * position of the same electrical phase, a multiple of four full steps away, like a real motor under current; read the
 * quantity for the result. For a belt or rotary table, speed_mm_s (speed_deg_s) can be set. MR_BAD_CALL, MR_REFUSED
 * (read-only; not a number; more than 10,000,000 microsteps away). */
MR_API int mr_part_set(mr_rack* rack, const char* part_dot_quantity, double value);

/* Injects a fault, or repairs it: fault "NAME" or "NAME=VALUE" (default value 1), target the axis ("X") or, for the
 * last three faults and those of encoder tracks, the name of a belt or table.
 *   motor.stall              the axle is blocked; 0 releases it
 *   motor.lose_steps         the rotor falls back by about VALUE pulses (whole electrical cycles), at most 10,000,000
 *   motor.push               the rotor is moved by about VALUE microsteps, at most 10,000,000 either way
 *   encoder.broken_a         track A reads Low; 0 repairs it. One fault of the encoder at a time
 *   encoder.broken_b         track B reads Low
 *   encoder.swapped          the tracks are swapped
 *   limit_minus.stuck_open   the switch never acts; 0 repairs it
 *   limit_minus.stuck_closed the switch always acts
 *   limit_plus.stuck_open    as limit_minus
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
 * Stages, lamps and cards have faults, too ("scale.lose" of a stage, "off" of a card): mr_faults lists those of a rack.
 * MR_BAD_CALL (null, unknown fault or target), MR_REFUSED (the axis has no such part; value out of range). */
MR_API int mr_fault(mr_rack* rack, const char* fault, const char* target);

/* Description of a quantity, for mr_quantities. */
typedef struct mr_quantity {
    const char* name;    /* name for mr_part_get: "X.position_mm" */
    const char* meaning; /* "the true position of the table" */
    const char* unit;    /* "mm", "deg/s", "counts"; "": no unit */
    double min, max;     /* range of its values, infinite if unbounded; if it can be set: the range of mr_part_set */
    int can_set;         /* 1: mr_part_set can set it; else 0 */
} mr_quantity;

/* Calls `tell` for each quantity of the rack: of its axes, stages, belts, tables, scan heads and lamps as above, then
 * of its cards. The texts are valid until `tell` returns. MR_BAD_CALL, MR_INTERNAL. */
MR_API int mr_quantities(mr_rack* rack, void (*tell)(void* user, const mr_quantity* quantity), void* user);

/* Description of a fault that can be injected, for mr_faults. */
typedef struct mr_fault_info {
    const char* name;    /* name for mr_fault: "motor.push" */
    const char* target;  /* "X" */
    const char* meaning; /* effect of the value */
    const char* unit;    /* unit of the value: "microsteps"; "": no unit */
    double min, max;     /* range of the value */
} mr_fault_info;

/* Calls `tell` for each fault that can be injected in this rack: of axes, cards, stages, belts, tables and lamps. The
 * texts are valid until `tell` returns. MR_BAD_CALL, MR_INTERNAL. */
MR_API int mr_faults(mr_rack* rack, void (*tell)(void* user, const mr_fault_info* fault), void* user);

/* ---- The controller ---- */

/* Options of a program run; all fields may be 0. */
typedef struct mr_run_options {
    const char* tools; /* path of a tool table (LinuxCNC's .tbl) for G43, G41, G42; NULL: no table */
    int block_delete;  /* not 0: skips lines that begin with '/' */
    /* Called about every 50 ms of virtual time with the time since the start of the program, the current line and the
     * number of lines. A result other than 0 stops the program: the axes decelerate to a stop on the path. NULL: none.
     */
    int (*progress)(void* user, double seconds, int64_t line, int64_t lines);
    void* user; /* for progress */
} mr_run_options;

/* Result of a program run. */
typedef struct mr_run_result {
    int ok;               /* 1: the program ran to its end without step loss or faults; else 0 */
    int line, column;     /* position of the first error, from 1; 0: no position */
    double seconds;       /* duration in virtual time */
    double path_mm;       /* length of the path in X, Y, Z */
    double deviation_mm;  /* maximum deviation from the programmed path, mm, in the coordinates of the last mr_home */
    const char* sentence; /* how the program ended, then one line per error; valid until the next program or mr_home of
                           * this rack, or its end */
} mr_run_result;

/* Runs a part program (G-code) on the rack's controller, as `motionrack run` does, from its first line to standstill.
 * Programs may follow each other at any time. `path_or_text` is the path of a file, whose folder has the subprograms,
 * or, if it contains a line end, the text. The whole program is checked first: if it has a mistake, nothing moves, and
 * mr_last_error() has one line per mistake, with line and column. Wires may be forced, faults injected and recordings
 * started before the call; during it a recording stores counters every 50 ms.
 *
 * The program starts at the controller's position of the axes: the initial position of the rack file or that of the
 * last mr_home, plus all pulses that the card has sent since, by any command (for a servo: the rotation of its motor).
 * Values that a host writes into the card's counters do not change it. G-code modes and offsets are reset, and an
 * mcx314 is initialised: the host's register values and outputs are lost, and EP starts at 0. If an earlier program or
 * mr_home invalidated the position of an axis, programs are refused until the axis is homed. `options` and `result` may
 * be NULL; `result` and mr_report describe this program only.
 *
 * MR_BAD_CALL, MR_BAD_INPUT, MR_IO, MR_REFUSED (the rack has no axes; an axis moves, or its position is not valid; a
 * host wrote to the counter of a databoard4002; called by a call-back): nothing moved. MR_MACHINE, MR_STOPPED: the
 * machine moved. MR_INTERNAL. */
MR_API int mr_run_program(mr_rack* rack, const char* path_or_text, const mr_run_options* options,
                          mr_run_result* result);

/* Homes axes as `motionrack home` does: "XY" or "x, y"; NULL or "": every axis with a home switch. The rack file
 * defines the homing method of each. MR_BAD_CALL, MR_REFUSED (unknown axis; no home switch; called by a call-back; an
 * active emergency stop; time advances by the bus accesses): nothing moved. MR_MACHINE (a switch was not found, or the
 * machine stopped): the axes are at standstill. */
MR_API int mr_home(mr_rack* rack, const char* axes);

/* Returns the report of the rack's last mr_run_program or mr_home, in lines as the command line prints them; "" if
 * neither has moved an axis. Valid until the next of these calls, or the rack's end. */
MR_API const char* mr_report(const mr_rack* rack);

/* ---- The whole rack ---- */

/* Copies the rack with cards, wires, machine and time; close the copy separately. Equal calls have equal effects in
 * both. The copy keeps the positions of the axes and their validity, but not the state of the drivers: its first
 * mr_home initialises its cards again. A recording and the call-back of mr_on_condition stay with the original. On
 * failure *copy is NULL. MR_BAD_CALL, MR_REFUSED (called by a call-back), MR_INTERNAL. */
MR_API int mr_snapshot(mr_rack* rack, mr_rack** copy);

/* Hash of time, cards, wires, parts and event trace; equal for equal racks. The division of time into calls of
 * mr_advance_ns does not change it. A recording may change it, because cards drive on-demand pins for it: compare racks
 * with equal recordings. 0 for NULL. */
MR_API uint64_t mr_state_hash(const mr_rack* rack);

/* Calls `tell` for each condition of the rack (an early access, an illegal transition, an end of travel) whose number
 * is above `since` (0: all), oldest first. Numbers start at 1; the last 4096 conditions are kept. `at_100ps`: instant
 * of the condition, in 100 ps; `card`: name of the card or part; `code`: code of this card type; `sentence`: text for
 * the user. Both texts are valid until `tell` returns. `tell` may call every function of this file except
 * mr_rack_close. MR_BAD_CALL, MR_INTERNAL. */
MR_API int mr_conditions(mr_rack* rack, uint64_t since,
                         void (*tell)(void* user, uint64_t number, int64_t at_100ps, const char* card, int code,
                                      const char* sentence),
                         void* user);

/* Calls `call` once per condition, in order, at its instant (in mr_run_program and mr_home at most 50 ms later), with
 * the arguments of mr_conditions. Of more than 4096 conditions at one instant, the excess is dropped. During the call
 * virtual time is the instant of the condition: values read are those of that instant, and actions (force a wire,
 * inject a fault, start a recording) take effect then. Conditions caused by mr_read, mr_write, mr_frame_wait,
 * mr_wire_set, mr_part_set and mr_fault are reported before these return. The call-back itself does not change the
 * course of the rack. NULL: ends the calls. MR_BAD_CALL, MR_INTERNAL. */
MR_API int mr_on_condition(mr_rack* rack,
                           void (*call)(void* user, uint64_t number, int64_t at_100ps, const char* card, int code,
                                        const char* sentence),
                           void* user);

/* ---- Recordings ---- */

/* Starts to record signals into a file: *.vcd (for GTKWave, PulseView, sigrok-cli), *.csv (time_s, signal, value: one
 * line per change) or *.h5 (HDF5, see the page of recordings: wires/X/step/time and value). Levels are 0 and 1,
 * voltages are in V, counters and bus words are numbers. `signals`: patterns with * and ?, separated by blanks or
 * commas ("X.* c1.xlmtp"); NULL or "": every wire, the pulses of each axis (X.step, X.dir), its encoder tracks
 * (X.enc_a, X.enc_b) and, once per millisecond, the card's counters (c1.xlp, c1.xep). On-demand pins of a card (c1.xpp)
 * are recorded if a pattern names them. Only one recording runs at a time; one that mr_trace_stop could not end is
 * discarded for the new one. MR_BAD_CALL (null, no signal matches), MR_REFUSED (another file ending; a recording runs),
 * MR_IO. */
MR_API int mr_trace_start(mr_rack* rack, const char* path, const char* signals);

/* Sets the time unit of VCD files that are started from now on: a power of ten from 0.1 ns to 1 s. 0 (default): the
 * coarsest unit, at most 100 ns, that shows every edge of cards and parts; wires that you force at shorter intervals
 * need a finer unit. sigrok-cli makes one sample per unit: read files of a fine unit with -I vcd:downsample=N.
 * MR_BAD_CALL, MR_REFUSED (another unit). */
MR_API int mr_trace_unit(mr_rack* rack, double ns);

/* Ends the recording and completes its file. MR_BAD_CALL, MR_REFUSED (no recording runs), MR_IO (the file could not be
 * written completely: the recording continues; free disk space and call again, or start another recording. A file of
 * which changes are missing, and any *.h5 file, is lost then: start another). */
MR_API int mr_trace_stop(mr_rack* rack);

#ifdef __cplusplus
}
#endif

#endif
