/* A C99 program against databoard4002lib.h: every function of the card has its type, and an axis moves. */
#include <databoard4002lib.h>
#include <stdio.h>
#include <string.h>

static int failures = 0;

#define CHECK(condition)                                                                             \
    do {                                                                                             \
        if (!(condition)) {                                                                          \
            fprintf(stderr, "line %d: %s (%s)\n", __LINE__, #condition, databoard4002_last_error()); \
            ++failures;                                                                              \
        }                                                                                            \
    } while (0)

typedef int (*plain)(int);
typedef int (*with_value)(int, int);
typedef int (*with_answer)(int, int*);
typedef int (*with_both)(int, int, int*);
typedef int (*move)(int, int, int);
typedef int (*five_ints)(int, int, int, int, int);

/* A mismatch does not compile. */
const plain commands[] = {databoard4002_athome,        databoard4002_go,     databoard4002_initialise,
                          databoard4002_lock,          databoard4002_manual, databoard4002_quit,
                          databoard4002_on_regulation, databoard4002_reset,  databoard4002_clear_watch_out};
const with_value setters[] = {databoard4002_set_deviation, databoard4002_set_number, databoard4002_set_target,
                              databoard4002_set_rate};
const with_answer getters[] = {databoard4002_deviation, databoard4002_position, databoard4002_rate,
                               databoard4002_version,   databoard4002_status,   databoard4002_disable_events};
const with_both events[] = {databoard4002_enable_events};
const move moves[] = {databoard4002_move_to, databoard4002_move_by};
const five_ints others[] = {databoard4002_find_zero, databoard4002_design_slope};
#define COUNT(table) (sizeof(table) / sizeof(table)[0])

static void every_function_of_the_card_is_there(void) {
    CHECK(COUNT(commands) + COUNT(setters) + COUNT(getters) + COUNT(events) + COUNT(moves) + COUNT(others) == 24);
}

static void a_move_ends_where_it_should(void) {
    int counts = 0, word = 0;
    const int card = databoard4002_open("card.c1 = \"databoard4002\"", 13);
    CHECK(card == 1);
    CHECK(databoard4002_set_rate(card, 15984) == 0);
    CHECK(databoard4002_move_to(card, 250, 10000) == 0);
    CHECK(databoard4002_position(card, &counts) == 0);
    CHECK(counts == 250);
    CHECK(databoard4002_status(card, &word) == 0);
    CHECK((word & (DATABOARD4002_STAT_EMS | DATABOARD4002_STAT_ESL | DATABOARD4002_STAT_ESR)) == 0);
    CHECK(strcmp(databoard4002_last_error(), "") == 0);
    CHECK(databoard4002_close(card) == 0);
    CHECK(databoard4002_close(card) == -1);
    CHECK(strcmp(databoard4002_last_error(), "") != 0);
    databoard4002_clear_error();
    CHECK(strcmp(databoard4002_last_error(), "") == 0);
}

int main(void) {
    every_function_of_the_card_is_there();
    a_move_ends_where_it_should();
    return failures == 0 ? 0 : 1;
}
