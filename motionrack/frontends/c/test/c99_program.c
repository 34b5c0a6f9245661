/* A C99 program that drives a card through motionrack/c.h and checks what comes of it. */
#include <motionrack/c.h>
#include <stdio.h>
#include <string.h>

static int failures = 0;

#define CHECK(condition)                                                                        \
    do {                                                                                        \
        if (!(condition)) {                                                                     \
            fprintf(stderr, "line %d: %s (%s)\n", __LINE__, #condition, mr_last_error());        \
            ++failures;                                                                         \
        }                                                                                       \
    } while (0)

enum { WR0 = 0x00, WR6 = 0x0c, WR7 = 0x0e, RR0 = 0x00, RR6 = 0x0c, RR7 = 0x0e, AXIS_X = 0x0100 };
enum { R = 0x00, A = 0x02, SV = 0x04, V = 0x05, P = 0x06, LP = 0x09, READ_LP = 0x10, FIXED_PLUS = 0x20 };

static void data(mr_rack *rack, uint16_t command, uint32_t value) {
    CHECK(mr_write16(rack, "c1", WR7, (uint16_t)(value >> 16)) == MR_OK);
    CHECK(mr_write16(rack, "c1", WR6, (uint16_t)(value & 0xffff)) == MR_OK);
    CHECK(mr_write16(rack, "c1", WR0, (uint16_t)(AXIS_X | command)) == MR_OK);
}

static int32_t logical_position(mr_rack *rack) {
    uint16_t low = 0, high = 0;
    CHECK(mr_write16(rack, "c1", WR0, AXIS_X | READ_LP) == MR_OK);
    CHECK(mr_read16(rack, "c1", RR6, &low) == MR_OK);
    CHECK(mr_read16(rack, "c1", RR7, &high) == MR_OK);
    return (int32_t)((uint32_t)high << 16 | low);
}

static void set_up(mr_rack *rack) {
    data(rack, R, 800000); /* speeds in units of 10 pulses a second */
    data(rack, A, 400);
    data(rack, SV, 100);
    data(rack, V, 4000); /* 40,000 pulses a second */
    data(rack, LP, 0);
    data(rack, P, 20000);
}

static void drives_a_fixed_number_of_pulses(void) {
    mr_rack *rack = NULL;
    uint16_t status = 0;
    CHECK(mr_rack_open("card.c1 = \"mcx314\"", &rack) == MR_OK);
    CHECK(mr_now_ns(rack) == 0);
    set_up(rack);
    CHECK(mr_now_ns(rack) == 18 * 250);
    CHECK(mr_write16(rack, "c1", WR0, AXIS_X | FIXED_PLUS) == MR_OK);
    CHECK(mr_advance_ns(rack, 100000000) == MR_OK);
    CHECK(mr_read16(rack, "c1", RR0, &status) == MR_OK);
    CHECK((status & 1) == 1);
    CHECK(mr_advance_ns(rack, 2000000000) == MR_OK);
    CHECK(mr_read16(rack, "c1", RR0, &status) == MR_OK);
    CHECK((status & 1) == 0);
    CHECK(logical_position(rack) == 20000);
    mr_rack_close(rack);
}

static void tells_what_is_wrong(void) {
    mr_rack *rack = NULL;
    uint8_t byte = 7;
    CHECK(mr_rack_open("card.c1 = \"mcx315\"", &rack) == MR_BAD_INPUT);
    CHECK(rack == NULL);
    CHECK(strstr(mr_last_error(), "mcx314") != NULL);
    CHECK(mr_rack_open("card.c1 = \"mcx314\"", &rack) == MR_OK);
    CHECK(mr_read8(rack, "c1", 0, &byte) == MR_REFUSED);
    CHECK(byte == 7);
    CHECK(strstr(mr_last_error(), "16 bits") != NULL);
    mr_rack_close(rack);
}

int main(void) {
    drives_a_fixed_number_of_pulses();
    tells_what_is_wrong();
    return failures == 0 ? 0 : 1;
}
