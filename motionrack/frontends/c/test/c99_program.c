/* A C99 program that drives a card through motionrack/c.h and checks the results. */
#include <math.h>
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

enum { WR0 = 0x00, WR6 = 0x0c, WR7 = 0x0e, RR0 = 0x00, RR6 = 0x0c, RR7 = 0x0e, AXIS_X = 0x0100 };
enum { R = 0x00, A = 0x02, SV = 0x04, V = 0x05, P = 0x06, LP = 0x09, READ_LP = 0x10, FIXED_PLUS = 0x20 };

static void data(mr_rack* rack, uint16_t command, uint32_t value) {
    CHECK(mr_write16(rack, "c1", WR7, (uint16_t)(value >> 16)) == MR_OK);
    CHECK(mr_write16(rack, "c1", WR6, (uint16_t)(value & 0xffff)) == MR_OK);
    CHECK(mr_write16(rack, "c1", WR0, (uint16_t)(AXIS_X | command)) == MR_OK);
}

static int32_t logical_position(mr_rack* rack) {
    uint16_t low = 0, high = 0;
    CHECK(mr_write16(rack, "c1", WR0, AXIS_X | READ_LP) == MR_OK);
    CHECK(mr_read16(rack, "c1", RR6, &low) == MR_OK);
    CHECK(mr_read16(rack, "c1", RR7, &high) == MR_OK);
    return (int32_t)((uint32_t)high << 16 | low);
}

static void set_up(mr_rack* rack) {
    data(rack, R, 800000); /* speeds in units of 10 pulses a second */
    data(rack, A, 400);
    data(rack, SV, 100);
    data(rack, V, 4000); /* 40,000 pulses a second */
    data(rack, LP, 0);
    data(rack, P, 20000);
}

static void drives_a_fixed_number_of_pulses(void) {
    mr_rack* rack = NULL;
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

static uint64_t peeked(mr_rack* rack, const char* name) {
    uint64_t value = 0;
    CHECK(mr_peek(rack, "c1", name, &value) == MR_OK);
    return value;
}

static double wire(mr_rack* rack, const char* name) {
    double value = -1;
    CHECK(mr_wire_get(rack, name, &value) == MR_OK);
    return value;
}

static double part(mr_rack* rack, const char* name) {
    double value = -1;
    CHECK(mr_part_get(rack, name, &value) == MR_OK);
    return value;
}

/* The example in the header comment of motionrack/c.h. */
static void the_headers_example_runs(void) {
    mr_rack* rack = NULL;
    uint16_t low = 0;
    if (mr_rack_open("card.c1 = \"mcx314\"", &rack) != MR_OK) {
        fprintf(stderr, "%s\n", mr_last_error());
        ++failures;
        return;
    }
    mr_write16(rack, "c1", 0x0e, 0);
    mr_write16(rack, "c1", 0x0c, 100);
    mr_write16(rack, "c1", 0x00, 0x0106);
    mr_write16(rack, "c1", 0x00, 0x0120);
    mr_advance_ns(rack, 1000000000);
    mr_write16(rack, "c1", 0x00, 0x0110);
    mr_read16(rack, "c1", 0x0c, &low);
    CHECK(low == 100);
    mr_rack_close(rack);
}

/* Registers by name, true values of the machine, a manually forced limit switch. */
static void a_limit_switch_stops_the_drive(void) {
    mr_rack* rack = NULL;
    CHECK(mr_rack_open("card.c1 = \"mcx314\"", &rack) == MR_OK);
    set_up(rack);
    CHECK(peeked(rack, "x.P") == 20000);
    CHECK(peeked(rack, "x.V") == 4000);
    CHECK(mr_write16(rack, "c1", WR0, AXIS_X | FIXED_PLUS) == MR_OK);
    CHECK(mr_advance_ns(rack, 200000000) == MR_OK);
    CHECK((peeked(rack, "RR0") & 1) == 1);
    CHECK(wire(rack, "c1.xlmtp") == 1);
    CHECK(mr_wire_set(rack, "c1.xlmtp", 0) == MR_OK);
    CHECK(wire(rack, "c1.xlmtp") == 0);
    CHECK(mr_advance_ns(rack, 1000000) == MR_OK);
    CHECK((peeked(rack, "RR0") & 1) == 0);
    CHECK((peeked(rack, "x.RR1") & 0x1000) != 0); /* stopped by nLMTP */
    CHECK((int64_t)peeked(rack, "x.LP") == (int64_t)part(rack, "X.position_pulses"));
    CHECK((int64_t)peeked(rack, "x.EP") == (int64_t)part(rack, "X.position_counts"));
    CHECK(part(rack, "X.position_mm") > 1 && part(rack, "X.position_mm") < 20);
    CHECK(mr_wire_set(rack, "c1.xlmtp", NAN) == MR_OK);
    CHECK(wire(rack, "c1.xlmtp") == 1);
    mr_rack_close(rack);
}

/* A copy is independent; the same calls give the same results. */
static void a_snapshot_is_a_world_of_its_own(void) {
    mr_rack *rack = NULL, *copy = NULL;
    CHECK(mr_rack_open("card.c1 = \"mcx314\"", &rack) == MR_OK);
    set_up(rack);
    CHECK(mr_write16(rack, "c1", WR0, AXIS_X | FIXED_PLUS) == MR_OK);
    CHECK(mr_advance_ns(rack, 50000000) == MR_OK);
    CHECK(mr_snapshot(rack, &copy) == MR_OK);
    CHECK(mr_state_hash(copy) == mr_state_hash(rack));
    CHECK(mr_now_ns(copy) == mr_now_ns(rack));
    CHECK(mr_advance_ns(rack, 1000000000) == MR_OK);
    CHECK(mr_state_hash(copy) != mr_state_hash(rack));
    CHECK(mr_advance_ns(copy, 1000000000) == MR_OK);
    CHECK(mr_state_hash(copy) == mr_state_hash(rack));
    mr_rack_close(rack);
    CHECK(logical_position(copy) == 20000);
    mr_rack_close(copy);
}

/* A broken encoder line: the counter stops while the machine moves. */
static void a_broken_track_stops_the_counter(void) {
    mr_rack* rack = NULL;
    CHECK(mr_rack_open("card.c1 = \"mcx314\"", &rack) == MR_OK);
    set_up(rack);
    CHECK(mr_fault(rack, "encoder.broken_a", "X") == MR_OK);
    CHECK(mr_write16(rack, "c1", WR0, AXIS_X | FIXED_PLUS) == MR_OK);
    CHECK(mr_advance_ns(rack, 2000000000) == MR_OK);
    CHECK(part(rack, "X.position_mm") == 20);
    CHECK((int64_t)peeked(rack, "x.EP") >= -1 && (int64_t)peeked(rack, "x.EP") <= 1);
    CHECK(mr_fault(rack, "encoder.unknown", "X") == MR_BAD_CALL);
    CHECK(strstr(mr_last_error(), "encoder.swapped") != NULL);
    mr_rack_close(rack);
}

static void tells_what_is_wrong(void) {
    mr_rack* rack = NULL;
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
    the_headers_example_runs();
    drives_a_fixed_number_of_pulses();
    a_limit_switch_stops_the_drive();
    a_snapshot_is_a_world_of_its_own();
    a_broken_track_stops_the_counter();
    tells_what_is_wrong();
    return failures == 0 ? 0 : 1;
}
