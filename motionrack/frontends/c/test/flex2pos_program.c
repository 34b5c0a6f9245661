/* A C99 program that reads encoders with motionrack/flex2pos.h. Exits with 0 if all checks pass. */
#include <motionrack/flex2pos.h>
#include <stdio.h>
#include <string.h>

static int wrong = 0;

static void expect(int good, const char* what) {
    if (good) return;
    fprintf(stderr, "wrong: %s (%s)\n", what, mr_last_error());
    ++wrong;
}

/* Forces a line of an encoder to a level and advances time by 2 us. */
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

/* Makes, checks and loads user-defined images. */
static void images(flex2pos* flex) {
    static const uint8_t reversed[flex2pos_payload] = {1, 0, 1, 0, 1, 0, 1, 0};
    uint8_t image[100];
    size_t size = 5;
    expect(flex2pos_image_make(NULL, 0x25, reversed, sizeof reversed, image, &size) == MR_BAD_CALL && size > 5 &&
               size <= sizeof image,
           "no room, and how much is needed");
    expect(flex2pos_image_make(NULL, 0x25, reversed, sizeof reversed, image, &size) == MR_OK, "an image");
    expect(flex2pos_image_check(image, size) == Flex_Ok, "its check");
    expect(flex2pos_set_base_address(flex, 0x2300) == MR_OK && flex2pos_Result(flex) == Flex_ErrDevice, "the address");
    expect(flex2pos_Configure(flex, image, size) == Flex_Ok, flex2pos_why(flex));
    image[size / 2] ^= 0x55;
    expect(flex2pos_image_check(image, size) == Flex_ErrCfg && flex2pos_Configure(flex, image, size) == Flex_ErrCfg,
           "a damaged image");
    size = sizeof image;
    expect(flex2pos_image_make("stepper", 0x25, NULL, 0, image, &size) == MR_OK, "another project");
    expect(flex2pos_image_check(image, size) == Flex_ErrProject && strstr(mr_last_error(), "stepper") != NULL, "check");
    expect(flex2pos_Configure(flex, image, size) == Flex_ErrProject && flex2pos_Result(flex) == Flex_ErrProject, "it");
    size = sizeof image;
    expect(flex2pos_image_make("position", 0x24, NULL, 0, image, &size) == MR_OK &&
               flex2pos_Configure(flex, image, size) == Flex_ErrProject && flex2pos_GetIdent(flex) == 0,
           "another version");
    expect(flex2pos_image_make("a name that is too long", 0x25, NULL, 0, image, &size) == MR_REFUSED, "a long name");
    expect(flex2pos_Configure(flex, NULL, 0) == Flex_Ok && flex2pos_GetIdent(flex) == 0x25, "the image of Init again");
}

/* Init loads the image that the rack file gives the card. */
static void image_of_the_rack(void) {
    static const char start[] = "[card.p1]\ntype = \"ioflex02\"\npreloaded = false\nimage = \"";
    char text[400];
    uint8_t image[100];
    size_t size = sizeof image, i, at = sizeof start - 1;
    mr_rack* rack = NULL;
    flex2pos* flex = NULL;
    expect(flex2pos_image_make("position", 0x26, NULL, 0, image, &size) == MR_OK, "an image");
    strcpy(text, start);
    for (i = 0; i < size; ++i) at += (size_t)sprintf(text + at, "%02x", image[i]);
    strcpy(text + at, "\"\n");
    expect(mr_rack_open(text, &rack) == MR_OK && flex2pos_open(rack, &flex) == MR_OK, "a rack with an image");
    expect(flex2pos_Init(flex, 0x2300) == Flex_ErrProject, "Init loads the rack's image");
    flex2pos_close(flex);
    mr_rack_close(rack);
    text[sizeof start] = 'x';
    expect(mr_rack_open(text, &rack) == MR_BAD_INPUT && strstr(mr_last_error(), "hexadecimal") != NULL,
           "a wrong digit");
}

static void another_card(void) {
    mr_rack* rack = NULL;
    flex2pos* flex = NULL;
    expect(mr_rack_open("card.c1 = \"mcx314\"", &rack) == MR_OK && flex2pos_open(rack, &flex) == MR_BAD_CALL &&
               flex == NULL,
           "another card");
    mr_rack_close(rack);
}

int main(void) {
    mr_rack* rack = NULL;
    flex2pos* flex = NULL;
    int32_t time = -1, position[4];
    int status[4], i;
    double level = 0;

    expect(mr_rack_open("[card.p1]\ntype = \"ioflex02\"\npreloaded = false\n", &rack) == MR_OK, "open");
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
    expect(flex2pos_ReadInL(flex) == 0xC0 && flex2pos_ReadInH(flex) == 0, "Z and Cal of axis 1 are high");
    set(rack, "p1.b0", 1);
    set(rack, "p1.in15", 1);
    expect(mr_wire_get(rack, "p1.cal3", &level) == MR_OK && level == 1, "two names of an input");
    expect(flex2pos_ReadInL(flex) == 0xC2 && flex2pos_ReadInH(flex) == 0x80, "inputs");

    flex2pos_WriteCmd(flex, cNop, cNop, cNop, cResNm);
    flex2pos_WriteCmdAxis(flex, 2, cResNmSig);
    flex2pos_WriteCmdAxis(flex, 4, cResNm);
    flex2pos_WriteCmdAxis(flex, 0, -1);
    flex2pos_ReadSts(flex, status);
    expect(status[0] == sCal && status[1] == sCal && status[2] == sNotCal && status[3] == sNotCal, "one axis armed");
    expect(cVerNo == 0x0251 && strcmp(cVer, "02.51, 07.08.2003") == 0, "the unit's version");
    images(flex);

    expect(flex2pos_Init(NULL, 0x2300) == Flex_ErrDevice && flex2pos_ReadTime(NULL) == 0, "no object");
    flex2pos_close(flex);
    mr_rack_close(rack);
    image_of_the_rack();
    another_card();
    return wrong != 0;
}
