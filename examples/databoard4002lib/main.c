/* Moves the axis of a DataBoard 4002: a move at one rate, one that follows a slope, and one whose end the program waits
 * for by itself. Without an argument the card is virtual; an argument names a rack file or a real card. */
#include <databoard4002lib.h>
#include <stdio.h>

enum { number_of_card = 13, one_khz = 16384 - 400 };

static int card;

static void show(const char* what) {
    int counts = 0;
    if (databoard4002_position(card, &counts) == 0)
        printf("%s: at %d counts\n", what, counts);
    else
        printf("%s: %s\n", what, databoard4002_last_error());
}

/* Starts a move and looks at the card ten times a second until the move ends. */
static void move_and_watch(int counts) {
    int word = 0;
    if (databoard4002_enable_events(card, DATABOARD4002_POSITION | DATABOARD4002_STOP, &word) != 0) return;
    if (databoard4002_set_number(card, counts) != 0 || databoard4002_go(card) != 0) return;
    while (databoard4002_status(card, &word) == 0 && (word & DATABOARD4002_STAT_EVENT) == 0)
        databoard4002_advance_ms(card, 100);
    if (databoard4002_disable_events(card, &word) == 0)
        printf("%s\n", (word & DATABOARD4002_POSITION) != 0 ? "event: position reached" : "event: stop");
}

int main(int count, char** words) {
    card = databoard4002_open(count > 1 ? words[1] : "card.c1 = \"databoard4002\"", number_of_card);
    if (card < 0) {
        fprintf(stderr, "%s\n", databoard4002_last_error());
        return 1;
    }
    databoard4002_set_rate(card, one_khz);
    databoard4002_move_to(card, 250, 10000);
    show("at one rate");

    databoard4002_design_slope(card, 10000, 100000, 1000, 0);
    databoard4002_on_regulation(card);
    databoard4002_move_to(card, 5000, 10000);
    show("with a slope");

    move_and_watch(-1000);
    show("watched");

    if (databoard4002_move_to(card, 9000000, 10000) != 0) printf("%s\n", databoard4002_last_error());
    return databoard4002_close(card) == 0 ? 0 : 1;
}
