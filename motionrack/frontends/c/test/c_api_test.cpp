// motionrack/c.h from outside: invalid calls give codes and sentences, never a crash; the library exports nothing else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <motionrack/c.h>

#include <array>
#include <cstdio>
#include <limits>
#include <string>
#include <thread>

namespace {

using ::testing::HasSubstr;

/// A rack that is closed on destruction.
class Open {
  public:
    explicit Open(const char* text = "card.c1 = \"mcx314\"") { code = mr_rack_open(text, &rack); }
    ~Open() { mr_rack_close(rack); }
    Open(const Open&) = delete;
    Open& operator=(const Open&) = delete;
    operator mr_rack*() const { return rack; }
    mr_rack* rack = nullptr;
    int code = -1;
};

TEST(CApi, NullPointersAreBadCalls) {
    Open r;
    ASSERT_EQ(r.code, MR_OK) << mr_last_error();
    std::uint16_t word = 5;
    mr_rack* out = nullptr;
    EXPECT_EQ(mr_rack_open(nullptr, &out), MR_BAD_CALL);
    EXPECT_EQ(mr_rack_open("card.c1 = \"mcx314\"", nullptr), MR_BAD_CALL);
    EXPECT_EQ(mr_advance_ns(nullptr, 1), MR_BAD_CALL);
    EXPECT_THAT(mr_last_error(), HasSubstr("mr_rack_open"));
    EXPECT_EQ(mr_now_ns(nullptr), 0u);
    EXPECT_EQ(mr_read16(nullptr, "c1", 0, &word), MR_BAD_CALL);
    EXPECT_EQ(mr_read16(r, nullptr, 0, &word), MR_BAD_CALL);
    EXPECT_EQ(mr_read16(r, "c1", 0, nullptr), MR_BAD_CALL);
    EXPECT_EQ(mr_write16(nullptr, "c1", 0, 0), MR_BAD_CALL);
    EXPECT_EQ(mr_write16(r, nullptr, 0, 0), MR_BAD_CALL);
    mr_rack_close(nullptr);
    EXPECT_EQ(mr_now_ns(r), 0u) << "nothing of it took time";
}

TEST(CApi, RackFilesWithMistakesGiveALineForEach) {
    mr_rack* rack = nullptr;
    EXPECT_EQ(mr_rack_open("[card.m]\ntype = \"mcx31\"\n[crad]\n", &rack), MR_BAD_INPUT);
    EXPECT_EQ(rack, nullptr);
    EXPECT_THAT(mr_last_error(), HasSubstr("2:8: "));
    EXPECT_THAT(mr_last_error(), HasSubstr("\n3:2: "));
    EXPECT_EQ(mr_rack_open("no/such/rack.toml", &rack), MR_IO);
    EXPECT_THAT(mr_last_error(), HasSubstr("no/such/rack.toml"));
    EXPECT_EQ(mr_rack_open("", &rack), MR_BAD_INPUT);
}

TEST(CApi, TheAddressOfARealCardOpensNothingAndTheSentenceNamesWhatDoes) {
    for (const char* place : {"port:/dev/port,offset=0x2300", "memory:/sys/card", "uio:/dev/uio0"}) {
        mr_rack* rack = nullptr;
        EXPECT_EQ(mr_rack_open(place, &rack), MR_BAD_INPUT);
        EXPECT_EQ(rack, nullptr);
        EXPECT_THAT(mr_last_error(), HasSubstr(std::string("'") + place + "' is the address of a real card"));
        EXPECT_THAT(mr_last_error(), HasSubstr("mcx314_open(), a real databoard4002 by databoard4002_open()"));
        EXPECT_THAT(mr_last_error(), HasSubstr("An IOFLEX02 has no live port: "));
        EXPECT_THAT(mr_last_error(), HasSubstr("A card of the grating bus has no live port: "));
        EXPECT_THAT(mr_last_error(), HasSubstr("An RTC5 has no live port: "));
    }
}

TEST(CApi, AccessesThatTheBusDoesNotHaveAreRefused) {
    Open r;
    std::uint8_t byte = 1;
    std::uint16_t word = 2;
    std::uint32_t twice = 3;
    EXPECT_EQ(mr_read8(r, "c1", 0, &byte), MR_REFUSED);
    EXPECT_THAT(mr_last_error(), HasSubstr("accesses of 16 bits, not of 8"));
    EXPECT_EQ(mr_write8(r, "c1", 0, 0), MR_REFUSED);
    EXPECT_EQ(mr_read32(r, "c1", 0, &twice), MR_REFUSED);
    EXPECT_EQ(mr_write32(r, "c1", 0, 0), MR_REFUSED);
    for (const std::uint32_t offset : {1u, 0x10u, 0x11u, 0xFFFF'FFFFu}) {
        EXPECT_EQ(mr_read16(r, "c1", offset, &word), MR_REFUSED) << offset;
        EXPECT_EQ(mr_write16(r, "c1", offset, 0), MR_REFUSED) << offset;
    }
    EXPECT_THAT(mr_last_error(), HasSubstr("0xffffffff"));
    EXPECT_EQ(mr_read16(r, "c2", 0, &word), MR_BAD_CALL);
    EXPECT_THAT(mr_last_error(), HasSubstr("Unknown card 'c2'"));
    EXPECT_THAT(mr_last_error(), HasSubstr("c1"));
    EXPECT_EQ(byte, 1);
    EXPECT_EQ(word, 2);
    EXPECT_EQ(twice, 3u);
    EXPECT_EQ(mr_now_ns(r), 0u);
}

TEST(CApi, AnEightBitBusHasBytePorts) {
    Open r(
        "[card.c1]\ntype = \"mcx314\"\nbus = \"8-bit\"\nbus_access_ns = 100\n[axis.X]\ncard = \"c1\"\nchannel = "
        "\"x\"\n");
    ASSERT_EQ(r.code, MR_OK) << mr_last_error();
    std::uint16_t word = 0;
    EXPECT_EQ(mr_read16(r, "c1", 0, &word), MR_REFUSED);
    EXPECT_THAT(mr_last_error(), HasSubstr("accesses of 8 bits, not of 16"));
    const auto out = [&](std::uint32_t port, std::uint8_t value) {
        EXPECT_EQ(mr_write8(r, "c1", port, value), MR_OK) << mr_last_error();
    };
    out(0x0D, 0x12);
    out(0x0C, 0x34);
    out(0x01, 0x01);
    out(0x00, 0x09);  // LP of X
    out(0x01, 0x01);
    out(0x00, 0x10);  // to RR6, RR7
    std::uint8_t low = 0, high = 0;
    EXPECT_EQ(mr_read8(r, "c1", 0x0C, &low), MR_OK);
    EXPECT_EQ(mr_read8(r, "c1", 0x0D, &high), MR_OK);
    EXPECT_EQ(low, 0x34);
    EXPECT_EQ(high, 0x12);
    EXPECT_EQ(mr_now_ns(r), 800u);
    EXPECT_EQ(mr_read8(r, "c1", 0x10, &low), MR_REFUSED);
    EXPECT_EQ(mr_write8(r, "c1", 0x10, 0), MR_REFUSED);
}

TEST(CApi, TimeHasLimits) {
    Open r;
    EXPECT_EQ(mr_advance_ns(r, 0), MR_OK);
    EXPECT_EQ(mr_advance_ns(r, std::numeric_limits<std::uint64_t>::max()), MR_REFUSED);
    EXPECT_EQ(mr_advance_ns(r, 1'000'000'000'000'001), MR_REFUSED);
    EXPECT_EQ(mr_now_ns(r), 0u);
    std::uint64_t calls = 0;
    while (mr_advance_ns(r, 1'000'000'000'000'000) == MR_OK && calls < 1000) ++calls;
    EXPECT_EQ(calls, 461u) << "14 years";
    EXPECT_THAT(mr_last_error(), HasSubstr("ends at"));
    EXPECT_EQ(mr_now_ns(r), calls * 1'000'000'000'000'000);
    EXPECT_EQ(mr_advance_ns(r, 1), MR_OK);
}

TEST(CApi, EachThreadHasItsOwnLastError) {
    EXPECT_EQ(mr_advance_ns(nullptr, 1), MR_BAD_CALL);
    const std::string here = mr_last_error();
    std::string there = "?";
    std::thread other([&there] {
        there = mr_last_error();
        Open r("[card.m]\n");
    });
    other.join();
    EXPECT_EQ(there, "");
    EXPECT_EQ(mr_last_error(), here);
}

/// Names exported by the library, from nm.
TEST(CApi, TheLibraryExportsItsFunctionsOnly) {
    std::FILE* pipe = ::popen("nm -D --defined-only --format=just-symbols '" MOTIONRACK_C_LIBRARY "'", "r");
    ASSERT_NE(pipe, nullptr);
    std::array<char, 512> line{};
    int names = 0;
    while (std::fgets(line.data(), static_cast<int>(line.size()), pipe) != nullptr) {
        const std::string name = line.data();
        EXPECT_TRUE(name.rfind("mr_", 0) == 0 || name.rfind("flex2pos_", 0) == 0) << name;
        ++names;
    }
    EXPECT_EQ(::pclose(pipe), 0);
    EXPECT_GE(names, 11);
}

}  // namespace
