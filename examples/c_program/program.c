/* A part program on two axes, from C: homed, driven, recorded; then again with a motor that loses steps. */
#include <motionrack/c.h>
#include <stdio.h>
#include <stdlib.h>

static const char* const machine =
    "[card.c1]\ntype = \"mcx314\"\n"
    "[axis.X]\ncard = \"c1\"\nchannel = \"x\"\nmax_limit_mm = 300\ninitial_position_mm = 5\n"
    "[axis.X.switches]\nhome_mm = 1\nlimit_minus_mm = -1\nlimit_plus_mm = 301\n"
    "[axis.Y]\ncard = \"c1\"\nchannel = \"y\"\nmax_limit_mm = 200\n";

static const char* const part =
    "G21 G90\n"
    "G1 X25 Y10 F1200\n"
    "G2 X35 Y20 I10\n"
    "G1 X5 Y0\n"
    "M2\n";

static void must(int code) {
    if (code == MR_OK) return;
    fprintf(stderr, "%s\n", mr_last_error());
    exit(1);
}

/* Every 50 ms of virtual time; an answer of 1 would stop the program. */
static int progress(void* user, double seconds, int64_t line, int64_t lines) {
    int64_t* shown = user;
    if (line != *shown) printf("  %.2f s: line %d of %d\n", seconds, (int)line, (int)lines);
    *shown = line;
    return 0;
}

/* Each condition, when it happens. */
static void happened(void* user, uint64_t number, int64_t at_100ps, const char* card, int code, const char* sentence) {
    (void)user, (void)number, (void)at_100ps, (void)card, (void)code;
    printf("  %s\n", sentence);
}

/* The faults of axis X. */
static void list(void* user, const mr_fault_info* fault) {
    (void)user;
    if (fault->target[0] == 'X' && fault->unit[0] != '\0')
        printf("  %s=%g .. %g %s\n", fault->name, fault->min, fault->max, fault->unit);
}

static void run(const char* fault, const char* recording) {
    mr_rack* rack = NULL;
    mr_run_result result;
    int64_t line = -1;
    mr_run_options options = {0};
    options.progress = progress;
    options.user = &line;
    must(mr_rack_open(machine, &rack));
    must(mr_on_condition(rack, happened, NULL));
    if (fault != NULL) must(mr_fault(rack, fault, "X"));
    if (recording != NULL) must(mr_trace_start(rack, recording, "X.step X.dir Y.*"));
    if (mr_run_program(rack, part, &options, &result) != MR_OK) printf("%s\n", mr_last_error());
    if (recording != NULL) must(mr_trace_stop(rack));
    printf("%s: %.3f s, %.3f mm, %.3f mm off the path at most\n", result.ok ? "good" : "not good", result.seconds,
           result.path_mm, result.deviation_mm);
    must(mr_home(rack, "X"));
    printf("homed at %.3f s\n", (double)mr_now_ns(rack) * 1e-9);
    mr_rack_close(rack);
}

int main(int argc, char** argv) {
    mr_rack* rack = NULL;
    must(mr_rack_open(machine, &rack));
    printf("What X can have:\n");
    must(mr_faults(rack, list, NULL));
    if (mr_run_program(rack, "G21 G90\nG1 X4000 F600\n", NULL, NULL) == MR_BAD_INPUT) printf("%s\n", mr_last_error());
    mr_rack_close(rack);
    printf("As it should be:\n");
    run(NULL, argc > 1 ? argv[1] : NULL);
    printf("With a motor that has lost steps:\n");
    run("motor.lose_steps=64", NULL);
    return 0;
}
