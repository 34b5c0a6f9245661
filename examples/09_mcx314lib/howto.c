/* What the how-to pages of the function library show, in C: howto PAGE. */
#include <mcx314lib.h>
#include <stdio.h>
#include <string.h>

enum { X = 1, Y = 2, Z = 4 };

static void on_error(const char* sentence, void* user) {
    (void)user;
    printf("%s\n", sentence);
}

static int at(int axis) {
    return (int)ReadLPS(axis);
}

static void trapezoid(void) {
    MCX314_PLAN plan;
    SetMultiple(X, 10); /* V and SV in steps of 10 pulses/s, A in steps of 1,250 pulses/s2 */
    TCurve_F(X, 100, 4000, 200, 80000);
    mcx314_wait(X, 10000);
    printf("LP %d\n", at(X));

    mcx314_plan(X, 100, 4000, 200, 0, 80000, &plan); /* the same without moving anything */
    printf("in all %.4f s, at most %.0f pulses/s\n", plan.seconds, plan.top_hz);
}

static void s_curve(void) {
    MCX314_PLAN plan;
    SetMultiple(X, 10);
    mcx314_plan(X, 100, 4000, 8000, 1010, 50000, &plan);
    printf("%.4f s, at most %.0f pulses/s, ends at %.0f pulses/s\n", plan.seconds, plan.top_hz, plan.end_hz);
    SCurve_F(X, 100, 4000, 8000, 1010, 50000);
    mcx314_wait(X, 10000);
    printf("X %d\n", at(X));
}

static void asymmetric(void) {
    MCX314_PLAN plan;
    SetMultiple(X, 10);
    SetD(X, 100); /* decelerations take D from here on */
    mcx314_plan(X, 100, 4000, 400, 0, 60000, &plan);
    printf("deceleration begins after %d of 60000 pulses\n", plan.dec_point);
    TCurve_F(X, 100, 4000, 400, 60000);
    mcx314_wait(X, 10000);
    printf("LP %d\n", at(X));
}

static void line(void) {
    LINEDATA to = {100, 3000, 200, 0, 0, {10000, -20000, 30000, 0}};
    SetMultiple(X + Y + Z, 10);
    Line3D_T(&to, X + Y + Z);
    mcx314_wait(X + Y + Z, 10000);
    printf("X %d, Y %d, Z %d\n", at(X), at(Y), at(Z));
}

static void arc(void) {
    CIRCLEDATA quarter = {100, 500, 50, 0, {-3000, 3000, 0, 0}, {-3000, 0, 0, 0}};
    CIRCLEDATA circle = {100, 500, 50, 0, {0, 0, 0, 0}, {0, -1000, 0, 0}};
    CIRCLEDATA no_circle = {100, 500, 50, 0, {10000, 20000, 0, 0}, {5000, 0, 0, 0}};
    SetMultiple(X + Y, 10);
    CircleCCW_T(&quarter, X + Y);
    mcx314_wait(X + Y, 30000);
    printf("quarter: X %d, Y %d\n", at(X), at(Y));
    CircleCW_C(&circle, X + Y);
    mcx314_wait(X + Y, 30000);
    printf("circle:  X %d, Y %d\n", at(X), at(Y));
    CircleCW_C(&no_circle, X + Y); /* the handler gets the sentence */
}

static void contour(void) {
    static const int lines[4][4] = {{4500, 0}, {0, 1500}, {-4500, 0}, {0, -1500}};
    static const int ends[4][4] = {{1500, 1500}, {-1500, 1500}, {-1500, -1500}, {1500, -1500}};
    static const int centres[4][4] = {{0, 1500}, {-1500, 0}, {0, -1500}, {1500, 0}};
    MCX314_CONTOUR speeds = {10, 100, 10, 0};
    int i;
    SetMultiple(X + Y, 10);
    mcx314_contour_begin(&speeds);
    for (i = 0; i != 4; ++i) {
        mcx314_contour_line(X + Y, lines[i], 0);
        mcx314_contour_arc(X + Y, ends[i], centres[i], 0, 0);
    }
    mcx314_contour_end();
    printf("X %d, Y %d\n", at(X), at(Y));
}

static void bit_pattern(void) {
    static const MCX314_STEPS steps[4] = {
        /*   X +     Y +                X -     Y -        the lowest bit is the first step */
        {{0xFFFF, 0x5555}, {0x0000, 0x0000}}, /* 16 to the right, 8 up */
        {{0x1111, 0xFFFF}, {0x0000, 0x0000}}, /* 4 to the right, 16 up */
        {{0x0000, 0x0000}, {0xFFFF, 0x8888}}, /* 16 to the left, 4 down */
        {{0x0100, 0x0000}, {0x0100, 0x00FF}}, /* 8 down; then X + and - at once: the end */
    };
    MCX314_PATTERN speeds = {0, 100, 0, 0};
    int i;
    SetMultiple(X + Y, 1);
    mcx314_pattern_begin(&speeds, X + Y);
    for (i = 0; i != 3; ++i) mcx314_pattern_steps(&steps[i]);
    mcx314_pattern_start();
    mcx314_pattern_steps(&steps[3]); /* waits until there is room */
    mcx314_pattern_end();
    printf("X %d, Y %d\n", at(X), at(Y));
}

int main(int count, char** words) {
    static const struct {
        const char* name;
        void (*show)(void);
    } pages[] = {
        {"trapezoid", trapezoid}, {"s_curve", s_curve},        {"asymmetric", asymmetric}, {"line", line}, {"arc", arc},
        {"contour", contour},     {"bit_pattern", bit_pattern}};
    const int known = (int)(sizeof pages / sizeof pages[0]);
    int i;
    mcx314_on_error(on_error, NULL);
    for (i = 0; i != known; ++i) {
        if (count != 2 || strcmp(words[1], pages[i].name) != 0) continue;
        pages[i].show();
        return 0;
    }
    printf("usage: howto PAGE, which is one of trapezoid, s_curve, asymmetric, line, arc, contour, bit_pattern\n");
    return 1;
}
