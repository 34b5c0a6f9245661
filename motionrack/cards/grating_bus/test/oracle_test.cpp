// Compares the event-driven cards with their slow twin: random programs of cards, faults and stuck lines must give the
// same result, with any listeners on wires.
//
// tests/oracle/harness.hpp names the variables of the environment that select other and more programs.
#include <gtest/gtest.h>

#include <motionrack/cards/grating_bus/test/outcome.hpp>
#include <tests/oracle/harness.hpp>

namespace motionrack::grating_bus::twin {

void run_both(const Program& program, oracle::Comparison& both) {
    const Outcome twin = on_twin(program);
    for (const Watch watch : {Watch::nobody, Watch::everybody, Watch::now_and_then}) {
        const Outcome cards = on_cards(program, watch);
        oracle::Comparison now;
        now.same_elements("frame", twin.frames, cards.frames);
        now.same_elements("look", twin.looks, cards.looks);
        now.same_elements("conflict", twin.conflicts, cards.conflicts);
        now.same_elements("report", twin.reports, cards.reports);
        if (watch == Watch::everybody) now.same_elements("change", twin.changes, cards.changes);
        now.same("conflicts", twin.conflict_count, cards.conflict_count);
        if (!now.equal()) both.note(fmt::format("watched by {}\n{}", static_cast<int>(watch), now.differences()));
    }
    both.count("frames", twin.frames.size());
    both.count("conflicts", twin.conflict_count);
    both.count("changes of wires", twin.changes.size());
    both.count("reports", twin.reports.size());
    both.count("looks", twin.looks.size());
}

namespace {

constexpr std::uint64_t usual_seed = 20'261'121;

TEST(GratingBusOracle, RandomProgramsGiveTheSameReadingsOnTheCardsAndTheirTwin) {
    oracle::compare({0, oracle::programs(2500), usual_seed},
                    [](std::uint64_t seed, std::uint64_t number) { return Maker(seed + number).make(); });
}

TEST(GratingBusOracle, ARestoredSnapshotContinuesIdentically) {
    constexpr std::uint64_t first = 1'000'000;
    oracle::compare({first, oracle::programs(500), usual_seed}, [](std::uint64_t seed, std::uint64_t number) {
        Program program = Maker(seed + number).make();
        program.snapshot_at = (number - first) % program.ops.size();
        return program;
    });
}

}  // namespace
}  // namespace motionrack::grating_bus::twin
