/* A program for the MCX314's function library: sets the parameters of X, drives there and back, and shows its counters
 * as the window of such a program does. */
#include <mcx314lib.h>
#include <stdio.h>

enum { X = 1 };

/* What would be a message box. */
static void on_error(const char* sentence, void* user) {
    (void)user;
    printf("error: %s\n", sentence);
}

static void show(void) {
    printf("LP %6d  EP %6d  CV %4u  CA %3u\n", (int)ReadLPS(X), (int)ReadEPS(X), ReadCV(X), ReadCA(X));
}

/* Looks ten times a second until X stands. */
static void watch(void) {
    while (mcx314_moving(X) > 0) {
        show();
        mcx314_advance_ms(100);
    }
    show();
}

int main(void) {
    mcx314_on_error(on_error, NULL);
    SetPulseMode(X, 1); /* pulse and direction */
    SetRange(800000);   /* multiple 10 */
    HLMTSig(1, X);      /* limit switches stop decelerating */
    LPS(X, 0);
    EPS(X, 0);
    AutoDec();

    printf("T-curve: 12000 pulses\n");
    TCurve_F(X, 100, 2000, 200, 12000);
    watch();

    printf("S-curve: back again\n");
    SCurve_F(X, 100, 2000, 200, 500, -12000);
    if (mcx314_wait(X, 10000) == 0) show();

    SetV(X, 9000);
    return 0;
}
