/* A marking job as it is written for the board: a square of 10 mm at 500 mm/s, on a belt at 100 mm/s. */
#include <rtc5sim.h>
#include <stdio.h>

static const double bits_per_mm = 5184, belt_mm_s = 100;

int mark_square(int on_the_fly) {
    const long side = 51840;
    UINT busy, position;
    if (init_rtc5_dll() != 0 || load_program_file(NULL) != 0 || load_correction_file(NULL, 1, 2) != 0) return 1;
    select_cor_table(1, 0);
    simulate_encoder(1);

    set_start_list(1);
    set_jump_speed(8000);
    set_mark_speed(2592); /* bits/ms */
    if (on_the_fly) set_fly_x(bits_per_mm * belt_mm_s / 1e6);
    mark_abs(side, 0);
    mark_abs(side, side);
    mark_abs(0, side);
    mark_abs(0, 0);
    fly_return(0, 0);
    set_end_of_list();
    if (get_last_error() != 0) return 1;

    execute_list(1);
    do {
        get_status(&busy, &position);
    } while (busy);
    return (get_marking_info() & 0xF) != 0; /* a corner was outside the field */
}
