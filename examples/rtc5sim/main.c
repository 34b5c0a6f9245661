/* Runs the job on the virtual card and tells where it marked on the part. */
#include <rtc5sim.h>
#include <stdio.h>

int mark_square(int on_the_fly);

/* The marks, in mm on the part. */
struct Marked {
    int64_t begin; /* tick of the first mark */
    double least_x, greatest_x, least_y, greatest_y;
    long ticks;
};

static void look(void* user, UINT card, int64_t first, const int32_t* x, const int32_t* y, const uint8_t* laser,
                 size_t n) {
    struct Marked* marked = user;
    size_t i;
    (void)card;
    for (i = 0; i < n; ++i) {
        double on_part_x, on_part_y;
        if (!laser[i]) continue;
        if (marked->ticks++ == 0) marked->begin = first + (int64_t)i;
        /* The belt goes 1 um in a tick of 10 us. */
        on_part_x = x[i] / 5184.0 - (double)(first + (int64_t)i - marked->begin) * 0.001;
        on_part_y = y[i] / 5184.0;
        if (on_part_x < marked->least_x) marked->least_x = on_part_x;
        if (on_part_x > marked->greatest_x) marked->greatest_x = on_part_x;
        if (on_part_y < marked->least_y) marked->least_y = on_part_y;
        if (on_part_y > marked->greatest_y) marked->greatest_y = on_part_y;
    }
}

int main(void) {
    int on_the_fly;
    for (on_the_fly = 0; on_the_fly < 2; ++on_the_fly) {
        struct Marked marked = {0, 0, 0, 0, 0, 0};
        rtc5sim_on_samples(look, &marked);
        if (mark_square(on_the_fly) != 0) {
            fprintf(stderr, "%s\n", rtc5sim_last_error());
            return 1;
        }
        printf("fly %s: x %.2f .. %.2f mm, y %.2f .. %.2f mm on the part, laser on for %.2f ms\n",
               on_the_fly ? "on" : "off", marked.least_x, marked.greatest_x, marked.least_y, marked.greatest_y,
               (double)marked.ticks / 100);
    }
    return 0;
}
