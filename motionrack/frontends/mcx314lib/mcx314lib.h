/* The function library of the MCX314 four-axis pulse chip for C: the names and argument lists of the library's source,
 * and calls of our own (mcx314_..) for what the source names without listing it, for several chips, errors and time.
 *
 * Link with libmcx314lib.so (-lmcx314lib), on Windows with mcx314lib.dll. A program that moves axis X by 1000 pulses
 * and tells where it is:
 *
 *     SetRange(800000);                 // all axes: speeds in units of 10 pulses a second
 *     TCurve_F(1, 100, 4000, 400, 1000);
 *     mcx314_wait(1, 10000);            // until it stands, 10 s at most
 *     printf("%d\n", (int)ReadLPS(1));
 *
 * It runs on a card of the rack file that the environment variable MOTIONRACK_RACK names:
 *
 *     MOTIONRACK_RACK=machine.toml ./program
 *
 * or on a real card, in Linux:
 *
 *     MOTIONRACK_RACK=port:/dev/port,offset=0x300,width=8 ./program
 *
 * Windows. Of a rack file the library there takes the cards alone; a real card is reached by a driver of others:
 *
 *     set MOTIONRACK_RACK=card.c1 = "mcx314"
 *     set MOTIONRACK_RACK=port:inpoutx64.dll,offset=0x300,width=8
 *
 * Chips. The first function opens the first mcx314 card of that rack file, unless mcx314_open() was called before. All
 * functions work on the selected chip: the one opened last, or that of mcx314_select().
 *
 * Axes. `axis` is a mask: X 1, Y 2, Z 4, U 8 and their sums. Functions that read one axis take one of 1, 2, 4, 8.
 *
 * Units. Those of the registers. With the multiple M = 8,000,000 / R: speeds V and SV are in M pulses a second,
 * accelerations A and D in 125 M pulses/s2, the jerk is 62,500,000 / K M pulses/s3.
 *
 * Errors. The source's functions return nothing. A call that is out of range, or not possible now, is refused: nothing
 * is written, mcx314_last_error() has the sentence (kept for each thread), and the handler of mcx314_on_error() is
 * called, in the place of the source's message boxes. Functions of our own also return -1.
 *
 * Time. On a real card it is the computer's. On a virtual card time passes while functions run (each access of a
 * register takes the bus its time), in mcx314_wait() and in mcx314_advance_ms(); nowhere else. A loop that polls
 * ReadCV() or ReadLPS() therefore comes to an end. HomeType1 to HomeType4, mcx314_contour_.. and mcx314_pattern_.. wait
 * inside; no other function does.
 *
 * Threads. Functions may be called from any thread; a call waits until another one has ended. Chips and the selection
 * are those of the process.
 */
#ifndef MCX314LIB_H
#define MCX314LIB_H

#include <stdint.h>

#if defined(__GNUC__) && !defined(_WIN32)
#define MCX314_API __attribute__((visibility("default")))
#else
#define MCX314_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Initial ---- */

/* Pulse output: 0 two pulse trains, 1 pulse and direction. Refused while an axis of the mask drives. */
MCX314_API void SetPulseMode(int axis, int mode);

/* The multiple M, 1 .. 500; R = 8,000,000 / M, cut to a whole number. Refused while an axis of the mask drives. A
 * multiple must be set before the first drive, by one of these three. */
MCX314_API void SetMultiple(int axis, int data);

/* R of all axes, 8,000,000 .. 16,000. Refused while an axis drives. */
MCX314_API void SetRange(int data);

/* The smallest whole multiple, for all axes, with which V <= 8,000 reaches this speed: 1 .. 4,000,000 pulses a second.
 */
MCX314_API void SetMaxSpeed(int data);

/* ---- Basic motion ---- */

/* Initial speed, drive speed, acceleration, deceleration: 1 .. 8,000. V acts also while driving. Decelerations take A
 * until D was set, and again after mcx314_asymmetric(axis, 0). */
MCX314_API void SetSV(int axis, int data);
MCX314_API void SetV(int axis, int data);
MCX314_API void SetA(int axis, int data);
MCX314_API void SetD(int axis, int data);

/* K, the acceleration's rate: 1 .. 65,535. */
MCX314_API void SetAA(int axis, int data);

/* Pulses reserved for the end at SV: 0 .. 65,535. Where it was not called since the reset, each drive has what it needs
 * to end at SV. */
MCX314_API void SetAO(int axis, int data);

/* Output pulses of a fixed drive: -268,435,455 .. 268,435,455, the sign is the direction. */
MCX314_API void Pulse(int axis, int data);

/* The chip finds the deceleration of all axes itself. */
MCX314_API void AutoDec(void);

/* Sets the pulses after which fixed drives decelerate: 0 .. 268,435,455. The source has both names. */
MCX314_API void ManualDec(int axis, int DecPulse);
MCX314_API void ManDec(int axis, int DecPulse);

/* Fixed drives, with T-curve and with S-curve; pulses as in Pulse(). Refused while an axis of the mask drives. */
MCX314_API void TCurve_F(int axis, int m_SV, int m_V, int m_A, int m_Pulse);
MCX314_API void SCurve_F(int axis, int m_SV, int m_V, int m_A, int m_K, int m_Pulse);

/* Continuous drives in + direction, until mcx314_stop() or a stop input. Refused while an axis of the mask drives. */
MCX314_API void TCurve_C(int axis, int m_SV, int m_V, int m_A);
MCX314_API void SCurve_C(int axis, int m_SV, int m_V, int m_A, int m_K);

/* ---- Interpolation ---- */

/* A line. The source names the structure without listing it. */
typedef struct LINEDATA {
    int SV;   /* initial speed, 1 .. 8,000; not used by Line.._C */
    int V;    /* drive speed of the longest axis, 1 .. 8,000 */
    int A;    /* acceleration, 1 .. 8,000; not used by Line.._C */
    int D;    /* deceleration, 1 .. 8,000; 0: as A */
    int K;    /* 1 .. 65,535; Line.._S only */
    int P[4]; /* finish point of X, Y, Z, U relative to the start, -8,388,608 .. 8,388,607; all 0: that of SetFP() */
} LINEDATA;

/* An arc of two axes, which begins where they stand; LPS() gives that place its numbers. The first of them (X before Y
 * before Z before U) points right, the second up. */
typedef struct CIRCLEDATA {
    int SV;   /* initial speed, 1 .. 8,000; not used by Circle.._C */
    int V;    /* speed of the axis that steps regularly, 1 .. 8,000 */
    int A;    /* acceleration, 1 .. 8,000; not used by Circle.._C */
    int D;    /* deceleration, 1 .. 8,000; 0: as A */
    int P[4]; /* finish point relative to the start; 0, 0: a full circle */
    int C[4]; /* centre relative to the start; 0, 0: centre and finish are those of SetCP() and SetFP() */
} CIRCLEDATA;

/* Lines of two axes (masks 3, 5, 9, 6, 10, 12) and of three (7, 11, 13, 14): constant speed, T-curve, S-curve. */
MCX314_API void Line2D_C(LINEDATA* pLD, int axis);
MCX314_API void Line3D_C(LINEDATA* pLD, int axis);
MCX314_API void Line2D_T(LINEDATA* pLD, int axis);
MCX314_API void Line3D_T(LINEDATA* pLD, int axis);
MCX314_API void Line2D_S(LINEDATA* pLD, int axis);
MCX314_API void Line3D_S(LINEDATA* pLD, int axis);

/* Arcs of two axes: constant speed, T-curve. The T-curve decelerates at the point of ManualDec() of the first axis if
 * that is in force, else at one that is computed. Refused where the finish point is beside the circle by more than 1 %
 * of the radius (at least 3 pulses). */
MCX314_API void CircleCW_C(CIRCLEDATA* pCD, int axis);
MCX314_API void CircleCCW_C(CIRCLEDATA* pCD, int axis);
MCX314_API void CircleCW_T(CIRCLEDATA* pCD, int axis);
MCX314_API void CircleCCW_T(CIRCLEDATA* pCD, int axis);

/* Centre of arcs and finish point of lines and arcs for structures that have none, relative to the start:
 * -8,388,608 .. 8,388,607. The source has both names of each. */
MCX314_API void SetCP(int axis, int data);
MCX314_API void SetC(int axis, int data);
MCX314_API void SetFP(int axis, int data);
MCX314_API void SetP(int axis, int data);

/* ---- Signals ---- */

/* The limit switches in + and in - direction act at: 0 Low, 1 High. */
MCX314_API void HLMTP(int n, int axis);
MCX314_API void HLMTM(int n, int axis);

/* Limit switches stop: 0 at once, 1 decelerating. */
MCX314_API void HLMTSig(int n, int axis);

/* Software limits of all axes at COMP+ and COMP-: 0 off, 1 on. (The source tells levels; COMP has none.) */
MCX314_API void SLMTP(int n);
MCX314_API void SLMTM(int n);

/* COMP+ and COMP- of all axes are compared with: 0 the logical position, 1 the real position. */
MCX314_API void SLMTSig(int n);

/* Encoder inputs: 0 quadrature A/B, 1 up and down pulses. */
MCX314_API void EncoderMode(int n, int axis);

/* Edges of A/B counted: 0 all, 1 every second, 2 every fourth. */
MCX314_API void EncoderCWCCW(int n, int axis);

/* Alarm and in-position inputs of all axes: 0 off, 1 on. */
MCX314_API void EnableALM(int n);
MCX314_API void EnableInPos(int n);

/* Alarm and in-position act at: 0 Low, 1 High. */
MCX314_API void ALMSig(int n, int axis);
MCX314_API void InPosSig(int n, int axis);

/* ---- Home ---- */

/* Search the home switch in - direction and wait until that has ended; LP and EP are 0 at home. WR1Reg is WR1 with the
 * home switch enabled at its level: IN0 .. IN3. In types 3 and 4 the encoder's index Z is at IN2, at its level; where
 * IN2 alone is enabled, it is the home switch, and Z is at IN3. 1 decelerates at the switch; 2 then goes back at SV and
 * again, at half of SV, to the switch; 3 decelerates at the switch and goes on to Z at SV; 4 decelerates, goes on to Z
 * at half of SV, and then does as 2. The axes, which the source leaves open, are those of mcx314_home_axes(). */
MCX314_API void HomeType1(int WR1Reg, int SV, int V, int A);
MCX314_API void HomeType2(int WR1Reg, int SV, int V, int A);
MCX314_API void HomeType3(int WR1Reg, int SV, int V, int A);
MCX314_API void HomeType4(int WR1Reg, int SV, int V, int A);

/* The axes that HomeType1 to HomeType4 home, all at once; X at first. */
MCX314_API int mcx314_home_axes(int axis);

/* ---- Positions ---- */

/* Sets the logical position LP and the real (encoder) position EP: 32 bits, negative ones as two's complement. */
MCX314_API void LPS(int axis, unsigned data);
MCX314_API void EPS(int axis, unsigned data);

/* Positions of one axis: cast them to int. 0 if refused. */
MCX314_API unsigned ReadLPS(int axis);
MCX314_API unsigned ReadEPS(int axis);

/* Present speed of one axis (V units, 0 at rest), and acceleration (A units, at constant speed the last one). */
MCX314_API unsigned ReadCV(int axis);
MCX314_API unsigned ReadCA(int axis);

/* COMP+ and COMP-, the software limits: 32 bits with sign. */
MCX314_API void SetCompP(int axis, int data);
MCX314_API void SetCompM(int axis, int data);

/* Resets the chip; all registers and the multiple have to be set again. */
MCX314_API void RESET(void);

/* ---- Chips ---- */

/* Opens a card of a rack and selects it. `rack`: path of a rack file or the text of one ("card.c1 = \"mcx314\""), which
 * is then a world of its own with a time of its own; NULL: the rack of the selected chip. `card`: its name; NULL: the
 * rack's first mcx314 card that is not open. Or a real card: `rack` is uio:PATH, memory:PATH or port:PATH, and after it
 * ,offset=N ,stride=N ,width=8 ,map=N ,interrupt=PATH ,gap_ns=N as it needs them; `card` is NULL then, and time is the
 * computer's; refused where a program of motionrack has it open already (Linux), or no card answers (all reads FFFFh).
 * A card that answers no more makes each later call an error. Returns the chip's handle, 1 or greater, or -1. */
MCX314_API int mcx314_open(const char* rack, const char* card);

/* The functions that follow work on this chip. */
MCX314_API int mcx314_select(int handle);

/* Closes a chip; its rack ends with its last chip. If it was the selected one, select another. Axes of a real card
 * drive on: stop them first. */
MCX314_API int mcx314_close(int handle);

/* ---- Errors ---- */

/* The sentence of the last error in this thread, "" if there was none since mcx314_clear_error(). Valid until the next
 * error in this thread. */
MCX314_API const char* mcx314_last_error(void);

MCX314_API void mcx314_clear_error(void);

/* From here on every error calls this function with its sentence and `user`; NULL: none. It may call this library. */
MCX314_API void mcx314_on_error(void (*handler)(const char* sentence, void* user), void* user);

/* ---- Time ---- */

/* Waits until none of the axes drives, at most `milliseconds`. Returns 0 if they stopped as commanded; -1 after
 * the time, or if a limit, an alarm or the emergency stop ended a drive. */
MCX314_API int mcx314_wait(int axis, int milliseconds);

/* Lets the world run for 0 .. 2,147,483,647 ms. */
MCX314_API int mcx314_advance_ms(int milliseconds);

/* The selected chip's time in microseconds since its rack was opened; -1 if there is none. */
MCX314_API int64_t mcx314_now_us(void);

/* ---- Axis status ---- */

/* Those of the axes that drive, as a mask; 0: none. */
MCX314_API int mcx314_moving(int axis);

/* Those of the axes that are at a limit switch or beyond a software limit, or were stopped there, as a mask. */
MCX314_API int mcx314_at_limit(int axis);

/* A line for each axis: whether it drives, where it is, why it stopped and what to do next. "" if refused. Valid until
 * the next call in this thread. */
MCX314_API const char* mcx314_report(int axis);

/* ---- Stops, ramps, outputs ---- */

/* Stops the axes, with everything that is interpolated with them: decelerating, or at once. */
MCX314_API int mcx314_stop(int axis);
MCX314_API int mcx314_stop_now(int axis);

/* Decelerations use D instead of A: 0 off, 1 on. */
MCX314_API int mcx314_asymmetric(int axis, int on);

/* Level, 0 or 1, of the general outputs OUT0 .. OUT7 of the axes: servo on, brakes. */
MCX314_API int mcx314_set_output(int axis, int output, int level);

/* ---- Plans ---- */

/* What a fixed drive will do, exact to the chip's clock. */
typedef struct MCX314_PLAN {
    double seconds; /* from the command to the last pulse */
    double top_hz;  /* maximum speed, pulses per second */
    double end_hz;  /* the speed at the last pulse; above SV where the way is too short for ramps */
    int dec_point;  /* pulses after which the speed falls */
    int offset;     /* AO with which it does; not used after ManualDec() and where D is another than A */
} MCX314_PLAN;

/* Plans TCurve_F (K 0) or SCurve_F with these numbers for one axis, as it is set; nothing is moved or written. */
MCX314_API int mcx314_plan(int axis, int SV, int V, int A, int K, int pulses, MCX314_PLAN* plan);

/* ---- Manual operation ---- */

/* Jogs one axis at V, the sign is the direction; 0 stops. Jogs for 250 ms: call it again before, with the same
 * speed or another. A reversal decelerates to a stop first. SV and A are those of the first call. */
MCX314_API int mcx314_jog(int axis, int SV, int V, int A);

/* Moves by `pulses` (signed) at V. */
MCX314_API int mcx314_jog_step(int axis, int SV, int V, int A, int pulses);

/* Homes one axis as HomeType1 .. 4 (type 1 .. 4), but does not wait: it runs for 250 ms; call it again before. */
MCX314_API int mcx314_jog_home(int axis, int type, int WR1Reg, int SV, int V, int A);

/* ---- Interrupts ---- */

/* Causes, bits of RR3. */
enum mcx314_cause {
    MCX314_PULSE = 0x01,          /* each pulse */
    MCX314_ABOVE_COMPM = 0x02,    /* position at or above COMP- */
    MCX314_BELOW_COMPM = 0x04,    /* below COMP- */
    MCX314_BELOW_COMPP = 0x08,    /* below COMP+ */
    MCX314_ABOVE_COMPP = 0x10,    /* at or above COMP+ */
    MCX314_CONSTANT_END = 0x20,   /* constant speed has ended */
    MCX314_CONSTANT_START = 0x40, /* constant speed has begun */
    MCX314_DRIVE_END = 0x80       /* the drive has ended */
};

/* Enables causes (a sum) and disables them. */
MCX314_API int mcx314_enable_interrupt(int axis, int causes);
MCX314_API int mcx314_disable_interrupt(int axis, int causes);

/* The causes that came for one axis since the last call; they are cleared. */
MCX314_API int mcx314_read_interrupt(int axis);

/* ---- Continuous interpolation ---- */

/* Speeds of a contour. */
typedef struct MCX314_CONTOUR {
    int SV; /* initial and final speed; not used without A */
    int V;  /* drive speed, 1 .. 8,000, at most 2,000,000 pulses a second */
    int A;  /* acceleration, 1 .. 8,000; 0: constant speed V from the first pulse to the last */
    int D;  /* deceleration at the end; 0: as A */
} MCX314_CONTOUR;

/* mcx314_contour_begin(), then lines and arcs as often as wanted, then mcx314_contour_end(), which waits for the end. P
 * and C (of X, Y, Z, U) are relative to the segment's start. V: speed from this segment on, 0: unchanged. */
MCX314_API int mcx314_contour_begin(const MCX314_CONTOUR* data);
MCX314_API int mcx314_contour_line(int axis, const int P[4], int V);
MCX314_API int mcx314_contour_arc(int axis, const int P[4], const int C[4], int clockwise, int V);
MCX314_API int mcx314_contour_end(void);

/* ---- Bit patterns ---- */

/* Speeds of a bit-pattern drive. */
typedef struct MCX314_PATTERN {
    int SV;       /* initial speed; not used without A */
    int V;        /* drive speed, 1 .. 8,000: steps of the pattern a second, times the multiple */
    int A;        /* acceleration and deceleration, 1 .. 8,000; 0: constant speed V */
    int DecPoint; /* steps of the pattern after which it decelerates; used with A */
} MCX314_PATTERN;

/* Sixteen steps of each axis, in the order X, Y, Z, U of those that take part, the lowest bit first: a 1 in `plus`
 * steps in
 * + direction, in `minus` in - direction, in both: the drive ends here. */
typedef struct MCX314_STEPS {
    unsigned plus[3];
    unsigned minus[3];
} MCX314_STEPS;

/* mcx314_pattern_begin() with two or three axes, up to three mcx314_pattern_steps(), mcx314_pattern_start(), more steps
 * while it runs (they wait for room), mcx314_pattern_end(), which waits for the end. */
MCX314_API int mcx314_pattern_begin(const MCX314_PATTERN* data, int axis);
MCX314_API int mcx314_pattern_steps(const MCX314_STEPS* steps);
MCX314_API int mcx314_pattern_start(void);
MCX314_API int mcx314_pattern_end(void);

/* ---- The virtual card ---- */

/* A register or value of the selected card by its name ("RR0", "x.WR2", "x.LP"), without effects and taking no time. */
MCX314_API int mcx314_peek(const char* name, int64_t* value);

/* Drives a wire of the rack ("motion.xlmtp", "X.home") from outside, 0 or 1, until it is released: NAN. */
MCX314_API int mcx314_set_wire(const char* wire, double value);

#ifdef __cplusplus
}
#endif

#endif
