/* A closed servo loop around the DataBoard 4002: the host reads the card's counter, and the error of the position
 * becomes a voltage by the command R. The card's own positioning only gives the direction, with a target far away.
 *
 *   target ──(+)── error ── gain ──► volts ──► R ──► card ──► amplifier, motor ──► encoder
 *             └──────────────── counter ◄── P ◄── card ◄───────────────────────────────┘
 *
 * example_servo_rig rig.toml [RUN.csv]: with a second file it also writes the positions: seconds, counts of each run.
 */
#include <math.h>
#include <motionrack/c.h>
#include <stdio.h>
#include <stdlib.h>

enum { DATA = 0, STAT = 1, CS = 1, C2 = 3, CARD = 13, READY = 128 };
enum { TURN = 4000, FAR = 8000000 }; /* counts */
enum { SAMPLE_NS = 10000000, SAMPLES = 400, LAST_SECOND = 100 };

static mr_rack* rack;
static int direction; /* of the positioning that is on: +1, -1, or 0 at first */

static void must(int code) {
    if (code == MR_OK) return;
    fprintf(stderr, "%s\n", mr_last_error());
    exit(1);
}

/* ---- the card's commands */

static void wait_ready(void) {
    uint8_t status = 0;
    while ((status & READY) == 0) {
        must(mr_advance_ns(rack, 10000));
        must(mr_read8(rack, "c1", STAT, &status));
    }
}

static void command(char letter, long argument, int bytes) {
    wait_ready();
    must(mr_write8(rack, "c1", C2, (uint8_t)letter));
    for (; bytes > 0; --bytes, argument >>= 8) {
        wait_ready();
        must(mr_write8(rack, "c1", DATA, (uint8_t)(argument & 255)));
    }
}

/* P, read: three bytes with a sign. */
static long counter(void) {
    long value = 0;
    int i;
    command('P', 0, 0);
    for (i = 0; i < 3; ++i) {
        uint8_t byte = 0;
        wait_ready();
        must(mr_read8(rack, "c1", DATA, &byte));
        value |= (long)byte << (8 * i);
    }
    return value >= 0x800000 ? value - 0x1000000 : value;
}

/* ---- volts to rate: the printed table, in mV; between its rows the voltage follows the frequency */

static const int trim[][2] = {{10, 13799},   {25, 14051},   {50, 14339},   {75, 14565},   {100, 14745},  {150, 15014},
                              {200, 15207},  {250, 15351},  {300, 15463},  {350, 15547},  {400, 15628},  {500, 15750},
                              {750, 15921},  {1000, 16021}, {1500, 16130}, {2000, 16189}, {2500, 16225}, {3000, 16250},
                              {3500, 16269}, {4000, 16282}, {4500, 16293}, {5000, 16302}, {5500, 16310}, {6000, 16316},
                              {6500, 16321}, {7000, 16325}, {7500, 16330}, {8000, 16333}, {8500, 16335}, {9000, 16338},
                              {9500, 16341}, {10000, 16345}};
enum { ROWS = sizeof trim / sizeof *trim };

static double hz(int rate) {
    return 400e3 / (16384 - rate);
}

static int rate_of(double mv) {
    double f = hz(trim[0][1]) * mv / trim[0][0];
    int row;
    if (mv >= trim[ROWS - 1][0]) return trim[ROWS - 1][1];
    for (row = 1; row < ROWS; ++row) {
        const int* low = trim[row - 1];
        const int* high = trim[row];
        if (mv >= low[0] && mv < high[0])
            f = hz(low[1]) + (hz(high[1]) - hz(low[1])) * (mv - low[0]) / (high[0] - low[0]);
    }
    return f < 25 ? 384 : 16384 - (int)floor(400e3 / f + 0.5);
}

/* ---- the loop */

/* The voltage is at the output a millisecond later: R alone, or a new positioning where the sign changes. */
static void drive(double mv) {
    const int wanted = mv > 0 ? 1 : -1;
    if (mv != 0 && wanted != direction) {
        command('Q', 0, 0);
        command('P', wanted * (long)FAR, 3);
        command('R', rate_of(fabs(mv)), 2);
        command('G', 0, 0);
        direction = wanted;
    } else {
        command('R', mv == 0 ? 0 : rate_of(fabs(mv)), 2);
    }
}

/* Reads the counter and sets the voltage for it; returns the position. */
static long sample(double gain_mv) {
    const long position = counter();
    drive(gain_mv * (double)(TURN - position));
    return position;
}

static void run(const char* rig, double gain_mv, int load, long* positions) {
    char fault[40];
    long peak = 0, low = TURN * 100L, high = -TURN * 100L;
    int i;
    must(mr_rack_open(rig, &rack));
    sprintf(fault, "motor.load=%d", load);
    must(mr_fault(rack, fault, "C"));
    must(mr_write8(rack, "c1", CS, CARD));
    direction = 0;
    for (i = 0; i < SAMPLES; ++i) {
        const uint64_t next = mr_now_ns(rack) + SAMPLE_NS;
        positions[i] = sample(gain_mv);
        must(mr_advance_ns(rack, next - mr_now_ns(rack)));
        if (positions[i] > peak) peak = positions[i];
        if (i >= SAMPLES - LAST_SECOND && positions[i] < low) low = positions[i];
        if (i >= SAMPLES - LAST_SECOND && positions[i] > high) high = positions[i];
    }
    printf("%4.1f mV a count, load %2d: %5ld counts past the target; in the last second it swings by %5ld counts\n",
           gain_mv, load, peak > TURN ? peak - TURN : 0, high - low);
    mr_rack_close(rack);
}

int main(int argc, char** argv) {
    static const struct {
        double gain_mv;
        int load;
    } runs[] = {{1, 0}, {10, 0}, {1, 30}};
    static long positions[3][SAMPLES];
    FILE* csv;
    int i;
    if (argc < 2 || argc > 3) {
        fprintf(stderr, "Usage: example_servo_rig rig.toml [RUN.csv]\n");
        return 1;
    }
    for (i = 0; i < 3; ++i) run(argv[1], runs[i].gain_mv, runs[i].load, positions[i]);
    if (argc == 2) return 0;
    csv = fopen(argv[2], "w");
    if (csv == NULL) {
        fprintf(stderr, "%s could not be opened. The positions were not written.\n", argv[2]);
        return 5;
    }
    for (i = 0; i < SAMPLES; ++i)
        fprintf(csv, "%.2f,%ld,%ld,%ld\n", i * 1e-9 * SAMPLE_NS, positions[0][i], positions[1][i], positions[2][i]);
    return fclose(csv) == 0 ? 0 : 5;
}
