/* Moves the axis of a real card there and back, stops it, and prints where it is: live_program PORT, e.g.
 * port:/dev/port,offset=0x300,gap_ns=1000. */
#include <databoard4002lib.h>
#include <stdio.h>

static int failed(void) {
    fprintf(stderr, "%s\n", databoard4002_last_error());
    return 1;
}

/* Sends the axis far away, stops it, and returns whether it stays where it is. */
static int stops(int card) {
    int here = 0, later = -1;
    if (databoard4002_set_number(card, 100000) < 0 || databoard4002_go(card) < 0 ||
        databoard4002_advance_ms(card, 50) < 0 || databoard4002_stop(card) < 0)
        return 0;
    if (databoard4002_go(card) == 0 || databoard4002_reset_stop(card) < 0) return 0;
    if (databoard4002_position(card, &here) < 0 || databoard4002_advance_ms(card, 50) < 0 ||
        databoard4002_position(card, &later) < 0)
        return 0;
    return here == later && here > -40;
}

int main(int count, char** words) {
    int card, counts = 0;
    int64_t begun, value = 0;
    if (count != 2) return fprintf(stderr, "usage: live_program PORT\n"), 1;
    card = databoard4002_open(words[1], 13);
    if (card < 0 || databoard4002_athome(card) < 0 || databoard4002_set_rate(card, 15984) < 0) return failed();
    begun = databoard4002_now_us(card);
    if (databoard4002_move_to(card, 250, 10000) < 0 || databoard4002_position(card, &counts) < 0) return failed();
    printf("It is at %d counts after %s\n", counts,
           databoard4002_now_us(card) - begun > 100000 ? "its time" : "no time");
    if (databoard4002_move_by(card, -290, 10000) < 0 || databoard4002_position(card, &counts) < 0) return failed();
    printf("and at %d counts\n", counts);
    if (!stops(card)) return failed();
    printf("stopped: %s\n", databoard4002_last_error());
    if (databoard4002_open(NULL, 14) > 0) return 1;
    printf("%s\n", databoard4002_last_error());
    if (databoard4002_peek(card, "POSITION", &value) == 0) return 1;
    printf("%s\n", databoard4002_last_error());
    return databoard4002_close(card) == 0 ? 0 : 1;
}
