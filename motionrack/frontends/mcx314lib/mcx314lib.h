/* The function library of the MCX314 four-axis pulse chip for C: the names and argument lists of the library's source,
 * and further calls (mcx314_..) for functions that the source names but does not list, for several chips, errors and
 * time.
 *
 * Link with libmcx314lib.so (-lmcx314lib), on Windows with mcx314lib.dll. A program that moves axis X by 1000 pulses
 * and prints its position:
 *
 *     SetRange(800000);                 // all axes: speeds in units of 10 pulses per second
 *     TCurve_F(1, 100, 4000, 400, 1000);
 *     mcx314_wait(1, 10000);            // until standstill, at most 10 s
 *     printf("%d\n", (int)ReadLPS(1));
 *
 * The environment variable MOTIONRACK_RACK selects the card: a rack file,
 *
 *     MOTIONRACK_RACK=machine.toml ./program
 *
 * or a real card, on Linux:
 *
 *     MOTIONRACK_RACK=port:/dev/port,offset=0x300,width=8 ./program
 *
 * Windows. The library uses only the cards of a rack file; a real card needs a third-party port driver:
 *
 *     set MOTIONRACK_RACK=card.c1 = "mcx314"
 *     set MOTIONRACK_RACK=port:inpoutx64.dll,offset=0x300,width=8
 *
 * Chips. The first call of a function opens the first mcx314 card of that rack file, unless mcx314_open() was called
 * before. All functions apply to the selected chip: the chip opened last, or that of mcx314_select().
 *
 * Axes. `axis` is a mask: X 1, Y 2, Z 4, U 8 and their sums. Functions that read one axis accept only 1, 2, 4 or 8.
 *
 * Units. Those of the registers. With the multiple M = 8,000,000 / R, speeds V and SV are in M pulses/s, accelerations
 * A and D in 125 M pulses/s2, and the jerk is 62,500,000 / K M pulses/s3.
 *
 * Errors. The source's functions return nothing. A call that is out of range, or not possible at present, is refused:
 * it writes nothing, sets the sentence of mcx314_last_error() (per thread), and calls the handler of mcx314_on_error(),
 * which replaces the source's message boxes. The functions mcx314_.. also return -1.
 *
 * Time. A real card has the computer's time. The time of a virtual card advances in mcx314_wait(), in
 * mcx314_advance_ms(), and by the bus time of each register access, so that a loop that polls ReadCV() or ReadLPS()
 * ends. HomeType1 to HomeType4, mcx314_contour_.. and mcx314_pattern_.. block until their end or until the chip has
 * room; no other function blocks.
 *
 * Threads. Functions may be called from any thread; concurrent calls are serialised. Chips and the selection belong to
 * the process.
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

/* Sets the pulse output: 0 two pulse trains, 1 pulse and direction. Refused while an axis of the mask drives. */
MCX314_API void SetPulseMode(int axis, int mode);

/* Sets the multiple M, 1 .. 500; R = 8,000,000 / M, rounded down. Refused while an axis of the mask drives. This
 * function, SetRange or SetMaxSpeed must set a multiple before the first drive. */
MCX314_API void SetMultiple(int axis, int data);

/* Sets R of all axes, 8,000,000 .. 16,000. Refused while an axis drives. */
MCX314_API void SetRange(int data);

/* Sets, for all axes, the lowest whole multiple with which V <= 8,000 reaches this speed: 1 .. 4,000,000 pulses/s. */
MCX314_API void SetMaxSpeed(int data);

/* ---- Basic motion ---- */

/* Set initial speed, drive speed, acceleration, deceleration: 1 .. 8,000. V also takes effect while driving.
 * Decelerations use A until D is set, and again after mcx314_asymmetric(axis, 0). */
MCX314_API void SetSV(int axis, int data);
MCX314_API void SetV(int axis, int data);
MCX314_API void SetA(int axis, int data);
MCX314_API void SetD(int axis, int data);

/* Sets K, the acceleration rate: 1 .. 65,535. */
MCX314_API void SetAA(int axis, int data);

/* Sets AO, the pulses reserved for the end at SV: 0 .. 65,535. By default the library computes it for each drive. */
MCX314_API void SetAO(int axis, int data);

/* Sets the output pulses of a fixed drive: -268,435,455 .. 268,435,455; the sign is the direction. */
MCX314_API void Pulse(int axis, int data);

/* Makes the chip compute the deceleration point of all axes. */
MCX314_API void AutoDec(void);

/* Set the pulses after which fixed drives decelerate: 0 .. 268,435,455. The source has both names. */
MCX314_API void ManualDec(int axis, int DecPulse);
MCX314_API void ManDec(int axis, int DecPulse);

/* Start fixed drives, with T-curve and with S-curve; pulses as in Pulse(). Refused while an axis of the mask drives. */
MCX314_API void TCurve_F(int axis, int m_SV, int m_V, int m_A, int m_Pulse);
MCX314_API void SCurve_F(int axis, int m_SV, int m_V, int m_A, int m_K, int m_Pulse);

/* Start continuous drives in + direction, until mcx314_stop() or a stop input. Refused while an axis of the mask
 * drives.
 */
MCX314_API void TCurve_C(int axis, int m_SV, int m_V, int m_A);
MCX314_API void SCurve_C(int axis, int m_SV, int m_V, int m_A, int m_K);

/* ---- Interpolation ---- */

/* Data of a line. The source names the structure but does not list it. */
typedef struct LINEDATA {
    int SV;   /* initial speed, 1 .. 8,000; not used by Line.._C */
    int V;    /* drive speed of the longest axis, 1 .. 8,000 */
    int A;    /* acceleration, 1 .. 8,000; not used by Line.._C */
    int D;    /* deceleration, 1 .. 8,000; 0: as A */
    int K;    /* 1 .. 65,535; Line.._S only */
    int P[4]; /* finish point of X, Y, Z, U relative to the start, -8,388,608 .. 8,388,607; all 0: that of SetFP() */
} LINEDATA;

/* Data of an arc of two axes, which starts at their present positions (see LPS()). The first axis (X before Y before Z
 * before U) points right, the second up. */
typedef struct CIRCLEDATA {
    int SV;   /* initial speed, 1 .. 8,000; not used by Circle.._C */
    int V;    /* speed of the axis that steps regularly, 1 .. 8,000 */
    int A;    /* acceleration, 1 .. 8,000; not used by Circle.._C */
    int D;    /* deceleration, 1 .. 8,000; 0: as A */
    int P[4]; /* finish point relative to the start; 0, 0: a full circle */
    int C[4]; /* centre relative to the start; 0, 0: centre and finish are those of SetCP() and SetFP() */
} CIRCLEDATA;

/* Start lines of two axes (masks 3, 5, 9, 6, 10, 12) and of three (7, 11, 13, 14): constant speed, T-curve, S-curve. */
MCX314_API void Line2D_C(LINEDATA* pLD, int axis);
MCX314_API void Line3D_C(LINEDATA* pLD, int axis);
MCX314_API void Line2D_T(LINEDATA* pLD, int axis);
MCX314_API void Line3D_T(LINEDATA* pLD, int axis);
MCX314_API void Line2D_S(LINEDATA* pLD, int axis);
MCX314_API void Line3D_S(LINEDATA* pLD, int axis);

/* Start arcs of two axes: constant speed, T-curve. The T-curve decelerates at the point of ManualDec() of the first
 * axis if that applies, else at a computed point. Refused if the finish point is off the circle by more than 1 % of the
 * radius (at least 3 pulses). */
MCX314_API void CircleCW_C(CIRCLEDATA* pCD, int axis);
MCX314_API void CircleCCW_C(CIRCLEDATA* pCD, int axis);
MCX314_API void CircleCW_T(CIRCLEDATA* pCD, int axis);
MCX314_API void CircleCCW_T(CIRCLEDATA* pCD, int axis);

/* Set the centre of arcs and the finish point of lines and arcs for structures without them, relative to the start:
 * -8,388,608 .. 8,388,607. The source has both names of each. */
MCX314_API void SetCP(int axis, int data);
MCX314_API void SetC(int axis, int data);
MCX314_API void SetFP(int axis, int data);
MCX314_API void SetP(int axis, int data);

/* ---- Signals ---- */

/* Set the active level of the limit switches in + and in - direction: 0 Low, 1 High. */
MCX314_API void HLMTP(int n, int axis);
MCX314_API void HLMTM(int n, int axis);

/* Sets how limit switches stop: 0 immediately, 1 with deceleration. */
MCX314_API void HLMTSig(int n, int axis);

/* Switch the software limits of all axes at COMP+ and COMP-: 0 off, 1 on. (The source describes levels; COMP has none.)
 */
MCX314_API void SLMTP(int n);
MCX314_API void SLMTM(int n);

/* Sets the position that COMP+ and COMP- of all axes are compared with: 0 logical, 1 real. */
MCX314_API void SLMTSig(int n);

/* Sets the encoder inputs: 0 quadrature A/B, 1 up and down pulses. */
MCX314_API void EncoderMode(int n, int axis);

/* Sets the counted edges of A/B: 0 all, 1 every second, 2 every fourth. */
MCX314_API void EncoderCWCCW(int n, int axis);

/* Switch the alarm and the in-position inputs of all axes: 0 off, 1 on. */
MCX314_API void EnableALM(int n);
MCX314_API void EnableInPos(int n);

/* Set the active level of alarm and in-position: 0 Low, 1 High. */
MCX314_API void ALMSig(int n, int axis);
MCX314_API void InPosSig(int n, int axis);

/* ---- Home ---- */

/* Search the home switch in - direction and block until the end of the search; LP and EP are 0 at home. WR1Reg is WR1
 * with the home switch enabled at its level: IN0 .. IN3. In types 3 and 4 the encoder's index Z is at IN2, at its
 * level; if only IN2 is enabled, it is the home switch, and Z is at IN3. Type 1 decelerates at the switch. Type 2 then
 * moves back at SV, and to the switch again at half of SV. Type 3 decelerates at the switch and continues to Z at SV.
 * Type 4 decelerates, continues to Z at half of SV, and then does as type 2. The axes, which the source leaves open,
 * are those of mcx314_home_axes(). */
MCX314_API void HomeType1(int WR1Reg, int SV, int V, int A);
MCX314_API void HomeType2(int WR1Reg, int SV, int V, int A);
MCX314_API void HomeType3(int WR1Reg, int SV, int V, int A);
MCX314_API void HomeType4(int WR1Reg, int SV, int V, int A);

/* Sets the axes that HomeType1 to HomeType4 home, all at the same time; initially X. */
MCX314_API int mcx314_home_axes(int axis);

/* ---- Positions ---- */

/* Set the logical position LP and the real (encoder) position EP: 32 bits, two's complement. */
MCX314_API void LPS(int axis, unsigned data);
MCX314_API void EPS(int axis, unsigned data);

/* Return the positions of one axis; cast them to int. 0 if refused. */
MCX314_API unsigned ReadLPS(int axis);
MCX314_API unsigned ReadEPS(int axis);

/* Return the present speed of one axis (V units, 0 at standstill) and its acceleration (A units; at constant speed the
 * last one). */
MCX314_API unsigned ReadCV(int axis);
MCX314_API unsigned ReadCA(int axis);

/* Set COMP+ and COMP-, the software limits: 32 bits, signed. */
MCX314_API void SetCompP(int axis, int data);
MCX314_API void SetCompM(int axis, int data);

/* Resets the chip; all registers and the multiple must be set again. */
MCX314_API void RESET(void);

/* ---- Chips ---- */

/* Opens a card and selects it. A virtual card: `rack` is the path of a rack file or its text ("card.c1 = \"mcx314\""),
 * an independent rack with its own clock; NULL: the rack of the selected chip. `card` is its name; NULL: the first
 * mcx314 card of the rack that is not open. A real card: `rack` is uio:PATH, memory:PATH or port:PATH, followed by
 * ,offset=N ,stride=N ,width=8 ,map=N ,interrupt=PATH ,gap_ns=N as needed; `card` is NULL, and time is the computer's.
 * Refused if a program of motionrack has the card open (Linux), or if no card answers (all reads FFFFh). After a card
 * stops responding, every later call fails. Returns the chip's handle, 1 or greater, or -1. */
MCX314_API int mcx314_open(const char* rack, const char* card);

/* Selects the chip for all further calls. */
MCX314_API int mcx314_select(int handle);

/* Closes a chip; the last chip of a rack also closes the rack. If the chip was selected, select another one. Axes of a
 * real card continue to drive: stop them first. */
MCX314_API int mcx314_close(int handle);

/* ---- Errors ---- */

/* Returns the sentence of the last error in this thread since mcx314_clear_error(), or "". Valid until the next error
 * in this thread. */
MCX314_API const char* mcx314_last_error(void);

MCX314_API void mcx314_clear_error(void);

/* Sets the function that every error calls with its sentence and `user`; NULL: none. It may call this library. */
MCX314_API void mcx314_on_error(void (*handler)(const char* sentence, void* user), void* user);

/* ---- Time ---- */

/* Waits until none of the axes drives, at most `milliseconds`. Returns 0 if they stopped as commanded; -1 after a
 * time-out, or if a limit, an alarm or the emergency stop ended a drive. */
MCX314_API int mcx314_wait(int axis, int milliseconds);

/* Advances virtual time by 0 .. 2,147,483,647 ms. */
MCX314_API int mcx314_advance_ms(int milliseconds);

/* Returns the selected chip's time in microseconds since its rack was opened; -1 without a chip. */
MCX314_API int64_t mcx314_now_us(void);

/* ---- Axis status ---- */

/* Mask of the driving axes; 0: none. */
MCX314_API int mcx314_moving(int axis);

/* Mask of the axes that are at a limit switch or beyond a software limit, or were stopped there. */
MCX314_API int mcx314_at_limit(int axis);

/* Returns one line per axis: whether it drives, its position, the cause of its stop and the remedy. "" if refused.
 * Valid until the next call in this thread. */
MCX314_API const char* mcx314_report(int axis);

/* ---- Stops, ramps, outputs ---- */

/* Stop the axes and all axes interpolated with them: with deceleration, or immediately. */
MCX314_API int mcx314_stop(int axis);
MCX314_API int mcx314_stop_now(int axis);

/* Makes decelerations use D instead of A: 0 off, 1 on. */
MCX314_API int mcx314_asymmetric(int axis, int on);

/* Sets the level, 0 or 1, of a general output OUT0 .. OUT7 of the axes: servo on, brakes. */
MCX314_API int mcx314_set_output(int axis, int output, int level);

/* ---- Plans ---- */

/* Motion of a fixed drive, exact to the chip's clock. */
typedef struct MCX314_PLAN {
    double seconds; /* time from the command to the last pulse */
    double top_hz;  /* maximum speed, pulses/s */
    double end_hz;  /* speed at the last pulse; above SV if the distance is too short for the ramps */
    int dec_point;  /* pulses after which the drive decelerates */
    int offset;     /* AO of that deceleration; not used after ManualDec() or if D differs from A */
} MCX314_PLAN;

/* Plans TCurve_F (K 0) or SCurve_F with these values and the present settings of one axis; moves and writes nothing. */
MCX314_API int mcx314_plan(int axis, int SV, int V, int A, int K, int pulses, MCX314_PLAN* plan);

/* ---- Manual operation ---- */

/* Jogs one axis at V; the sign is the direction; 0 stops. A jog lasts 250 ms: renew it by another call, with the same
 * or another speed. A reversal decelerates to a stop first. SV and A of the first call apply. */
MCX314_API int mcx314_jog(int axis, int SV, int V, int A);

/* Moves by `pulses` (signed) at V. */
MCX314_API int mcx314_jog_step(int axis, int SV, int V, int A, int pulses);

/* Homes one axis as HomeType1 .. 4 (type 1 .. 4) without blocking: the search lasts 250 ms; renew it by another
 * call. */
MCX314_API int mcx314_jog_home(int axis, int type, int WR1Reg, int SV, int V, int A);

/* ---- Interrupts ---- */

/* Causes, bits of RR3. */
enum mcx314_cause {
    MCX314_PULSE = 0x01,          /* each pulse */
    MCX314_ABOVE_COMPM = 0x02,    /* position at or above COMP- */
    MCX314_BELOW_COMPM = 0x04,    /* below COMP- */
    MCX314_BELOW_COMPP = 0x08,    /* below COMP+ */
    MCX314_ABOVE_COMPP = 0x10,    /* at or above COMP+ */
    MCX314_CONSTANT_END = 0x20,   /* end of constant speed */
    MCX314_CONSTANT_START = 0x40, /* start of constant speed */
    MCX314_DRIVE_END = 0x80       /* end of the drive */
};

/* Enable and disable causes (a sum). */
MCX314_API int mcx314_enable_interrupt(int axis, int causes);
MCX314_API int mcx314_disable_interrupt(int axis, int causes);

/* Pending causes of one axis; clears them. */
MCX314_API int mcx314_read_interrupt(int axis);

/* ---- Continuous interpolation ---- */

/* Speeds of a contour. */
typedef struct MCX314_CONTOUR {
    int SV; /* initial and final speed; not used without A */
    int V;  /* drive speed, 1 .. 8,000, at most 2,000,000 pulses/s */
    int A;  /* acceleration, 1 .. 8,000; 0: constant speed V from the first pulse to the last */
    int D;  /* deceleration at the end; 0: as A */
} MCX314_CONTOUR;

/* Execute a contour: mcx314_contour_begin(), any number of lines and arcs, mcx314_contour_end(), which waits for the
 * end. P and C (of X, Y, Z, U) are relative to the start of the segment. V: speed from this segment on; 0:
 * unchanged. */
MCX314_API int mcx314_contour_begin(const MCX314_CONTOUR* data);
MCX314_API int mcx314_contour_line(int axis, const int P[4], int V);
MCX314_API int mcx314_contour_arc(int axis, const int P[4], const int C[4], int clockwise, int V);
MCX314_API int mcx314_contour_end(void);

/* ---- Bit patterns ---- */

/* Speeds of a bit-pattern drive. */
typedef struct MCX314_PATTERN {
    int SV;       /* initial speed; not used without A */
    int V;        /* drive speed, 1 .. 8,000: pattern steps per second, times the multiple */
    int A;        /* acceleration and deceleration, 1 .. 8,000; 0: constant speed V */
    int DecPoint; /* pattern steps after which the drive decelerates; used with A */
} MCX314_PATTERN;

/* Sixteen steps of each participating axis, in the order X, Y, Z, U, lowest bit first: a 1 in `plus` is a step in +
 * direction, a 1 in `minus` a step in - direction, a 1 in both the end of the drive. */
typedef struct MCX314_STEPS {
    unsigned plus[3];
    unsigned minus[3];
} MCX314_STEPS;

/* Execute a pattern: mcx314_pattern_begin() with two or three axes, up to three mcx314_pattern_steps(),
 * mcx314_pattern_start(), more steps while it runs (they wait for room), mcx314_pattern_end(), which waits for the
 * end. */
MCX314_API int mcx314_pattern_begin(const MCX314_PATTERN* data, int axis);
MCX314_API int mcx314_pattern_steps(const MCX314_STEPS* steps);
MCX314_API int mcx314_pattern_start(void);
MCX314_API int mcx314_pattern_end(void);

/* ---- The virtual card ---- */

/* Reads a register or value of the selected card by its name ("RR0", "x.WR2", "x.LP"), without side effects; time does
 * not advance. */
MCX314_API int mcx314_peek(const char* name, int64_t* value);

/* Forces a wire of the rack ("motion.xlmtp", "X.home") to 0 or 1; NAN releases it. */
MCX314_API int mcx314_set_wire(const char* wire, double value);

#ifdef __cplusplus
}
#endif

#endif
