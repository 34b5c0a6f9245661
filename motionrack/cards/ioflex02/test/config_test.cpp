// The configuration image: accepted and refused images with their messages, and the bus with its addresses.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <motionrack/cards/ioflex02/test/rig.hpp>

namespace motionrack::ioflex02 {
namespace {

constexpr std::uint32_t state = offset("STATUS"), error = offset("CFG_ERROR"), ident = offset("IDENT");
constexpr int loading = 1, starting = 2, running = 4, failed = 8;

std::vector<std::uint8_t> good() {
    return *raw_image({});
}
int error_after(const std::vector<std::uint8_t>& raw) {
    Rig rig{Settings{}};
    rig.start();
    rig.feed(raw);
    return rig.read(state) == failed ? rig.read(error) : -1;
}

TEST(Ioflex02Image, IsAcceptedAndTheProjectRunsAfterTheConfigurationTime) {
    Rig rig{Settings{}};
    rig.start();
    EXPECT_EQ(rig.read(state), 0);
    EXPECT_EQ(rig.read(ident), 0xFFFF);
    rig.write(offset("CONTROL"), 1);
    EXPECT_EQ(rig.read(state), loading);
    rig.feed(good());
    EXPECT_EQ(rig.read(state), starting);
    rig.turn(0, 3);
    rig.run(milliseconds(1'999));
    EXPECT_EQ(rig.read(state), starting);
    rig.run(milliseconds(1));
    EXPECT_EQ(rig.read(state), running);
    EXPECT_EQ(rig.read(ident), position_ident);
    rig.capture();
    EXPECT_EQ(rig.read24(offset("POS0_L")), 0);  // the first sample only set the state
    rig.turn(0, 3);
    rig.run(microseconds(1));
    EXPECT_EQ(rig.card.position(0), 3);
}

TEST(Ioflex02Image, ItsPayloadReportsHowTheAxesCount) {
    Rig rig{Settings{}};
    rig.start();
    rig.feed(*unpacked(position_image({0, mode::REVERSED.mask, 0, static_cast<std::uint16_t>(2 << 1)})));
    rig.run(whole_seconds(3));
    for (int axis = 0; axis < 4; ++axis) rig.turn(axis, 40);
    EXPECT_EQ(rig.card.position(0), 40);
    EXPECT_EQ(rig.card.position(1), -40);
    EXPECT_EQ(rig.card.position(3), 10);
}

TEST(Ioflex02Image, DamagedCutShortAndForeignOnesAreRefusedWithTheirCode) {
    std::vector<std::uint8_t> raw = good();
    raw.resize(20);
    EXPECT_EQ(error_after(raw), static_cast<int>(CfgError::cut_short));
    raw = good();
    raw.pop_back();
    raw.pop_back();
    EXPECT_EQ(error_after(raw), static_cast<int>(CfgError::cut_short));
    raw = good();
    raw[0] = 'X';
    EXPECT_EQ(error_after(raw), static_cast<int>(CfgError::foreign));
    raw = good();
    raw[30] = 0xFF;
    EXPECT_EQ(error_after(raw), static_cast<int>(CfgError::length));
    raw = good();
    raw.back() ^= 1;
    EXPECT_EQ(error_after(raw), static_cast<int>(CfgError::crc));
    EXPECT_EQ(error_after({}), static_cast<int>(CfgError::cut_short));
}

RC_GTEST_PROP(Ioflex02Image, AnyByteThatIsWrongIsNoticed, ()) {
    std::vector<std::uint8_t> raw = good();
    const std::size_t at = *rc::gen::inRange<std::size_t>(0, raw.size());
    raw[at] = static_cast<std::uint8_t>(raw[at] ^ *rc::gen::inRange(1, 256));
    RC_ASSERT(error_after(raw) > 0);
}

TEST(Ioflex02Image, TheRefusalIsReportedInASentence) {
    Rig rig{Settings{}};
    rig.start();
    std::vector<std::uint8_t> raw = good();
    raw.back() ^= 1;
    rig.feed(raw);
    const auto reported = rig.kernel.conditions();
    ASSERT_EQ(reported.size(), 1u);
    EXPECT_NE(describe(reported[0], "c1").find("refused after 44 bytes: its CRC-32 is wrong"), std::string::npos)
        << describe(reported[0], "c1");
    rig.feed(good());
    EXPECT_EQ(rig.read(error), 0);
    EXPECT_EQ(rig.read(state), starting);
}

TEST(Ioflex02Image, AnUnknownProjectIsAcceptedButOnlyItsIdentCanBeRead) {
    Rig rig{Settings{}};
    rig.start();
    ImageContent content;
    content.project = "stepper";
    content.ident = 0x77;
    rig.feed(*raw_image(content));
    rig.run(whole_seconds(3));
    EXPECT_EQ(rig.read(state), running);
    EXPECT_EQ(rig.read(error), static_cast<int>(CfgError::unknown_project));
    EXPECT_EQ(rig.read(ident), 0x77);
    EXPECT_EQ(rig.read(offset("STS")), 0xFFFF);
    rig.write(offset("OUTL"), 0xFF);
    EXPECT_EQ(rig.level("out0"), 0);
}

TEST(Ioflex02Image, WithoutAProjectRegistersReadFFFFAndIgnoreWritesAndThatIsReportedOnce) {
    Rig rig{Settings{}};
    rig.start();
    rig.write(offset("OUTL"), 0xFF);
    EXPECT_EQ(rig.read(offset("POS0_L")), 0xFFFF);
    EXPECT_EQ(rig.read(offset("IN")), 0xFFFF);
    EXPECT_EQ(rig.level("out0"), 0);
    EXPECT_EQ(rig.conditions(), std::vector{CardCondition::no_project});
}

TEST(Ioflex02Image, ConfiguringAgainEndsTheRunningProject) {
    Rig rig;
    rig.start();
    rig.turn(0, 8);
    rig.write(offset("OUTH"), 0xFF);
    rig.write(offset("CONTROL"), 1);
    EXPECT_EQ(rig.level("out9"), 0);
    EXPECT_EQ(rig.read(offset("STS")), 0xFFFF);
    rig.feed(good());
    rig.run(whole_seconds(2));
    EXPECT_EQ(rig.card.position(0), 0);
}

TEST(Ioflex02Image, AUserImageRunsFromPowerUp) {
    Settings settings = loaded_settings();
    settings.image = *unpacked(position_image({mode::REVERSED.mask, 0, 0, 0}));
    Rig rig{settings};
    rig.start();
    rig.turn(0, 12);
    rig.run(microseconds(1));
    EXPECT_EQ(rig.card.position(0), -12);
    settings.image = *raw_image({"stepper", 0x77, std::vector<std::uint8_t>(8)});
    Rig other{settings};
    other.start();
    EXPECT_EQ(other.read(error), static_cast<int>(CfgError::unknown_project));
    EXPECT_EQ(other.read(ident), 0x77);
    EXPECT_EQ(other.read(offset("IN")), 0xFFFF);
    EXPECT_EQ(other.conditions(), (std::vector{CardCondition::unknown_project, CardCondition::no_project}));
    settings.image.pop_back();
    EXPECT_FALSE(check(settings));
}

TEST(Ioflex02Image, IdentifiesItself) {
    const auto info = inspect(*raw_image({"position", 0x31, {1, 0, 2, 0, 8, 0, 0xF0, 0, 77}}));
    ASSERT_TRUE(info);
    EXPECT_EQ(info->project, "position");
    EXPECT_EQ(info->ident, 0x31);
    EXPECT_EQ(info->payload, 9u);
    EXPECT_EQ(info->modes, (std::array<std::uint16_t, 4>{1, 2, 8, 0xF0}));
    EXPECT_TRUE(info->position());
    EXPECT_EQ(inspect(*raw_image({"sixteen letters.", 1, std::vector<std::uint8_t>(8)}))->project, "sixteen letters.");
}

TEST(Ioflex02Image, TheCardRejectsExactlyTheImagesThatInspectRejects) {
    const auto refused = [](std::vector<std::uint8_t> raw, const char* sentence) {
        ASSERT_FALSE(inspect(raw)) << sentence;
        EXPECT_NE(inspect(raw).error().message.find(sentence), std::string::npos) << inspect(raw).error().message;
        EXPECT_GT(error_after(raw), 0) << sentence;
    };
    std::vector<std::uint8_t> raw = good();
    raw[7] = '3';
    refused(raw, "does not begin with");
    raw = good();
    raw.resize(20);
    refused(raw, "20 of 36 bytes");
    raw = good();
    raw[30] = 0x10;
    refused(raw, "The length in its header");
    raw = good();
    raw.resize(40);
    refused(raw, "has 4 bytes, but the header says 8");
    raw = good();
    raw[24] ^= 0x40;
    refused(raw, "Its CRC-32");
    refused({}, "does not begin with");
    EXPECT_TRUE(inspect(good()));
}

RC_GTEST_PROP(Ioflex02Image, BytesAreTheSameAfterTheirDigits, (std::vector<std::uint8_t> bytes)) {
    RC_ASSERT(*bytes_of_hex(hex_text(bytes)) == bytes);
}

TEST(Ioflex02Image, InvalidHexDigitsAreReportedWithTheirLocation) {
    for (const char* wrong : {"7", "78d", "78 d", "-1", "0x", "78zz"}) EXPECT_FALSE(bytes_of_hex(wrong)) << wrong;
    EXPECT_NE(bytes_of_hex("78zz").error().message.find("Digits 3 and 4"), std::string::npos);
    EXPECT_EQ(*bytes_of_hex("78dA"), (std::vector<std::uint8_t>{0x78, 0xDA}));
}

// ---- compressed

TEST(Ioflex02Image, IsCompressedAndUnpackedAgain) {
    ImageContent content;
    content.payload.resize(max_payload);
    for (std::size_t i = 0; i < content.payload.size(); ++i) content.payload[i] = static_cast<std::uint8_t>(i * i >> 7);
    const auto raw = *raw_image(content);
    const auto file = compressed(raw);
    EXPECT_LT(file.size(), raw.size());
    EXPECT_EQ(*unpacked(file), raw);
    EXPECT_EQ(*unpacked(position_image()), good());
}

TEST(Ioflex02Image, RejectsTruncatedDamagedForeignAndOversizedFiles) {
    const auto file = position_image();
    for (std::size_t size = 0; size < file.size(); ++size) EXPECT_FALSE(unpacked(std::span(file).first(size))) << size;
    auto longer = file;
    longer.push_back(0);
    ASSERT_FALSE(unpacked(longer));
    EXPECT_NE(unpacked(longer).error().message.find("ends after"), std::string::npos);
    auto damaged = file;
    damaged[file.size() / 2] ^= 0x10;
    EXPECT_FALSE(unpacked(damaged));
    EXPECT_FALSE(unpacked(std::vector<std::uint8_t>{'P', 'K', 3, 4, 0, 0}));
    const auto bomb = compressed(std::vector<std::uint8_t>(50'000'000));
    ASSERT_FALSE(unpacked(bomb));
    EXPECT_NE(unpacked(bomb).error().message.find("more than 131108 bytes"), std::string::npos)
        << unpacked(bomb).error().message;
}

TEST(Ioflex02Image, ContentsOutOfRangeAreRejected) {
    ImageContent content;
    content.project = "a name that is too long";
    EXPECT_FALSE(raw_image(content));
    content = {};
    content.payload.resize(7);
    EXPECT_FALSE(raw_image(content));
    content.payload.resize(max_payload + 1);
    EXPECT_FALSE(raw_image(content));
}

RC_GTEST_PROP(Ioflex02Image, AnyBytesAreUnpackedOrRefused, (std::vector<std::uint8_t> bytes)) {
    const auto out = unpacked(bytes);
    RC_ASSERT(out || !out.error().message.empty());
}

// ---- the bus

TEST(Ioflex02Bus, NoCardAnswersAtAnotherAddress) {
    Rig rig;
    rig.start();
    EXPECT_EQ(rig.port.read(0x2300), signature);
    EXPECT_EQ(rig.port.read(0x2200), 0xFFFF);
    EXPECT_EQ(rig.port.read(0x2400), 0xFFFF);
    rig.port.write(0x2400 + offset("OUTL"), 0xFF);
    EXPECT_EQ(rig.level("out0"), 0);
    EXPECT_EQ(rig.read(offset("SERIAL")) ^ rig.read(offset("SERIAL_N")), 0xFFFF);
    EXPECT_TRUE(rig.conditions().empty());
}

TEST(Ioflex02Bus, TwoCardsAtOneAddressBothAcceptWritesAndReadAndedWithAReport) {
    Settings other = loaded_settings();
    other.serial = 2;
    Rig rig;
    Card second(rig.kernel, "c2", other);
    rig.bus.plug(second);
    rig.start();
    EXPECT_NE(rig.read(offset("SERIAL")) ^ rig.read(offset("SERIAL_N")), 0xFFFF);
    rig.write(offset("OUTL"), 1);
    EXPECT_EQ(rig.level("out0"), 1);
    EXPECT_EQ(rig.kernel.level(rig.kernel.find_wire("c2.out0")), 1);
    rig.set("in3", 1);
    EXPECT_EQ(rig.read(offset("IN")), 0);  // that of the other card is low
    const auto reported = rig.kernel.conditions();
    ASSERT_EQ(reported.size(), 1u);
    EXPECT_NE(describe(reported[0], "bus").find("two cards answer at the base address 2300h"), std::string::npos);
}

TEST(Ioflex02Bus, CardsAtTheirOwnAddressesDoNotDisturbEachOther) {
    Settings other = loaded_settings();
    other.base_address = 0xFF00;
    Rig rig;
    Card second(rig.kernel, "c2", other);
    rig.bus.plug(second);
    rig.start();
    rig.port.write(0xFF00 + offset("OUTL"), 0x80);
    EXPECT_EQ(rig.level("out7"), 0);
    EXPECT_EQ(rig.kernel.level(rig.kernel.find_wire("c2.out7")), 1);
    EXPECT_TRUE(rig.conditions().empty());
}

TEST(Ioflex02Settings, OutOfRangeAreRefusedWithTheNumberSeen) {
    Settings s;
    EXPECT_TRUE(check(s));
    s.base_address = 0x2310;
    ASSERT_FALSE(check(s));
    EXPECT_NE(check(s).error().message.find("2310h"), std::string::npos);
    s.base_address = 0x10000;
    EXPECT_FALSE(check(s));
    s = {};
    s.configuration_time = whole_seconds(61);
    EXPECT_FALSE(check(s));
}

}  // namespace
}  // namespace motionrack::ioflex02
