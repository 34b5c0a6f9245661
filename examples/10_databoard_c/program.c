/* An old host program on the DataBoard 4002: the maker's demonstration in BASIC, line by line, on a machine in
 * software.
 *
 *   BASIC:  OUT 3,ASCII("G")     here:  out(C2, 'G')      the number behind a function is its line in the listing
 *           INP(1) AND 128              in(STAT) & 128
 *
 * With the name of a file it also writes the run down as CSV: seconds, counts, counts a second. */
#include <motionrack/c.h>
#include <stdio.h>
#include <stdlib.h>

/* ---- the machine: two functions for the ports, one for the time
 * -------------------------------------------------------------- */

static mr_rack* rack;
static FILE* record;
static uint64_t recorded_ns;
static uint64_t switch_ns; /* instant at which the switch of the right end stop changes; 0: never */
static int pressed;

static void must(int code) {
    if (code == MR_OK) return;
    fprintf(stderr, "%s\n", mr_last_error());
    exit(1);
}

static double seconds(void) {
    return (double)mr_now_ns(rack) * 1e-9;
}

static double quantity(const char* name) {
    double value = 0;
    must(mr_part_get(rack, name, &value));
    return value;
}

/* +1 to the right, -1 to the left. */
static double sign(void) {
    double level = 0;
    must(mr_wire_get(rack, "c1.sign", &level));
    return 2 * level - 1;
}

/* The world goes on for that long. */
static void pass_ms(unsigned ms) {
    while (ms-- > 0) {
        if (record != NULL && mr_now_ns(rack) >= recorded_ns) {
            fprintf(record, "%.3f,%.0f,%.1f\n", seconds(), quantity("c1.position_counts"),
                    quantity("c1.fout_hz") * sign());
            recorded_ns = mr_now_ns(rack) + 99500000;
        }
        must(mr_advance_ns(rack, 1000000));
        if (switch_ns != 0 && mr_now_ns(rack) >= switch_ns) {
            pressed = !pressed;
            must(mr_wire_set(rack, "c1.esr", pressed));
            switch_ns = pressed ? switch_ns + 5000000000 : 0;
        }
    }
}

/* An interpreter needs about a millisecond for each of them. */
static void out(uint32_t port, int value) {
    pass_ms(1);
    must(mr_write8(rack, "c1", port, (uint8_t)value));
}

static int in(uint32_t port) {
    uint8_t value = 0;
    pass_ms(1);
    must(mr_read8(rack, "c1", port, &value));
    return value;
}

/* ---- the program
 * ------------------------------------------------------------------------------------------------------------- */

enum { DATA = 0, CS = 1, C1 = 2, C2 = 3, C3 = 4, C4 = 5, STAT = 1 }; /* 4140 */

/* FNWaitrdy, 2840 */
static void wait_ready(void) {
    int looks;
    for (looks = 0; looks != 100; ++looks)
        if (in(STAT)&128) return;
    printf("FATAL ERROR !! UNIT NEVER READY !\n");
    exit(1);
}

/* FNOut, 3760 */
static void strobe_out(uint32_t port, int value) {
    wait_ready();
    out(port, value);
}

/* FNInp, 3920 */
static int strobe_in(uint32_t port) {
    wait_ready();
    return in(port);
}

/* FNMaxspeed, 2420 */
static void max_speed(int rate) {
    strobe_out(C2, 'R');
    strobe_out(DATA, rate);
    strobe_out(DATA, rate / 256);
}

/* 3420 .. 3640: speed, and position in units of 256 counts */
static const int slopes[2][24][2] = {
    {{14000, 1},   {14500, 6},   {15002, 8},   {15216, 15},  {15678, 30},  {16016, 35},  {16144, 40},  {16262, 45},
     {16278, 50},  {16288, 60},  {16298, 70},  {16304, 85},  {16312, 100}, {16317, 115}, {16322, 130}, {16326, 145},
     {16330, 160}, {16332, 180}, {16334, 200}, {16336, 225}, {16338, 250}, {16340, 285}, {16342, 320}, {16344, 370}},
    {{14000, 1},   {14500, 12},  {15402, 16},  {15682, 22},  {15778, 30},  {15900, 35},  {16000, 40},  {16262, 50},
     {16284, 60},  {16292, 70},  {16298, 80},  {16304, 105}, {16312, 130}, {16316, 150}, {16322, 180}, {16326, 215},
     {16330, 250}, {16332, 290}, {16334, 330}, {16336, 365}, {16338, 400}, {16340, 450}, {16342, 500}, {16344, 600}}};

/* FNStoreslope, 3060: deceleration, then acceleration */
static void store_slope(int slope) {
    int half, i;
    strobe_out(C2, 'S');
    for (half = 0; half < 2; ++half) {
        for (i = 0; i < 24; ++i) {
            const int speed = slopes[half][i][0];
            int position = slopes[half][i][1];
            if (slope == 2) position *= 2; /* 3180: twice as gentle */
            strobe_out(DATA, speed & 255);
            strobe_out(DATA, speed / 256);
            strobe_out(DATA, 0);
            strobe_out(DATA, position & 255);
            strobe_out(DATA, position / 256);
        }
    }
    strobe_out(C2, 'O');
}

/* FNGoPosition, 1860 */
static void go_position(const char* name, int position) {
    const double from = seconds();
    int event = 0;
    strobe_out(C2, 'P');
    strobe_out(DATA, 0);
    strobe_out(DATA, position & 255);
    strobe_out(DATA, position / 256);
    strobe_out(C4, 1 + 32); /* enable: in position, end stop */
    (void)strobe_in(DATA);  /* gets rid of old events */
    strobe_out(C2, 'G');
    while ((event & 1) == 0) {
        while ((in(STAT)&2) == 0) {
        }
        strobe_out(C4, 1 + 32);
        event = strobe_in(DATA);
        if (event & 32) {
            const int status = strobe_in(STAT);
            if (status & 64) printf("         at %6.0f counts: LEFT MARGIN STOP.\n", quantity("c1.position_counts"));
            if (status & 32) printf("         at %6.0f counts: RIGHT MARGIN STOP.\n", quantity("c1.position_counts"));
            if (status & 16) printf("         at %6.0f counts: EMERGENCY STOP.\n", quantity("c1.position_counts"));
        }
    }
    printf("%s  %6.0f counts  after %6.2f s  IN POSITION.\n", name, quantity("c1.position_counts"), seconds() - from);
}

/* FNQuit, 2620: the user presses a key after three seconds */
static void wait_for_key(void) {
    pass_ms(3000);
}

/* FNInitdemo, 4080 */
static void init(void) {
    out(CS, 13); /* card select */
    strobe_out(C2, 'I');
    strobe_out(C2, 'D'); /* lock may let it deviate by 25 counts */
    strobe_out(DATA, 25);
    strobe_out(DATA, 0);
    strobe_out(DATA, 0);
}

/* The main loop, 1180: A is 0, B is 500, C is 1000. */
static void one_round(void) {
    max_speed(63 * 256 + 240);
    store_slope(1);
    go_position("A to C", 1000); /* empty: quickly */
    strobe_out(C2, 'L');         /* held there while it is loaded */
    wait_for_key();
    strobe_out(C2, 'M');
    store_slope(2);
    max_speed(63 * 256 + 240);
    go_position("C to B", 500); /* loaded: gently */
    wait_for_key();
    max_speed(63 * 256);
    go_position("B to A", 0); /* at a limited speed, too */
    wait_for_key();
}

int main(int argc, char** argv) {
    must(mr_rack_open("card.c1 = \"databoard4002\"", &rack));
    if (argc > 1 && (record = fopen(argv[1], "w")) == NULL) return 1;
    init();
    one_round();
    if (record != NULL) fclose(record);
    record = NULL;

    printf("To C again, at once with 10 kHz; after 10 s the right end stop's switch is held for 5 s:\n");
    switch_ns = mr_now_ns(rack) + 10000000000;
    strobe_out(C2, 'M');
    max_speed(16344);
    go_position("A to C", 1000);
    mr_rack_close(rack);
    return 0;
}
