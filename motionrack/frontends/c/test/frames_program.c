/* A C99 program that reads the scales of one instant from two cards of a grating bus, one of which is a listener only.
 * */
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

static const char* const crate =
    "[card.decoder]\ntype = \"grating_decoder\"\nscales = 10\n"
    "[card.host]\ntype = \"grating_bus\"\naddresses = \"5, 2, 9\"\n"
    "[card.slave]\ntype = \"grating_bus\"\naddresses = \"5, 2, 9\"\n";

/* Moves scale 2 forward by `counts`: forces its lines A and B in turn. */
static void turn(mr_rack* rack, int counts) {
    for (int i = 0; i < counts; ++i) {
        CHECK(mr_wire_set(rack, i % 2 == 0 ? "decoder.a2" : "decoder.b2", i % 4 < 2) == MR_OK);
        CHECK(mr_advance_ns(rack, 1000) == MR_OK);
    }
}

int main(void) {
    mr_rack* rack = NULL;
    mr_frame host, slave;
    CHECK(mr_rack_open(crate, &rack) == MR_OK);
    CHECK(mr_frame_read(rack, "slave", &slave) == MR_REFUSED);
    CHECK(strstr(mr_last_error(), "no frame yet") != NULL);
    turn(rack, 7);
    CHECK(mr_frame_wait(rack, "slave", 1000000, &slave) == MR_OK);
    CHECK(slave.sequence == 0 && slave.words == 3 && slave.time_100ps == 0);
    CHECK(mr_frame_wait(rack, "slave", 1000000, &slave) == MR_OK);
    CHECK(mr_frame_read(rack, "host", &host) == MR_OK);
    CHECK(memcmp(&host, &slave, sizeof host) == 0);
    CHECK(slave.sequence == 1 && slave.time_100ps == 2000000);
    CHECK(slave.addresses[0] == 5 && slave.addresses[1] == 2 && slave.addresses[2] == 9);
    CHECK(slave.counts[0] == 0 && slave.counts[1] == 7 && slave.counts[2] == 0 && slave.counts[3] == 0);
    CHECK(mr_fault(rack, "off", "host") == MR_OK);
    CHECK(mr_frame_wait(rack, "slave", 1000000, &slave) == MR_REFUSED);
    CHECK(strstr(mr_last_error(), "within 1000 us") != NULL);
    CHECK(mr_frame_read(rack, "slave", &slave) == MR_REFUSED);
    CHECK(strstr(mr_last_error(), "stale") != NULL);
    CHECK(slave.sequence == 1);
    mr_rack_close(rack);
    return failures == 0 ? 0 : 1;
}
