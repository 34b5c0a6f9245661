/* A C99 program against mcx314lib.h: every function has the type of its source, and a line is driven. */
#include <mcx314lib.h>
#include <stdio.h>
#include <string.h>

static int failures = 0;

#define CHECK(condition)                                                                      \
    do {                                                                                      \
        if (!(condition)) {                                                                   \
            fprintf(stderr, "line %d: %s (%s)\n", __LINE__, #condition, mcx314_last_error()); \
            ++failures;                                                                       \
        }                                                                                     \
    } while (0)

typedef void (*one_int)(int);
typedef void (*two_ints)(int, int);
typedef void (*four_ints)(int, int, int, int);
typedef void (*five_ints)(int, int, int, int, int);
typedef void (*six_ints)(int, int, int, int, int, int);
typedef void (*line)(LINEDATA*, int);
typedef void (*circle)(CIRCLEDATA*, int);
typedef void (*set_counter)(int, unsigned);
typedef unsigned (*read_counter)(int);
typedef void (*nothing)(void);

/* Argument lists of the source; a mismatch does not compile. */
const one_int one[] = {SetRange, SetMaxSpeed, SLMTP, SLMTM, SLMTSig, EnableALM, EnableInPos};
const two_ints two[] = {SetPulseMode, SetMultiple, SetSV,       SetV,         SetA,   SetD,     SetAA,    SetAO,
                        Pulse,        ManualDec,   ManDec,      SetC,         SetCP,  SetP,     SetFP,    HLMTP,
                        HLMTM,        HLMTSig,     EncoderMode, EncoderCWCCW, ALMSig, InPosSig, SetCompP, SetCompM};
const four_ints four[] = {TCurve_C, HomeType1, HomeType2, HomeType3, HomeType4};
const five_ints five[] = {TCurve_F, SCurve_C};
const six_ints six[] = {SCurve_F};
const line lines[] = {Line2D_C, Line3D_C, Line2D_T, Line3D_T, Line2D_S, Line3D_S};
const circle circles[] = {CircleCW_C, CircleCCW_C, CircleCW_T, CircleCCW_T};
const set_counter setters[] = {LPS, EPS};
const read_counter readers[] = {ReadLPS, ReadEPS, ReadCV, ReadCA};
const nothing none[] = {AutoDec, RESET};
#define COUNT(table) (sizeof(table) / sizeof(table)[0])

static void every_function_of_the_source_is_there(void) {
    CHECK(COUNT(one) + COUNT(two) + COUNT(four) + COUNT(five) + COUNT(six) + COUNT(lines) + COUNT(circles) +
              COUNT(setters) + COUNT(readers) + COUNT(none) ==
          57);
}

static void keep(const char* sentence, void* user) {
    strncat((char*)user, sentence, 200);
}

static void a_line_ends_where_it_should(void) {
    LINEDATA data = {0};
    CHECK(mcx314_open("card.c1 = \"mcx314\"", NULL) == 1);
    SetMaxSpeed(80000);
    data.SV = 100;
    data.V = 4000;
    data.A = 400;
    data.P[0] = 3000;
    data.P[1] = -2000;
    Line2D_T(&data, 0x3);
    CHECK(mcx314_moving(0xf) == 0x3);
    CHECK(mcx314_wait(0x3, 10000) == 0);
    CHECK((int)ReadLPS(1) == 3000);
    CHECK((int)ReadLPS(2) == -2000);
    CHECK(strcmp(mcx314_last_error(), "") == 0);
}

static void errors_go_to_the_handler(void) {
    char text[1000] = "";
    mcx314_on_error(keep, text);
    Line2D_T(NULL, 0x3);
    mcx314_on_error(NULL, NULL);
    CHECK(strcmp(text, "Line2D_T: The line is a null pointer. Nothing was done.") == 0);
    CHECK(strcmp(text, mcx314_last_error()) == 0);
    mcx314_clear_error();
    CHECK(strcmp(mcx314_last_error(), "") == 0);
}

int main(void) {
    every_function_of_the_source_is_there();
    a_line_ends_where_it_should();
    errors_go_to_the_handler();
    return failures == 0 ? 0 : 1;
}
