// Random programs of cards, faults and stuck lines give the same result on the event-driven cards and on their slow
// twin, with any listeners on wires.
//
// MOTIONRACK_SEED and MOTIONRACK_PROGRAMS in the environment select other and more programs.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <motionrack/cards/grating_bus/test/outcome.hpp>
#include <tests/environment.hpp>

namespace motionrack::grating_bus::twin {
namespace {

/// The first difference as text.
std::string difference(const char* what, const std::vector<std::string>& twin, const std::vector<std::string>& cards) {
    if (twin == cards) return "";
    std::size_t i = 0;
    while (i < twin.size() && i < cards.size() && twin[i] == cards[i]) ++i;
    const auto at = [i](const std::vector<std::string>& all) { return i < all.size() ? all[i] : "none"; };
    std::string out = what;
    out.append(" ")
        .append(std::to_string(i))
        .append("\n  twin:  ")
        .append(at(twin))
        .append("\n  cards: ")
        .append(at(cards))
        .append("\n");
    return out;
}

void compare_with_twin(std::uint64_t first, std::uint64_t programs, bool with_snapshot) {
    const std::uint64_t seed = seed_from_environment(20'261'121) + first;
    std::cout << "seed " << seed << ", " << programs << " programs" << std::endl;
    std::size_t frames = 0, conflicts = 0, changes = 0, reports = 0, looks = 0;
    for (std::uint64_t number = 0; number < programs; ++number) {
        const Program program = Maker(seed + number).make();
        const Outcome twin = on_twin(program);
        for (const Watch watch : {Watch::nobody, Watch::everybody, Watch::now_and_then}) {
            const Outcome cards =
                on_cards(program, watch, with_snapshot ? number % program.ops.size() : program.ops.size());
            std::string differs = difference("frame", twin.frames, cards.frames) +
                                  difference("look", twin.looks, cards.looks) +
                                  difference("conflict", twin.conflicts, cards.conflicts) +
                                  difference("report", twin.reports, cards.reports);
            if (watch == Watch::everybody) differs += difference("change", twin.changes, cards.changes);
            ASSERT_EQ(differs, "") << "program " << number << " of seed " << seed << ", watched by "
                                   << static_cast<int>(watch) << "\n"
                                   << text_of(program);
            ASSERT_EQ(twin.conflict_count, cards.conflict_count) << "program " << number << " of seed " << seed << "\n"
                                                                 << text_of(program);
        }
        frames += twin.frames.size(), conflicts += twin.conflict_count, changes += twin.changes.size(),
            reports += twin.reports.size();
        looks += twin.looks.size();
    }
    std::cout << frames << " frames, " << conflicts << " conflicts, " << changes << " changes of wires, " << reports
              << " reports, " << looks << " looks" << std::endl;
}

TEST(GratingBusOracle, RandomProgramsGiveTheSameReadingsOnTheCardsAndTheirTwin) {
    compare_with_twin(0, cases("MOTIONRACK_PROGRAMS", 2500), false);
}

TEST(GratingBusOracle, ARestoredSnapshotContinuesIdentically) {
    compare_with_twin(1'000'000, cases("MOTIONRACK_PROGRAMS", 2500) / 5, true);
}

}  // namespace
}  // namespace motionrack::grating_bus::twin
