/* The manufacturer's two demonstration programs for the DataBoard 4002, the functional test and the examples, executed
 * port by port with their results checked. */
#include "databoard4002_host.h"

/* ---- expected values
 * ----------------------------------------------------------------------------------------------- */

/* Duration of `counts` according to the description. Each count uses the lowest speed of three: by the distance
 * travelled, by the distance to go, and Rate. A rate r gives 400 kHz / (16384 - r). */
static uint64_t leg_ns(long counts, unsigned stretch, unsigned rate) {
    uint64_t ns = 0;
    long done;
    for (done = 0; done < counts; ++done) {
        unsigned up = acceleration[INTERVALS - 1][0], down = up, at;
        int i;
        for (i = INTERVALS - 1; i >= 0; --i) {
            if (done < (long)(acceleration[i][1] * stretch * 256)) up = acceleration[i][0];
            if (counts - done <= (long)(deceleration[i][1] * stretch * 256)) down = deceleration[i][0];
        }
        at = up < down ? up : down;
        if (rate < at) at = rate;
        ns += (uint64_t)(16384 - at) * 2500;
    }
    return ns;
}

/* One move of the demonstration, with its result. */
static void leg(host* h, const listing* l, unsigned target, unsigned stretch, unsigned rate) {
    const long from = position(h), to = (long)target * 256, way = to > from ? to - from : from - to;
    const uint64_t start = mr_now_ns(h->rack), expected = leg_ns(way, stretch, rate);
    uint64_t took;
    go_position(h, l, target, 200000ull * MS);
    took = mr_now_ns(h->rack) - start;
    CHECK(position(h) == to);
    /* Adds the commands before G and after the event; between two speeds the current period is completed. */
    CHECK(took > expected - 10 * MS && took < expected + 120 * MS);
    if (took <= expected - 10 * MS || took >= expected + 120 * MS)
        fprintf(stderr, "%s to %u: %.4f s, expected %.4f s\n", l->name, target, (double)took * 1e-9,
                (double)expected * 1e-9);
    quit(h, l);
    CHECK(position(h) == to);
    CHECK(part(h, "c1.fout_hz") == 0 && wire(h, "c1.vout") == 0);
}

static void the_demonstration_runs(const listing* l, int laps) {
    static const uint8_t first[] = {C2,   'I',        C2,   'D', DATA, 25, DATA, 0,   DATA, 0,
                                    C2,   'R',        DATA, 240, DATA, 63, C2,   'S', DATA, 14000 & 255,
                                    DATA, 14000 >> 8, DATA, 0,   DATA, 1,  DATA, 0};
    static const uint8_t last[] = {DATA, 16344 & 255, DATA, 16344 >> 8, DATA, 0,
                                   DATA, 600 & 255,   DATA, 600 >> 8,   C2,   'O'};
    static const uint8_t move[] = {C2,          'P',  DATA, 0,   DATA, 1000 & 255, DATA,        1000 >> 8, C4, 33,
                                   0x40 + DATA, 0x80, C2,   'G', C4,   33,         0x40 + DATA, 0x81,      C2, 'L'};
    host h = host_open();
    int lap;
    init(&h, l);
    for (lap = 1; lap <= laps; ++lap) {
        max_speed(&h, l, 63 * 256 + 240);
        store_slope(&h, l, 1);
        leg(&h, l, 1000, 1, 16383);
        out_strobe(&h, l, C2, 'L');
        if (lap == 1) {
            /* Ten accesses up to S, 240 bytes, O, the move, L: in this order, with these bytes. */
            const unsigned table = 2 * 9, after = table + 2 * 240 + 2;
            CHECK(h.taped == after + sizeof move);
            CHECK(memcmp(h.tape, first, sizeof first) == 0);
            CHECK(memcmp(h.tape + after - sizeof last, last, sizeof last) == 0);
            CHECK(memcmp(h.tape + after, move, sizeof move) == 0);
        }
        quit(&h, l);
        out_strobe(&h, l, C2, 'M');
        store_slope(&h, l, l->stretch_2);
        max_speed(&h, l, 63 * 256 + 240);
        leg(&h, l, 500, l->stretch_2, 63 * 256 + 240);
        max_speed(&h, l, 63 * 256);
        leg(&h, l, 0, l->stretch_2, 63 * 256);
    }
    CHECK(!h.gave_up);
    CHECK(h.max_wait_ns < 127 * MS);
    CHECK(h.max_wait_ns < 4 * MS); /* one or two BASIC statements; far less for the assembler's polls */
    CHECK(strstr(h.said, "STOP") == NULL && strstr(h.said, "MARGIN") == NULL);
    mr_rack_close(h.rack);
}

/* ---- stops
 * ---------------------------------------------------------------------------------------------------------------- */

static void a_margin_is_told_and_the_move_goes_on_when_it_is_released(const listing* l) {
    static const happening done[] = {{9000ull * MS, "c1.esr", 1},
                                     {12000ull * MS, "c1.esl", 1},
                                     {13000ull * MS, "c1.esl", 0},
                                     {15000ull * MS, "c1.esr", 0}};
    host h = host_open();
    char said[sizeof h.said];
    uint64_t start, expected = leg_ns(256000, 1, 16383) + 6000ull * MS;
    h.next = done, h.end = done + sizeof done / sizeof *done;
    init(&h, l);
    store_slope(&h, l, 1);
    start = mr_now_ns(h.rack);
    go_position(&h, l, 1000, 200000ull * MS);
    CHECK(!h.gave_up);
    CHECK(position(&h) == 256000);
    CHECK(mr_now_ns(h.rack) - start > expected - 20 * MS && mr_now_ns(h.rack) - start < expected + 130 * MS);
    /* The edge of ESR, then that of ESL while ESR is still there: only the BASIC program reports both then. */
    snprintf(said, sizeof said, "%s|%s|%s%s", l->right, l->left, l->keeps_status ? l->right : "",
             l->keeps_status ? "|" : "");
    CHECK(strcmp(h.said, said) == 0);
    mr_rack_close(h.rack);
}

static void after_an_emergency_stop_nothing_moves_until_the_next_go(const listing* l) {
    static const happening done[] = {{32000ull * MS, "c1.ems", 1}, {32500ull * MS, "c1.ems", 0}};
    host h = host_open();
    long there;
    h.next = done, h.end = done + sizeof done / sizeof *done;
    init(&h, l);
    store_slope(&h, l, 1);
    go_position(&h, l, 1000, 33000ull * MS);
    CHECK(h.gave_up); /* neither program can leave its wait */
    CHECK(strcmp(h.said, "EMERGENCY STOP.|") == 0);
    there = position(&h);
    CHECK(there > 10000 && there < 51200);
    CHECK(wire(&h, "c1.vout") == 0 && part(&h, "c1.fout_hz") == 0);
    CHECK(wire(&h, "c1.relay") == 1); /* closed again: Rate is kept, the output is 0 V */
    h.gave_up = 0;
    out_strobe(&h, l, C2, 'M');
    max_speed(&h, l, 16344);
    go_position(&h, l, 200, 10000ull * MS);
    CHECK(!h.gave_up && position(&h) == 51200);
    mr_rack_close(h.rack);
}

/* ---- the description's own examples
 * --------------------------------------------------------------------------------------- */

/* "Uppstart av 4002": items 2 to 8. */
static void the_functional_test_passes(void) {
    host h = host_open();
    CHECK(in(&h, STAT) == 0xff); /* no card is selected yet */
    out(&h, CS, CARD);
    CHECK(in(&h, STAT) == READY);
    out_strobe(&h, &assembler, C4, 0);
    CHECK(in_strobe(&h, &assembler, DATA) == 0x80); /* it was reset */
    out_strobe(&h, &assembler, C2, 0x57);
    out_strobe(&h, &assembler, C4, 0);
    CHECK(in_strobe(&h, &assembler, DATA) == 0);
    out_strobe(&h, &assembler, C2, 'V');
    CHECK(in_strobe(&h, &assembler, DATA) == 0x20);
    out(&h, CS, CARD + 1); /* selects another card: this one neither answers nor accepts commands */
    out(&h, C2, 'A');
    CHECK(in(&h, STAT) == 0xff);
    out(&h, CS, CARD);
    wait_ready(&h, &assembler);
    CHECK(in(&h, STAT) == READY);
    CHECK(!h.gave_up);
    mr_rack_close(h.rack);
}

static long number_from(host* h, int command, int bytes) {
    unsigned long value = 0, sign = 1ul << (8 * bytes - 1);
    int i;
    out_strobe(h, &assembler, C2, (unsigned)command);
    for (i = 0; i < bytes; ++i) value |= (unsigned long)in_strobe(h, &assembler, DATA) << (8 * i);
    return (long)(value ^ sign) - (long)sign;
}

/* Ten pulses to the left, as on the page about C2; then forward by N, back by P, with an interrupt at the end. */
static void numbers_positions_and_interrupts(void) {
    host h = host_open();
    unsigned round;
    out(&h, CS, CARD);
    max_speed(&h, &assembler, 16344);
    out_strobe(&h, &assembler, C2, 'N');
    out_strobe(&h, &assembler, DATA, (unsigned)-10);
    out_strobe(&h, &assembler, DATA, (unsigned)-10 >> 8);
    out_strobe(&h, &assembler, DATA, (unsigned)-1);
    pass(&h, 100 * MS);
    CHECK(position(&h) == 0); /* no motion before G */
    out_strobe(&h, &assembler, C2, 'G');
    pass(&h, 5 * MS);
    CHECK(position(&h) == -10);
    CHECK(number_from(&h, 'P', 3) == -10);
    CHECK(wire(&h, "c1.sign") == 0);
    for (round = 1; round <= 3; ++round) {
        unsigned looks = 0;
        out_strobe(&h, &assembler, C4, 0x81); /* interrupt when the position is reached */
        (void)in_strobe(&h, &assembler, DATA);
        CHECK(wire(&h, "c1.int") == 0);
        out_strobe(&h, &assembler, C2, 'G'); /* ten more to the left */
        while (wire(&h, "c1.int") == 0 && ++looks < 1000) pass(&h, MS / 10);
        CHECK(looks >= 8 && looks <= 13); /* ten pulses at 10 kHz */
        CHECK((in(&h, STAT) & (EVENT | INTERRUPT)) == (EVENT | INTERRUPT));
        out_strobe(&h, &assembler, C4, 0x81);
        wait_ready(&h, &assembler);
        CHECK(wire(&h, "c1.int") == 0);
        CHECK((in_strobe(&h, &assembler, DATA) & 0x7f) == 0x01);
        CHECK(number_from(&h, 'P', 3) == -10 - 10 * (long)round);
    }
    CHECK(number_from(&h, 'D', 3) == 0 && number_from(&h, 'R', 2) == 0);
    out_strobe(&h, &assembler, C4, 0x40); /* interrupt while Ready: inactive while an access is processed */
    wait_ready(&h, &assembler);
    CHECK(wire(&h, "c1.int") == 1);
    out(&h, C2, 'W');
    CHECK(wire(&h, "c1.int") == 0);
    wait_ready(&h, &assembler);
    CHECK(wire(&h, "c1.int") == 1);
    mr_rack_close(h.rack);
}

/* C3 and INP 7 during a move: 0 V at once, Ready, and the flag in the EVENT word. */
static void both_resets_stop_at_once(void) {
    int all;
    for (all = 0; all <= 1; ++all) {
        host h = host_open();
        long there;
        init(&h, &assembler);
        store_slope(&h, &assembler, 1);
        out_strobe(&h, &assembler, C2, 'P');
        out_strobe(&h, &assembler, DATA, 0);
        out_strobe(&h, &assembler, DATA, 232);
        out_strobe(&h, &assembler, DATA, 3);
        out_strobe(&h, &assembler, C2, 'G');
        pass(&h, 30000ull * MS);
        CHECK(wire(&h, "c1.vout") > 0.1 && position(&h) > 1000);
        if (all)
            (void)in(&h, RST);
        else
            out(&h, C3, 0);
        CHECK(wire(&h, "c1.vout") == 0 && wire(&h, "c1.relay") == 0);
        there = position(&h);
        pass(&h, 1000 * MS);
        CHECK(there == 0 && position(&h) == 0); /* the reset sets the position to 0 */
        CHECK(in(&h, STAT) == READY);
        out_strobe(&h, &assembler, C4, 0);
        CHECK(in_strobe(&h, &assembler, DATA) == 0x80);
        mr_rack_close(h.rack);
    }
}

int main(void) {
    const listing* const listings[] = {&assembler, &basic};
    int i;
    the_functional_test_passes();
    numbers_positions_and_interrupts();
    both_resets_stop_at_once();
    for (i = 0; i < 2; ++i) {
        the_demonstration_runs(listings[i], 1 + i);
        a_margin_is_told_and_the_move_goes_on_when_it_is_released(listings[i]);
        after_an_emergency_stop_nothing_moves_until_the_next_go(listings[i]);
    }
    return failures == 0 ? 0 : 1;
}
