// Memory accesses of a live port: exactly one 16-bit access per word, at its address.
#include <gtest/gtest.h>
#include <sys/mman.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <motionrack/cards/mcx314/map.hpp>
#include <motionrack/live/card_port.hpp>
#include <tests/live/mapped_file.hpp>
#include <tests/live/trap.hpp>

namespace motionrack::live_test {
namespace {

constexpr std::size_t page = 4096;

/// Accesses recorded by the trap's signal handler.
struct Seen {
    std::array<Touch, 64> list;
    std::size_t count;
} seen;

void note(const Touch& access) {
    if (seen.count < seen.list.size()) seen.list[seen.count++] = access;
}
void nothing(const Touch&) {}

class LivePortInMemory : public testing::Test {
  protected:
    void SetUp() override {
        if (!Trap::possible()) GTEST_SKIP() << "Accesses to memory are noticed one by one on x86-64 only.";
        seen.count = 0;
        path_ = (std::filesystem::temp_directory_path() / "motionrack-trap-XXXXXX").string();
        ASSERT_TRUE(::mkdtemp(path_.data()));
        folder_ = path_;
        path_ += "/registers";
        file_.emplace(path_, page, true);
        ASSERT_TRUE(*file_);
    }
    void TearDown() override {
        file_.reset();
        std::filesystem::remove_all(folder_);
    }
    std::unique_ptr<live::CardPort> open(const std::string& options) {
        auto port = live::CardPort::open(*live::read_port_spec("memory:" + path_ + options), mcx314::card_map());
        EXPECT_TRUE(port) << port.error().message;
        return port ? std::move(*port) : nullptr;
    }

    std::string path_, folder_;
    std::optional<MappedFile> file_;
};

TEST_F(LivePortInMemory, MakesOneAccessOfSixteenBitsForEachWord) {
    // The last register ends with the page: a wider access would leave it.
    const auto port = open(",offset=4080");
    ASSERT_TRUE(port);
    file_->as<std::uint16_t>(page - 2) = 0xBEEF;
    std::uint16_t last = 0;
    {
        const Trap trap(Trap::mapping_of(path_), page, note, nothing);
        port->write(mcx314::reg::WR0, 0x0120);
        port->write(mcx314::reg::WR0, 0x0120);
        port->write(mcx314::reg::WR7, 0x7FFE);
        last = port->read(mcx314::reg::RR6);
        last = port->read(mcx314::reg::RR7);
        (void)port->read(mcx314::reg::RR3);
    }
    EXPECT_EQ(last, 0x7FFE);
    ASSERT_EQ(seen.count, 6u);
    const std::array<Touch, 6> expected = {
        {{4080, true}, {4080, true}, {4094, true}, {4092, false}, {4094, false}, {4086, false}}};
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(seen.list[i].offset, expected[i].offset) << i;
        EXPECT_EQ(seen.list[i].writes, expected[i].writes) << i;
    }
    EXPECT_EQ(file_->as<std::uint16_t>(4080), 0x0120);
}

TEST_F(LivePortInMemory, MakesTwoAccessesOfEightBitsHighByteFirst) {
    const auto port = open(",offset=1,stride=4,width=8");
    ASSERT_TRUE(port);
    {
        const Trap trap(Trap::mapping_of(path_), page, note, nothing);
        port->write(mcx314::reg::WR1, 0x1234);
        EXPECT_EQ(port->read(mcx314::reg::RR1), 0x1234);
    }
    ASSERT_EQ(seen.count, 4u);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(seen.list[i].offset, i % 2 == 0 ? 6u : 5u) << i;
    EXPECT_EQ(file_->as<std::uint8_t>(5), 0x34);
    EXPECT_EQ(file_->as<std::uint8_t>(6), 0x12);
}

TEST_F(LivePortInMemory, OpeningAccessesNoRegister) {
    // Closes a mapping that was never read; the trap would have detected a read.
    const auto port = open("");
    ASSERT_TRUE(port);
    const Trap trap(Trap::mapping_of(path_), page, note, nothing);
    EXPECT_TRUE(port->now() >= Instant{0});
    EXPECT_EQ(seen.count, 0u);
}

}  // namespace
}  // namespace motionrack::live_test
