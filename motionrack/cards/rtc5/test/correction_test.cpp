// Correction files and the lens behind them.
#include <cmath>
#include <motionrack/cards/rtc5/test/rig.hpp>

namespace motionrack::rtc5 {
namespace {

/// A lens whose maker's table is known at some points.
constexpr sim::ScanLens d2_721 = {{255.059, -1.365, 1.493, -18.087}, 11.7, 5184};

TEST(Rtc5Correction, TheLensGivesTheMakersPoints) {
    const int points[6][4] = {{524288, 0, 491467, 0},           {131072, 0, 122233, 0},
                              {0, 131072, 0, 122233},           {-262144, -262144, -248226, -243338},
                              {524288, 524288, 523249, 481564}, {-360448, 294912, -343078, 272556}};
    for (const auto& p : points) {
        const sim::Spot bits = sim::bits_for(d2_721, {p[0] / 5184.0, p[1] / 5184.0});
        EXPECT_NEAR(bits.x, p[2], 1.0);
        EXPECT_NEAR(bits.y, p[3], 1.0);
    }
    EXPECT_NEAR(sim::spot_of(d2_721, {300000, 200000}).x, 61.364852, 1e-6);
    EXPECT_NEAR(sim::spot_of(d2_721, {-250000, 400000}).y, 82.913784737, 1e-8);
    const sim::Spot uncorrected_spot = sim::spot_of(d2_721, {400000, 400000});
    EXPECT_NEAR(uncorrected_spot.x, 79.186, 1e-3);
    EXPECT_NEAR(uncorrected_spot.y, 83.549, 1e-3);
}

TEST(Rtc5Correction, ALensAndItsInverseAreExact) {
    for (int i = 0; i < 400; ++i) {
        const sim::Spot bits = {std::fmod(i * 104729.0, 1048576) - 524288, std::fmod(i * 130363.0, 1048576) - 524288};
        const sim::Spot back = sim::bits_for(d2_721, sim::spot_of(d2_721, bits));
        EXPECT_NEAR(back.x, bits.x, 1e-6);
        EXPECT_NEAR(back.y, bits.y, 1e-6);
    }
    EXPECT_FALSE(sim::check({{0, 0, 0, 0}, 11.7, 5184}));
    EXPECT_FALSE(sim::check({{100, -500, 0, 0}, 11.7, 5184})) << "the image would fold back";
    EXPECT_FALSE(sim::check({{255, 0, 0, 0}, 11.7, std::nan("")}));
}

TEST(Rtc5Correction, ATableMadeFromALensPutsTheSpotWhereItWasAskedFor) {
    Rig rig;
    ASSERT_TRUE(rig.card.load_correction(table_of(*correction_of(d2_721)), 1));
    ASSERT_TRUE(rig.card.select_cor_table(1, 0));
    rig.put(Op::micro_vector_abs, {311'111, -222'222, -1, -1});
    rig.go();
    const sim::Spot spot = sim::spot_of(d2_721, {static_cast<double>(rig.last_x()), static_cast<double>(rig.last_y())});
    EXPECT_NEAR(spot.x * 5184, 311'111, 2);
    EXPECT_NEAR(spot.y * 5184, -222'222, 2);
}

TEST(Rtc5Correction, AFileWrittenIsReadBackTheSame) {
    const CorrectionFile made = *correction_of(d2_721, 721);
    const auto bytes = written_ct5(made);
    ASSERT_EQ(bytes.size(), 1'056'852u);
    const auto read = read_ct5(bytes, "D2_721.ct5");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_TRUE(read->checksum_known);
    EXPECT_EQ(read->header, made.header);
    EXPECT_EQ(read->x, made.x);
    EXPECT_EQ(read->inverse_y, made.inverse_y);
    EXPECT_EQ(read->bits_per_mm(), 5184);
    const sim::Spot spot = uncorrected(*read, {300000, 200000});
    EXPECT_NEAR(spot.x / 5184, 61.364852, 1e-3);
}

TEST(Rtc5Correction, DamagedShortAndForeignFilesAreRefusedWithTheReason) {
    const auto good = written_ct5(one_to_one());
    ASSERT_TRUE(read_ct5(good, "x"));
    auto bytes = good;
    bytes.pop_back();
    EXPECT_EQ(read_ct5(bytes, "short.ct5").error().message,
              "short.ct5: it has 1056851 bytes; a correction file of an RTC5 has 1056852. The file was not loaded");
    bytes = good;
    bytes[700'000] ^= 1;
    EXPECT_NE(read_ct5(bytes, "x").error().message.find("it is damaged"), std::string::npos);
    bytes = good;
    bytes[64 + 4 * (257 * 3 + 7) + 3] = 0x7F;
    EXPECT_NE(read_ct5(bytes, "x").error().message.find("column 7, row 3"), std::string::npos);
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i * 2654435761u >> 13);
    EXPECT_FALSE(read_ct5(bytes, "noise"));
    EXPECT_FALSE(read_ct5({}, "empty"));
}

TEST(Rtc5Correction, WithoutATableOutputIsInput) {
    Rig rig;
    rig.put(Op::micro_vector_abs, {-524'288, 524'287, -1, -1});
    rig.go();
    EXPECT_EQ(rig.last_x(), -524'288);
    EXPECT_EQ(rig.last_y(), 524'287);
}

}  // namespace
}  // namespace motionrack::rtc5
