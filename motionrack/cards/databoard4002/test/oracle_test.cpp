// The event-driven card against the looping twin: random programs of a host, a machine and manually operated switches
// must agree in every read, every change of an output, every condition and the pulses counted.
//
// MOTIONRACK_SEED and MOTIONRACK_PROGRAMS in the environment select other and more programs.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <motionrack/cards/databoard4002/test/program.hpp>
#include <string>
#include <tests/environment.hpp>

namespace motionrack::databoard4002::twin {
namespace {

template <class WayOf>
void compare(std::uint64_t first, std::uint64_t count, const WayOf& way_of) {
    const std::uint64_t seed = seed_from_environment();
    std::cout << "MOTIONRACK_SEED=" << seed << ", programs " << first << " .. " << first + count - 1 << std::endl;
    std::size_t ops = 0, changes = 0, notes = 0;
    std::int64_t slices = 0, pulses = 0;
    for (std::uint64_t number = first; number < first + count; ++number) {
        const Program program = make_program(seed, number);
        const Outcome twin = run_on_twin(program), card = run_on_card(program, way_of(program));
        const std::string fault = difference(program, twin, card);
        ASSERT_EQ(fault, "") << "program " << number << ", source " << static_cast<int>(program.strapping.source)
                             << ", pass " << program.strapping.firmware_pass_ticks << " ticks, byte "
                             << program.strapping.byte_slices << " slices, folding " << program.strapping.folding
                             << " from " << program.strapping.first_pair
                             << (program.strapping.up_down ? ", up/down" : "");
        ops += program.ops.size();
        changes += twin.changes.size();
        notes += twin.notes.size();
        slices += program.ops.back().slice;
        pulses += std::llabs(twin.sights.back().pulses);
    }
    std::cout << ops << " accesses and wire changes, " << slices / 2'000 << " ms, " << changes
              << " changes of outputs, " << notes << " conditions, " << pulses << " pulses net" << std::endl;
}

TEST(Databoard4002Oracle, RandomProgramsGiveTheSameReadingsOnTheCardAndItsTwin) {
    compare(0, cases("MOTIONRACK_PROGRAMS", 600), [](const Program& p) { return Way{p.number % 3 == 0, 0}; });
}

TEST(Databoard4002Oracle, ARestoredSnapshotContinuesIdentically) {
    compare(1'000'000, 60, [](const Program& p) { return Way{p.number % 2 == 0, 1 + p.number % (p.ops.size() - 1)}; });
}

}  // namespace
}  // namespace motionrack::databoard4002::twin
