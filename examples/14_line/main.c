/* Marks every part that passes, while the line becomes quicker: when is it too quick? */
#include <rtc5sim.h>
#include <stdio.h>

#define K 5184L /* bits/mm */

/* A frame of 6 x 3 mm, which goes with the part. */
static void load_frame(void) {
    set_start_list(1);
    set_jump_speed(50000);
    set_mark_speed(500 * K / 1000.0); /* 500 mm/s */
    set_fly_x(K / 1000.0);            /* K bits/mm, 1000 counts/mm */
    mark_abs(6 * K, 0);
    mark_abs(6 * K, 3 * K);
    mark_abs(0, 3 * K);
    mark_abs(0, 0);
    fly_return(0, 0);
    set_end_of_list();
    set_control_mode(1); /* the start line starts list 1 */
}

static double part(const char* name) {
    double value = 0;
    if (rtc5sim_part_get(name, &value) != 0) fprintf(stderr, "%s\n", rtc5sim_last_error());
    return value;
}

int main(int argc, char** argv) {
    static const double speeds[] = {100, 250, 500, 800};
    size_t i;
    if (argc != 2 || rtc5sim_open(argv[1]) != 0) {
        fprintf(stderr, "%s\n", argc == 2 ? rtc5sim_last_error() : "usage: example_line RACK");
        return 1;
    }
    load_frame();
    for (i = 0; i < sizeof speeds / sizeof *speeds; ++i) {
        const double parts = part("line.parts"), marked = part("head.marked_mm"), energy = part("head.energy_j");
        double passed, frames;
        UINT info;
        rtc5sim_part_set("line.speed_mm_s", speeds[i]);
        rtc5sim_advance_us(2000000);
        passed = part("line.parts") - parts;
        frames = (part("head.marked_mm") - marked) / 18;
        printf("%3.0f mm/s: %3.0f parts in 2 s, %5.1f frames marked, %.2f J each\n", speeds[i], passed, frames,
               (part("head.energy_j") - energy) / frames);
        info = get_marking_info();
        if (info != 0) printf("          %s", rtc5sim_marking_info_text(info));
    }
    return rtc5sim_close();
}
