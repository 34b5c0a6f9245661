/* An 8-bit host that accesses a DataBoard 4002 port by port, and the routines of the manufacturer's two demonstration
 * programs as they are listed: in assembler for a Z80 at 4 MHz, and in BASIC.
 *
 *   program ── OUT port, IN port ──► mr_write8, mr_read8 ──► card c1 ──► pulses ──► an ideal motor ──► counter
 *           └─ the time an instruction takes ──► mr_advance_ns
 */
#ifndef MOTIONRACK_DATABOARD4002_HOST_H
#define MOTIONRACK_DATABOARD4002_HOST_H

#include <motionrack/c.h>
#include <stdio.h>
#include <string.h>

static int failures = 0;

#define CHECK(condition)                                                                  \
    do {                                                                                  \
        if (!(condition)) {                                                               \
            fprintf(stderr, "line %d: %s (%s)\n", __LINE__, #condition, mr_last_error()); \
            ++failures;                                                                   \
        }                                                                                 \
    } while (0)

/* Port numbers, bits of STAT and EVENT as named in both listings; times in ns. */
enum { DATA = 0, STAT = 1, CS = 1, C2 = 3, C3 = 4, C4 = 5, RST = 7, CARD = 13 };
enum { READY = 0x80, LEFT = 0x40, RIGHT = 0x20, EMERGENCY = 0x10, EVENT = 0x02, INTERRUPT = 0x01 };
enum { T_STATE = 250, BUS = 250, MS = 1000000 };

/* Time between two polls for an event, as a multiple of the listing's. AddressSanitizer slows each of the millions of
 * polls: with it, the program polls less often, and nothing else changes. */
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define LOOKS_APART 20
#endif
#endif
#ifndef LOOKS_APART
#define LOOKS_APART 1
#endif

typedef struct {
    uint64_t at_ns;
    const char* wire;
    double level;
} happening; /* external event during the program run */

typedef struct {
    mr_rack* rack;
    uint64_t max_wait_ns; /* longest wait for Ready */
    uint8_t tape[1024];   /* accesses to C2, C4 and DATA: the port, 40h added for IN, then the byte */
    unsigned taped;
    char said[256]; /* texts that the program displayed */
    int gave_up;    /* "unit never ready", or a wait for an event that never came */
    const happening* next;
    const happening* end;
} host;

static host host_open(void) {
    host h;
    memset(&h, 0, sizeof h);
    CHECK(mr_rack_open("[card.c1]\ntype = \"databoard4002\"\nbus_access_ns = 250\n", &h.rack) == MR_OK);
    return h;
}

static void pass(host* h, uint64_t ns) {
    const uint64_t until = h->next != h->end ? mr_now_ns(h->rack) + ns : 0;
    for (; h->next != h->end && h->next->at_ns <= until; ++h->next) {
        const uint64_t now = mr_now_ns(h->rack);
        if (h->next->at_ns > now) CHECK(mr_advance_ns(h->rack, h->next->at_ns - now) == MR_OK);
        CHECK(mr_wire_set(h->rack, h->next->wire, h->next->level) == MR_OK);
        ns = until - mr_now_ns(h->rack);
    }
    if (ns > 0) CHECK(mr_advance_ns(h->rack, ns) == MR_OK);
}

static void tape(host* h, int kind, uint8_t value) {
    if (h->taped + 2 > sizeof h->tape) return;
    h->tape[h->taped++] = (uint8_t)kind;
    h->tape[h->taped++] = value;
}

static void out(host* h, uint32_t port, int value) {
    pass(h, 11 * T_STATE - BUS);
    CHECK(mr_write8(h->rack, "c1", port, (uint8_t)value) == MR_OK);
    if (port != CS) tape(h, (int)port, (uint8_t)value);
}

static uint8_t in(host* h, uint32_t port) {
    uint8_t value = 0;
    pass(h, 11 * T_STATE - BUS);
    CHECK(mr_read8(h->rack, "c1", port, &value) == MR_OK);
    if (port == DATA) tape(h, 0x40 + DATA, value);
    return value;
}

static void say(host* h, const char* text) {
    if (strlen(h->said) + strlen(text) + 2 < sizeof h->said) strcat(strcat(h->said, text), "|");
}

static double part(const host* h, const char* name) {
    double value = -1e9;
    CHECK(mr_part_get(h->rack, name, &value) == MR_OK);
    return value;
}

static double wire(const host* h, const char* name) {
    double value = -1e9;
    CHECK(mr_wire_get(h->rack, name, &value) == MR_OK);
    return value;
}

static long position(const host* h) {
    return (long)part(h, "c1.position_counts");
}

/* ---- both programs
 * -------------------------------------------------------------------------------------------------------- */

enum { INTERVALS = 24 };
static const unsigned deceleration[INTERVALS][2] = {
    {14000, 1},   {14500, 6},   {15002, 8},   {15216, 15},  {15678, 30},  {16016, 35},  {16144, 40},  {16262, 45},
    {16278, 50},  {16288, 60},  {16298, 70},  {16304, 85},  {16312, 100}, {16317, 115}, {16322, 130}, {16326, 145},
    {16330, 160}, {16332, 180}, {16334, 200}, {16336, 225}, {16338, 250}, {16340, 285}, {16342, 320}, {16344, 370}};
static const unsigned acceleration[INTERVALS][2] = {
    {14000, 1},   {14500, 12},  {15402, 16},  {15682, 22},  {15778, 30},  {15900, 35},  {16000, 40},  {16262, 50},
    {16284, 60},  {16292, 70},  {16298, 80},  {16304, 105}, {16312, 130}, {16316, 150}, {16322, 180}, {16326, 215},
    {16330, 250}, {16332, 290}, {16334, 330}, {16336, 365}, {16338, 400}, {16340, 450}, {16342, 500}, {16344, 600}};

/* Differences between the two listings. */
typedef struct {
    const char* name;
    unsigned ready_looks;   /* polls of READY before "unit never ready" */
    uint64_t ready_look_ns; /* duration of one poll without the IN */
    uint64_t event_look_ns; /* the same in the loop that waits for an event */
    uint64_t call_ns;       /* from the return of one access to the first poll for the next */
    unsigned stretch_2; /* positions of slope type 2: the BASIC program doubles them, the assembler program does not */
    /* 0: displaying a text overwrites STAT, so that later stops are not reported. As printed, PRINTSTR of the assembler
     * program leaves its function code for OS8 in A. Its bits are not printed; none is assumed to be a stop bit. */
    int keeps_status;
    const char *left, *right, *emergency, *in_position, *fatal;
} listing;

/* WAITRDY: INP, NI, JNZS, DECD, LR, OR, JNZS are 51 T-states, so that 10000 of them are 127.5 ms. */
static const listing assembler = {"assembler",
                                  10000,
                                  40 * T_STATE,
                                  19 * T_STATE,
                                  96 * T_STATE,
                                  1,
                                  0,
                                  "LEFT MARGIN.",
                                  "RIGHT MARGIN.",
                                  "EMERGENCY STOP.",
                                  "IN POSITION.",
                                  "FATAL ERROR, UNIT NOT READY!!!!!!"};
/* Assumes one millisecond per interpreted statement. */
static const listing basic = {"basic",
                              100,
                              2 * MS,
                              1 * MS,
                              2 * MS,
                              2,
                              1,
                              "LEFT MARGIN STOP.",
                              "RIGHT MARGIN STOP.",
                              "EMERGENCY STOP.",
                              "IN POSITION.",
                              "FATAL ERROR !! UNIT NEVER READY !"};

/* Routines of the listings, here and below: assembler label; BASIC function, its line. WAITRDY; FNWaitrdy, 2840. */
static void wait_ready(host* h, const listing* l) {
    const uint64_t from = mr_now_ns(h->rack);
    unsigned poll;
    for (poll = 0; poll < l->ready_looks; ++poll) {
        if (in(h, STAT) & READY) {
            if (mr_now_ns(h->rack) - from > h->max_wait_ns) h->max_wait_ns = mr_now_ns(h->rack) - from;
            return;
        }
        pass(h, l->ready_look_ns);
    }
    if (!h->gave_up) say(h, l->fatal);
    h->gave_up = 1;
}

/* OUTSTROB; FNOut, 3760. */
static void out_strobe(host* h, const listing* l, uint32_t port, unsigned value) {
    pass(h, l->call_ns);
    wait_ready(h, l);
    out(h, port, (int)(value & 0xff));
}

/* INSTROB; FNInp, 3920. */
static uint8_t in_strobe(host* h, const listing* l, uint32_t port) {
    pass(h, l->call_ns);
    wait_ready(h, l);
    return in(h, port);
}

/* INIT; FNInitdemo, 4080. */
static void init(host* h, const listing* l) {
    out(h, CS, CARD);
    out_strobe(h, l, C2, 'I');
    out_strobe(h, l, C2, 'D');
    out_strobe(h, l, DATA, 25);
    out_strobe(h, l, DATA, 0);
    out_strobe(h, l, DATA, 0);
}

/* MAXSPEED; FNMaxspeed, 2420. */
static void max_speed(host* h, const listing* l, unsigned rate) {
    out_strobe(h, l, C2, 'R');
    out_strobe(h, l, DATA, rate);
    out_strobe(h, l, DATA, rate / 256);
}

/* STORESLO; FNStoreslope, 3060. */
static void store_slope(host* h, const listing* l, unsigned stretch) {
    int half, interval;
    out_strobe(h, l, C2, 'S');
    for (half = 1; half <= 2; ++half) {
        for (interval = 0; interval < INTERVALS; ++interval) {
            const unsigned* row = half == 1 ? deceleration[interval] : acceleration[interval];
            out_strobe(h, l, DATA, row[0]);
            out_strobe(h, l, DATA, row[0] / 256);
            out_strobe(h, l, DATA, 0);
            out_strobe(h, l, DATA, row[1] * stretch);
            out_strobe(h, l, DATA, row[1] * stretch / 256);
        }
    }
    out_strobe(h, l, C2, 'O');
}

/* Reports one of the stops in STAT; returns the remaining bits of STAT. */
static uint8_t say_stop(host* h, const listing* l, const char* text, uint8_t status) {
    say(h, text);
    return l->keeps_status ? status : 0;
}

/* GOPOSIT; FNGoPosition, 1860. Unlike the programs, gives up if no event comes within `max_ready_wait_ns`. */
static void go_position(host* h, const listing* l, unsigned target, uint64_t max_ready_wait_ns) {
    uint8_t event = 0;
    out_strobe(h, l, C2, 'P');
    out_strobe(h, l, DATA, 0);
    out_strobe(h, l, DATA, target);
    out_strobe(h, l, DATA, target / 256);
    out_strobe(h, l, C4, 32 + 1);
    (void)in_strobe(h, l, DATA);
    out_strobe(h, l, C2, 'G');
    while ((event & 1) == 0) {
        const uint64_t from = mr_now_ns(h->rack);
        uint8_t status;
        while ((in(h, STAT) & EVENT) == 0) {
            if (mr_now_ns(h->rack) - from > max_ready_wait_ns) {
                h->gave_up = 1;
                return;
            }
            pass(h, LOOKS_APART * l->event_look_ns);
        }
        out_strobe(h, l, C4, 32 + 1);
        event = in_strobe(h, l, DATA);
        if ((event & 32) == 0) continue;
        status = in(h, STAT);
        if (status & LEFT) status = say_stop(h, l, l->left, status);
        if (status & RIGHT) status = say_stop(h, l, l->right, status);
        if (status & EMERGENCY) status = say_stop(h, l, l->emergency, status);
    }
}

/* QUIT; FNQuit, 2620: the user presses a key after one second. */
static void quit(host* h, const listing* l) {
    say(h, l->in_position);
    pass(h, 1000 * MS);
}

#endif
