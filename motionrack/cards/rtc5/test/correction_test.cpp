// Tests of correction files (.ct5) and of tables made from a lens.
#include <cmath>
#include <motionrack/cards/rtc5/test/rig.hpp>

namespace motionrack::rtc5 {
namespace {

/// A lens whose maker's table is known at some points.
constexpr sim::ScanLens d2_721 = {{255.059, -1.365, 1.493, -18.087}, 11.7, 5184};

TEST(Rtc5Correction, TheLensGivesTheDocumentedPoints) {
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

TEST(Rtc5Correction, ATableMadeFromALensPutsTheSpotAtTheProgrammedPosition) {
    Rig rig;
    ASSERT_TRUE(rig.card.parts().heads.load_table(table_of(*correction_of(d2_721)), 1));
    ASSERT_TRUE(rig.card.parts().heads.select_tables(1, 0));
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

/// Makes a 1:1 correction file of 5184 bits/mm; `program`: origin * 1000 + version.
CorrectionFile plain_file(std::int32_t program = 403) {
    CorrectionFile out = one_to_one();
    out.header[1] = 5184, out.header[10] = program;
    return out;
}

std::string refusal_of(std::span<const std::uint8_t> bytes) {
    const auto read = read_ct5(bytes, "x");
    return read ? "" : read.error().message;
}

TEST(Rtc5Correction, DamagedShortAndForeignFilesAreRefusedWithTheReason) {
    const auto good = written_ct5(plain_file());
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

TEST(Rtc5Correction, DetectsAnyInvertedBitInAFileOfAnyProgram) {
    for (const std::int32_t program : {403, 1403, 399, 0}) {
        const auto good = written_ct5(plain_file(program));
        ASSERT_TRUE(read_ct5(good, "x")) << program;
        EXPECT_TRUE(read_ct5(good, "x")->checksum_known) << program;
        std::vector<std::size_t> bits;
        for (std::size_t bit = 0; bit < 32; ++bit) bits.push_back(40 * 8 + bit);  // the program's version
        for (const std::size_t byte : {std::size_t{0}, std::size_t{4}, std::size_t{64}, std::size_t{555'555},
                                       ct5_bytes - 5, ct5_bytes - 4, ct5_bytes - 1})
            bits.push_back(8 * byte + byte % 8);
        for (const std::size_t bit : bits) {
            auto bytes = good;
            bytes[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
            EXPECT_NE(refusal_of(bytes), "") << "program " << program << ", bit " << bit;
        }
    }
    auto bytes = written_ct5(plain_file());
    bytes[40] = 0, bytes[41] = 0;  // changes more than one bit, so the header names program 0
    EXPECT_EQ(refusal_of(bytes),
              "x: its checksum would fit if its header named another program version: it is damaged. The file was not "
              "loaded");
    bytes = written_ct5(plain_file(0));
    bytes[700'000] ^= 1;
    EXPECT_EQ(refusal_of(bytes),
              "x: its checksum would fit if bit 0 of byte 700000 were inverted: it is damaged. The file was not "
              "loaded");
}

TEST(Rtc5Correction, AnOlderFileIsReadWithAWarningThatItsChecksumIsUnknown) {
    auto bytes = written_ct5(plain_file(310));
    for (std::size_t i = ct5_bytes - 4; i < ct5_bytes; ++i) bytes[i] = static_cast<std::uint8_t>(i * 37);
    const auto read = read_ct5(bytes, "old.ct5");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_FALSE(read->checksum_known);
    EXPECT_EQ(read->note, "old.ct5 is from an older program, whose checksum is unknown; it was not checked.");
    EXPECT_EQ(table_of(*read)->note, read->note);
    EXPECT_EQ(read_ct5(written_ct5(plain_file()), "new.ct5")->note, "");
}

TEST(Rtc5Correction, RejectsFilesWithoutBitsPerMillimetreExceptTheMakersOneToOneTable) {
    CorrectionFile file = plain_file();
    file.header[1] = 0;
    EXPECT_EQ(refusal_of(written_ct5(file)),
              "x: 0 bits/mm in its header, so the size of the field is unknown; it must be 1 to 1000000. The "
              "file was not loaded");
    file.header[10] = 0;
    auto bytes = written_ct5(file);
    bytes.back() ^= 0x55;
    ASSERT_EQ(refusal_of(bytes), "") << "as Cor_1to1.ct5 of the year 2010: its sum is not known";
    bytes[64 + 4 * (257 * 3 + 7)] ^= 1;
    EXPECT_NE(refusal_of(bytes), "");
}

TEST(Rtc5Correction, ATableThatCannotBeInvertedIsRefused) {
    for (const bool folded : {false, true}) {
        CorrectionFile file = plain_file();
        for (std::size_t i = 0; i < grid_nodes; ++i)
            if (const std::size_t column = i % grid_side; column > 128)
                file.x[i] = folded ? file.x[i - 2 * (column - 128)] : file.x[i - (column - 128)];
        EXPECT_EQ(refusal_of(written_ct5(file)),
                  "x: its table cannot be inverted: between columns 128 and 129, rows 1 and 2 it is flat or folded. "
                  "The file was not loaded")
            << folded;
    }
    CorrectionFile flat = plain_file();
    for (auto* nodes : {&flat.x, &flat.y}) std::fill(nodes->begin(), nodes->end(), 524'288);
    EXPECT_NE(refusal_of(written_ct5(flat)).find("cannot be inverted"), std::string::npos);
    for (auto* nodes : {&flat.x, &flat.y}) std::fill(nodes->begin(), nodes->end(), 0);
    EXPECT_NE(refusal_of(written_ct5(flat)).find("cannot be inverted"), std::string::npos) << "all is at the edge";
    CorrectionFile mirrored = plain_file();
    for (std::int32_t& x : mirrored.x) x = std::min(1'048'575, 1'048'576 - x);
    EXPECT_EQ(refusal_of(written_ct5(mirrored)), "");
}

TEST(Rtc5Correction, TablesMadeFromLensesCanBeInverted) {
    constexpr sim::ScanLens d3_2982 = {{163.064, -1.259, -21.465, -26.664}, 11.7, 8656};
    for (sim::ScanLens lens : {sim::ScanLens{}, d2_721, d3_2982})
        for (const double field : {1.0, 0.8, 1.02}) {
            lens.bits_per_mm = std::floor(lens.bits_per_mm / field);
            const auto made = correction_of(lens);
            ASSERT_TRUE(made) << made.error().message;
            EXPECT_EQ(refusal_of(written_ct5(*made)), "") << lens.f_mm[0] << " mm, " << lens.bits_per_mm << " bits/mm";
        }
}

TEST(Rtc5Correction, TheGeneratedOneToOneTableIsOneToOneInItsLastCell) {
    Rig rig;
    ASSERT_TRUE(rig.card.parts().heads.load_table(table_of(one_to_one()), 1));
    ASSERT_TRUE(rig.card.parts().heads.select_tables(1, 0));
    for (const double x :
         {-524'288.0, -520'193.0, 0.0, 520'191.0, 520'192.0, 520'193.0, 522'240.0, 524'286.0, 524'287.0}) {
        rig.begin();
        rig.put(Op::micro_vector_abs, {x, -1 - x, -1, -1});
        rig.go();
        EXPECT_EQ(rig.last_x(), x);
        EXPECT_EQ(rig.last_y(), -1 - x);
    }
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
