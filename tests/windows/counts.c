/* Uses all kinds of functions of the MCX314's function library and prints the results, doubles with every bit. The
 * library of each operating system must give the same lines. */
#include <math.h>
#include <mcx314lib.h>
#include <stdio.h>
#include <string.h>

enum { X = 1, Y = 2, Z = 4, U = 8, ALL = 15 };

static void on_error(const char* sentence, void* user) {
    (void)user;
    printf("error: %s\n", sentence);
}

static void show(const char* what) {
    int axis;
    printf("%s at %ld us", what, (long)mcx314_now_us());
    for (axis = X; axis <= U; axis *= 2)
        printf(" | %d %d %u %u", (int)ReadLPS(axis), (int)ReadEPS(axis), ReadCV(axis), ReadCA(axis));
    printf("\n");
}

/* Prints the state every 7 ms until all axes are at standstill, 400 times at most. */
static void watch(const char* what) {
    int looks;
    for (looks = 0; looks < 400 && mcx314_moving(ALL) > 0; ++looks) {
        show(what);
        mcx314_advance_ms(7);
    }
    show(what);
}

static void show_bits(const char* what, double value) {
    uint32_t words[2];
    memcpy(words, &value, sizeof value);
    printf("%s %08lx%08lx\n", what, (unsigned long)words[1], (unsigned long)words[0]);
}

static void show_plan(int k, int pulses) {
    MCX314_PLAN plan;
    if (mcx314_plan(X, 100, 4000, 777, k, pulses, &plan) < 0) return;
    show_bits("seconds", plan.seconds);
    show_bits("top", plan.top_hz);
    show_bits("end", plan.end_hz);
    printf("deceleration point %d, offset %d\n", plan.dec_point, plan.offset);
}

static void plans(void) {
    int pulses;
    for (pulses = 1; pulses < 300000; pulses = pulses * 7 + 3) {
        show_plan(0, pulses);
        show_plan(321, pulses);
    }
}

static void drives(void) {
    TCurve_F(X, 100, 4000, 400, 12345);
    SCurve_F(Y, 100, 3000, 8000, 1010, -7777);
    watch("curves");
    SetD(Z, 150);
    TCurve_F(Z, 50, 2500, 300, 5000);
    watch("asymmetric");
    TCurve_C(U, 100, 2000, 100);
    mcx314_advance_ms(300);
    SetV(U, 3000);
    mcx314_advance_ms(200);
    mcx314_stop(U);
    watch("continuous");
}

static void paths(void) {
    static const int ends[2][4] = {{1500, 1500}, {-4500, 0}}, centre[4] = {0, 1500};
    static const MCX314_STEPS steps[2] = {{{0xFFFF, 0x5555}, {0, 0}}, {{0x0100, 0}, {0x0100, 0x00FF}}};
    LINEDATA line = {100, 3000, 200, 0, 500, {10000, -2222, 3333, 0}};
    CIRCLEDATA arc = {100, 500, 50, 0, {-3000, 3000, 0, 0}, {-3000, 0, 0, 0}};
    MCX314_CONTOUR speeds = {10, 100, 10, 0};
    MCX314_PATTERN pattern = {0, 100, 0, 0};
    Line3D_S(&line, X + Y + Z);
    watch("line");
    CircleCCW_T(&arc, X + Y);
    watch("arc");
    mcx314_contour_begin(&speeds);
    mcx314_contour_arc(X + Y, ends[0], centre, 0, 0);
    mcx314_contour_line(X + Y, ends[1], 200);
    mcx314_contour_end();
    show("contour");
    mcx314_pattern_begin(&pattern, X + Y);
    mcx314_pattern_steps(&steps[0]);
    mcx314_pattern_steps(&steps[1]);
    mcx314_pattern_start();
    mcx314_pattern_end();
    show("pattern");
}

static void inputs(void) {
    int i;
    for (i = 0; i < 12; ++i) { /* the home switch (IN0) goes Low in the sixth step */
        mcx314_jog_home(X, 1, 0x0002, 100, 2000, 200);
        mcx314_advance_ms(100);
        if (i == 5) mcx314_set_wire("c1.xin0", 0);
    }
    mcx314_set_wire("c1.xin0", NAN);
    show("home");
    TCurve_F(Y, 100, 2000, 400, 50000);
    mcx314_advance_ms(50);
    mcx314_set_wire("c1.ylmtp", 0);
    printf("wait %d, at limit %d\n", mcx314_wait(Y, 10000), mcx314_at_limit(ALL));
    printf("%s\n", mcx314_report(X + Y));
    mcx314_set_wire("c1.ylmtp", NAN);
    mcx314_enable_interrupt(Z, MCX314_DRIVE_END);
    TCurve_F(Z, 100, 2000, 400, 500);
    mcx314_wait(Z, 10000);
    printf("causes %d\n", mcx314_read_interrupt(Z));
    show("inputs");
}

static void refusals(void) {
    int64_t value = 0;
    SetV(X, 9000);
    SetSV(16, 100);
    Line2D_T(NULL, X + Y);
    mcx314_set_wire("c1.xlmtp", 2);
    mcx314_select(7);
    printf("peek %d, %ld\n", mcx314_peek("x.LP", &value), (long)value);
}

static void encoder(void) {
    mcx314_set_wire("c1.xeca", 1);
    TCurve_F(X, 100, 2000, 400, 300);
    mcx314_wait(X, 10000);
    show("encoder cut off");
    mcx314_set_wire("c1.xecb", 1);
    mcx314_set_wire("c1.xeca", 0);
    mcx314_set_wire("c1.xeca", NAN);
    mcx314_set_wire("c1.xecb", NAN);
    TCurve_F(X, 100, 2000, 400, 300);
    mcx314_wait(X, 10000);
    show("encoder");
}

/* Runs all tests on a rack: with one card, encoders count its pulses; with two, the pulses move no encoder. */
static void all(const char* rack) {
    printf("card %d\n", mcx314_open(rack, NULL));
    SetPulseMode(ALL, 1);
    SetRange(400000);
    LPS(X, (unsigned)-100);
    EPS(X, 5);
    plans();
    drives();
    paths();
    inputs();
    encoder();
    refusals();
    mcx314_set_wire("c1.emgn", 0);
    TCurve_F(X, 100, 2000, 400, 300);
    printf("wait %d\n", mcx314_wait(X, 10000));
    mcx314_set_wire("c1.emgn", NAN);
    RESET();
}

int main(void) {
    mcx314_on_error(on_error, NULL);
    all("card.c1 = \"mcx314\"");
    all("card.c1 = \"mcx314\" # one\ncard.c2 = \"mcx314\"\n");
    printf("card %d\n", mcx314_open(NULL, NULL));
    SetMultiple(U, 3);
    TCurve_F(U, 100, 4000, 500, 2000);
    watch("second card");
    return 0;
}
