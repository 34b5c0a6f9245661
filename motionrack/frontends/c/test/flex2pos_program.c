/* A C99 program that reads encoders with motionrack/flex2pos.h. It ends with 0 if everything was as it should be. */
#include <motionrack/flex2pos.h>
#include <stdio.h>
#include <string.h>

static int wrong = 0;

static void expect(int good, const char* what) {
    if (good) return;
    fprintf(stderr, "wrong: %s (%s)\n", what, mr_last_error());
    ++wrong;
}

/* A line of an encoder, by hand, for 2 us. */
static void set(mr_rack* rack, const char* wire, int level) {
    expect(mr_wire_set(rack, wire, level) == MR_OK, wire);
    expect(mr_advance_ns(rack, 2000) == MR_OK, "time");
}

static void line_of_axis_1(mr_rack* rack) {
    set(rack, "p1.a1", 1);
    set(rack, "p1.b1", 1);
    set(rack, "p1.a1", 0);
    set(rack, "p1.b1", 0);
}

int main(void) {
    mr_rack* rack = NULL;
    flex2pos* flex = NULL;
    int32_t time = -1, position[4];
    int status[4], i;
    double level = 0;

    expect(mr_rack_open("[card.p1]\ntype = \"ioflex02\"\nloaded = false\n", &rack) == MR_OK, "open");
    expect(flex2pos_open(rack, &flex) == MR_OK, "object");
    expect(flex2pos_ReadPosition(flex, 0) == 0 && flex2pos_Result(flex) == Flex_ErrDevice, "nothing before Init");
    expect(flex2pos_Init(flex, 0x2400) == Flex_ErrDevice && strlen(flex2pos_why(flex)) > 0, "a wrong address");
    expect(flex2pos_Init(flex, 0x2300) == Flex_Ok, flex2pos_why(flex));
    expect(flex2pos_GetIdent(flex) == 0x25, "the project's version");

    flex2pos_ReadTimeClr(flex);
    for (i = 0; i < 5; ++i) line_of_axis_1(rack);
    flex2pos_ReadTimeClrPosition(flex, &time, position);
    expect(position[0] == 0 && position[1] == 20 && position[2] == 0 && position[3] == 0, "four counts a line");
    expect(time >= 40000 / 1200 && time < 60000 / 1200, "ticks of 1.2 us");
    expect(flex2pos_ReadPosition(flex, 1) == 20 && flex2pos_ReadPosition(flex, 4) == 0, "an axis by itself");

    flex2pos_WriteCmd(flex, cNop, cResNmSig, cRes, cResNm);
    flex2pos_ReadSts(flex, status);
    expect(status[0] == sCal && status[1] == sNotCal && status[2] == sCal && status[3] == sNotCal, "statuses");
    set(rack, "p1.cal1", 1);
    set(rack, "p1.z1", 1);
    flex2pos_ReadSts(flex, status);
    expect(status[1] == sCal && flex2pos_ReadPosition(flex, 1) == 0, "the index after the calibration input");
    flex2pos_WriteCmd(flex, cNop, 9, cNop, cNop);
    flex2pos_ReadSts(flex, status);
    expect(status[3] == sNotCal, "a wrong command writes nothing");

    flex2pos_WriteOutL(flex, 0x81);
    flex2pos_WriteOutH(flex, 0x01);
    expect(mr_wire_get(rack, "p1.out7", &level) == MR_OK && level == 1, "an output");
    expect(mr_wire_get(rack, "p1.out8", &level) == MR_OK && level == 1, "a high output");
    set(rack, "p1.in3", 1);
    set(rack, "p1.in15", 1);
    expect(flex2pos_ReadInL(flex) == 0x08 && flex2pos_ReadInH(flex) == 0x80, "inputs");

    expect(flex2pos_Init(NULL, 0x2300) == Flex_ErrDevice && flex2pos_ReadTime(NULL) == 0, "no object");
    flex2pos_close(flex);
    mr_rack_close(rack);
    expect(mr_rack_open("card.c1 = \"mcx314\"", &rack) == MR_OK && flex2pos_open(rack, &flex) == MR_BAD_CALL &&
               flex == NULL,
           "another card");
    mr_rack_close(rack);
    return wrong != 0;
}
