// A thousand moves per card. MOTIONRACK_SEED=N selects the moves, MOTIONRACK_MOVES=N sets their number.
#include <motionrack/rack/test/encoder_edges.hpp>
#include <tuple>

namespace motionrack::rack {
namespace {

std::uint64_t moves() {
    return cases("MOTIONRACK_MOVES", 1'000);
}

class RecordedEdgesOfAThousandMoves : public testing::TestWithParam<char> {};
INSTANTIATE_TEST_SUITE_P(Axis, RecordedEdgesOfAThousandMoves, testing::Values('x', 'y', 'z', 'u'));

TEST_P(RecordedEdgesOfAThousandMoves, AreTheLogicalPositionOfTheMcx314) {
    for (const bool is_one_pulse : {false, true}) count_mcx314(moves(), GetParam(), is_one_pulse);
}

TEST(RecordedEdgesOfAThousand, MovesAreThePositionOfTheDataBoard4002) {
    count_databoard4002(moves());
}

TEST(RecordedEdgesOfAThousand, InstantsAreTheFramesOfTheGratingBus) {
    for (const char* card : {"c1", "c2"}) count_grating_bus(moves(), card);
}

class RecordedEncoderEdges : public testing::TestWithParam<std::tuple<std::int64_t, bool>> {};
INSTANTIATE_TEST_SUITE_P(Encoder, RecordedEncoderEdges,
                         testing::Combine(testing::Values(400, 4'000, 12'800, 100'000), testing::Bool()));

TEST_P(RecordedEncoderEdges, OfAThousandMovesAreThePositionsOfAllCardsThatCountThem) {
    const auto& [counts_per_rev, loses_steps] = GetParam();
    for (const char axis : {'X', 'Y'}) count_encoder(moves(), axis, {counts_per_rev, loses_steps});
}

}  // namespace
}  // namespace motionrack::rack
