/* Drives a card from C: a move by register writes, a limit switch hit by hand, and what would have happened without it.
 */
#include <math.h>
#include <motionrack/c.h>
#include <stdio.h>
#include <stdlib.h>

static void must(int code) {
    if (code == MR_OK) return;
    fprintf(stderr, "%s\n", mr_last_error());
    exit(1);
}

/* A data command of the MCX314: the value in WR7, WR6, then the command with the axis in WR0. */
static void command(mr_rack* rack, unsigned axes, unsigned code, uint32_t value) {
    must(mr_write16(rack, "c1", 0x0e, (uint16_t)(value >> 16)));
    must(mr_write16(rack, "c1", 0x0c, (uint16_t)(value & 0xffff)));
    must(mr_write16(rack, "c1", 0x00, (uint16_t)(axes << 8 | code)));
}

static void tell(mr_rack* rack, const char* who) {
    uint64_t status = 0, pulses = 0, counts = 0;
    double position = 0;
    must(mr_peek(rack, "c1", "x.RR1", &status));
    must(mr_peek(rack, "c1", "x.LP", &pulses));
    must(mr_peek(rack, "c1", "x.EP", &counts));
    must(mr_part_get(rack, "X.position_mm", &position));
    printf("%s: %lld pulses, %lld counts, the table is at %.3f mm%s\n", who, (long long)pulses, (long long)counts,
           position, (status & 0x1000) != 0 ? ", stopped by the + limit" : "");
}

int main(void) {
    enum { X = 1, R = 0x00, A = 0x02, SV = 0x04, V = 0x05, P = 0x06, LP = 0x09, FIXED_PLUS = 0x20 };
    mr_rack *rack = NULL, *otherwise = NULL;
    must(mr_rack_open("card.c1 = \"mcx314\"", &rack));

    command(rack, X, R, 800000); /* speeds in units of 10 pulses a second */
    command(rack, X, A, 400);    /* 500,000 pulses a second, each second */
    command(rack, X, SV, 100);
    command(rack, X, V, 4000); /* 40,000 pulses a second: 40 mm/s */
    command(rack, X, LP, 0);
    command(rack, X, P, 20000);
    command(rack, X, FIXED_PLUS, 0);
    must(mr_advance_ns(rack, 300000000));
    tell(rack, "after 0.3 s");

    must(mr_snapshot(rack, &otherwise));
    must(mr_wire_set(rack, "c1.xlmtp", 0)); /* the limit switch is pressed */
    must(mr_advance_ns(rack, 1000000000));
    must(mr_advance_ns(otherwise, 1000000000));
    tell(rack, "with the switch pressed");
    tell(otherwise, "without");

    must(mr_wire_set(rack, "c1.xlmtp", NAN)); /* and lets it go */
    mr_rack_close(otherwise);
    mr_rack_close(rack);
    return 0;
}
