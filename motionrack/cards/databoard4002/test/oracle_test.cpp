// The event-driven card against the looping twin: random programs of a host, a machine and manually operated switches
// must agree in every read, every change of an output, every condition and the pulses counted.
//
// tests/oracle/harness.hpp names the variables of the environment that select other and more programs.
#include <gtest/gtest.h>

#include <motionrack/cards/databoard4002/test/program.hpp>
#include <tests/oracle/harness.hpp>

namespace motionrack::databoard4002::twin {
namespace {

TEST(Databoard4002Oracle, RandomProgramsGiveTheSameReadingsOnTheCardAndItsTwin) {
    oracle::compare({0, oracle::programs(600)}, [](std::uint64_t seed, std::uint64_t number) {
        Program program = make_program(seed, number);
        program.follow_fout = number % 3 == 0;
        return program;
    });
}

TEST(Databoard4002Oracle, ARestoredSnapshotContinuesIdentically) {
    oracle::compare({1'000'000, 60}, [](std::uint64_t seed, std::uint64_t number) {
        Program program = make_program(seed, number);
        program.follow_fout = number % 2 == 0;
        program.snapshot_at = 1 + number % (program.ops.size() - 1);
        return program;
    });
}

}  // namespace
}  // namespace motionrack::databoard4002::twin
