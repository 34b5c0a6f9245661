// The recorded edges of a card's wires agree with the card's counter, for all moves and all ends of moves.
// MOTIONRACK_SEED=N selects the moves, MOTIONRACK_MOVES=N sets their number.
#include <motionrack/rack/test/encoder_edges.hpp>

namespace motionrack::rack {
namespace {

std::uint64_t moves() {
    return cases("MOTIONRACK_MOVES", 50);
}

TEST(RecordedEdges, AreTheLogicalPositionOfTheMcx314) {
    count_mcx314(moves(), 'x', false);
    count_mcx314(moves(), 'u', true);
}

TEST(RecordedEdges, AreThePositionOfTheDataBoard4002) {
    count_databoard4002(moves());
}

TEST(RecordedEdges, AreTheFramesOfTheGratingBus) {
    for (const char* card : {"c1", "c2"}) count_grating_bus(moves(), card);
}

TEST(RecordedEdges, OfAnEncoderAreThePositionsOfAllCardsThatCountIt) {
    count_encoder(moves(), 'X', {});
    count_encoder(moves(), 'Y', {.counts_per_rev = 12'800});
}

TEST(RecordedEdges, OfAnEncoderAreThePositionsAlsoWhereTheMotorLosesSteps) {
    count_encoder(moves(), 'X', {.loses_steps = true});
}

TEST(RecordedEdges, OfAnEncoderAreThePositionsAlsoWhereAPulseIsManyCounts) {
    count_encoder(moves(), 'X', {.counts_per_rev = 100'000});
}

}  // namespace
}  // namespace motionrack::rack
