// Live ports on plain files: the bytes of an access, and the messages for unsuitable files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <motionrack/live/byte_card_port.hpp>
#include <motionrack/live/card_port.hpp>

namespace motionrack::live {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Four registers of a sample card.
constexpr RegisterInfo registers[] = {
    {"A", 0, 16, Access::write, false, "", "", {}},
    {"B", 2, 16, Access::write, false, "", "", {}},
    {"C", 4, 16, Access::read, false, "", "", {}},
    {"D", 6, 16, Access::read, false, "", "", {}},
};
constexpr CardMap four{"four", "Four registers", registers, {}, {}, {}};
constexpr RegisterInfo wide[] = {{"W", 0, 32, Access::read, false, "", "", {}}};
constexpr CardMap wide_card{"wide", "One register", wide, {}, {}, {}};

constexpr RegisterInfo bytes_wide[] = {
    {"A", 0, 8, Access::write, false, "", "", {}},
    {"B", 1, 8, Access::read, false, "", "", {}},
    {"C", 2, 8, Access::write, false, "", "", {}},
};
constexpr CardMap three_card{"three", "Three ports", bytes_wide, {}, {}, {}};

class Folder {
  public:
    Folder() : path_((std::filesystem::temp_directory_path() / "motionrack-live-port-XXXXXX").string()) {
        if (!::mkdtemp(path_.data())) std::abort();
    }
    ~Folder() { std::filesystem::remove_all(path_); }
    std::string file(const std::string& name, const std::string& bytes) const {
        const std::string path = path_ + "/" + name;
        std::filesystem::create_directories(std::filesystem::path(path).parent_path());
        std::ofstream(path, std::ios::binary) << bytes;
        return path;
    }
    const std::string& path() const { return path_; }

  private:
    std::string path_;
};

std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

Result<std::unique_ptr<CardPort>> open(const std::string& text, const CardMap& map = four) {
    MOTIONRACK_TRY(const PortSpec spec, read_port_spec(text));
    return CardPort::open(spec, map);
}

std::string refusal(const std::string& text, const CardMap& map = four) {
    const auto port = open(text, map);
    return port ? "" : port.error().message;
}

RC_GTEST_PROP(LivePort, WritesTwoBytesAtTheRegistersOffsetAndNoOthers, ()) {
    const bool mapped = *rc::gen::arbitrary<bool>(), bytes = *rc::gen::arbitrary<bool>();
    const auto offset = 2 * *rc::gen::inRange<std::size_t>(0, 3000),
               stride = 2 * *rc::gen::inRange<std::size_t>(1, 600);
    const auto number = *rc::gen::inRange<std::uint32_t>(0, 4);
    const auto value = *rc::gen::arbitrary<std::uint16_t>();
    const Folder folder;
    std::string expected(offset + 3 * stride + 2, '\x55');
    const std::string path = folder.file("card", expected);
    const auto port = open((mapped ? "memory:" : "port:") + path + ",gap_ns=0,offset=" + std::to_string(offset) +
                           ",stride=" + std::to_string(stride) + (bytes ? ",width=8" : ""));
    RC_ASSERT(port.has_value());
    (*port)->write(2 * number, value);
    RC_ASSERT((*port)->read(2 * number) == value);
    expected[offset + number * stride] = static_cast<char>(value & 0xFF);
    expected[offset + number * stride + 1] = static_cast<char>(value >> 8);
    RC_ASSERT(bytes_of(path) == expected);
}

RC_GTEST_PROP(LivePort, MovesOneByteAtThePortsOffsetAndNoOthers, ()) {
    const bool mapped = *rc::gen::arbitrary<bool>();
    const auto offset = *rc::gen::inRange<std::size_t>(0, 6000), stride = *rc::gen::inRange<std::size_t>(1, 600);
    const auto number = *rc::gen::inRange<std::uint8_t>(0, 3);
    const auto value = *rc::gen::arbitrary<std::uint8_t>();
    const Folder folder;
    std::string expected(offset + 2 * stride + 1, '\x55');
    const std::string path = folder.file("card", expected);
    const auto port = ByteCardPort::open(
        *read_port_spec((mapped ? "memory:" : "port:") + path + ",gap_ns=0,offset=" + std::to_string(offset) +
                        (stride == 1 ? "" : ",stride=" + std::to_string(stride))),
        three_card);
    RC_ASSERT(port.has_value());
    (*port)->out(number, value);
    RC_ASSERT((*port)->in(number) == value);
    expected[offset + number * stride] = static_cast<char>(value);
    RC_ASSERT(bytes_of(path) == expected);
}

TEST(LivePort, ReportsThatItsRegistersHaveAnotherWidth) {
    const Folder folder;
    const std::string path = folder.file("card", std::string(64, '\0'));
    const auto port = ByteCardPort::open(*read_port_spec("memory:" + path), four);
    ASSERT_FALSE(port);
    EXPECT_THAT(port.error().message, HasSubstr("The four has registers that are not ports of 8 bits"));
    EXPECT_THAT(refusal("memory:" + path, three_card), HasSubstr("not words of 16 bits"));
}

TEST(LivePort, ReportsThatAWordIsNotAtAnOddAddress) {
    const Folder folder;
    const std::string path = "memory:" + folder.file("card", std::string(64, '\0'));
    EXPECT_THAT(refusal(path + ",offset=3"), HasSubstr("offset is 3, but registers of 16 bits are at even addresses"));
    EXPECT_EQ(refusal(path + ",offset=3,width=8"), "");
    EXPECT_THAT(refusal(path + ",stride=3"), HasSubstr("stride is 3, but registers of 16 bits are an even number"));
}

TEST(LivePort, ReadsAsAnEmptySlotAfterItsFileVanished) {
    const Folder folder;
    const std::string path = folder.file("card", std::string(8, '\x12'));
    const auto port = *ByteCardPort::open(*read_port_spec("port:" + path + ",gap_ns=0"), three_card);
    EXPECT_EQ(port->in(1), 0x12);
    std::filesystem::resize_file(path, 1);
    EXPECT_EQ(port->in(1), 0xFF);
    ASSERT_TRUE(port->trouble());
    EXPECT_THAT(port->trouble()->message, HasSubstr("The register at 01h could not be read through " + path));
    port->out(0, 1);
    EXPECT_EQ(bytes_of(path), "\x12") << "no access is made after it";
}

TEST(LivePort, ReportsAMissingFile) {
    for (const char* kind : {"uio:", "memory:", "port:"})
        EXPECT_THAT(refusal(std::string(kind) + "/dev/uio-that-is-not"),
                    HasSubstr("/dev/uio-that-is-not does not exist"));
}

TEST(LivePort, ReportsThatAFileIsTooShortAndByHowMuch) {
    const Folder folder;
    const std::string path = folder.file("card", std::string(9, '\0'));
    for (const char* kind : {"memory:", "port:"}) {
        EXPECT_EQ(refusal(kind + path), "");
        EXPECT_THAT(refusal(kind + path + ",offset=2"),
                    HasSubstr("has 9 bytes, but the card's registers end at byte 10 (offset 2, stride 2)"));
        EXPECT_THAT(refusal(kind + path + ",stride=4"), HasSubstr("end at byte 14"));
    }
}

TEST(LivePort, ReportsMissingRightsToOpenAFileAndTheRemedy) {
    const Folder folder;
    const std::string path = folder.file("card", std::string(64, '\0'));
    std::filesystem::permissions(path, std::filesystem::perms::none);
    std::filesystem::permissions(folder.path(), std::filesystem::perms::others_exec,
                                 std::filesystem::perm_options::add);
    // Root may open every file, so the test drops root's privileges temporarily.
    const uid_t me = ::geteuid(), somebody = me == 0 ? 65534 : me;
    ASSERT_EQ(::seteuid(somebody), 0);
    const std::string sentence = refusal("memory:" + path);
    ASSERT_EQ(::seteuid(me), 0);
    EXPECT_THAT(sentence, HasSubstr("may not read and write " + path));
    EXPECT_THAT(sentence, HasSubstr("udev rule"));
}

TEST(LivePort, ReportsThatAFileCannotBeMapped) {
    EXPECT_THAT(refusal("memory:/dev/null"), HasSubstr("/dev/null cannot be mapped"));
    const Folder folder;
    EXPECT_THAT(refusal("memory:" + folder.path()), HasSubstr("is a folder"));
}

TEST(LivePort, RefusesCardsWhoseRegistersAreNotWords) {
    const Folder folder;
    EXPECT_THAT(refusal("memory:" + folder.file("card", std::string(64, '\0')), wide_card),
                HasSubstr("not words of 16 bits"));
}

TEST(LivePort, LocksItsCardAgainstASecondPortUntilItCloses) {
    const Folder folder;
    const std::string path = folder.file("card", std::string(64, '\0'));
    for (const char* kind : {"memory:", "port:"}) {
        auto first = open(kind + path);
        ASSERT_TRUE(first) << first.error().message;
        for (const char* other : {"memory:", "port:"}) {
            const auto second = open(other + path + ",offset=2");
            ASSERT_FALSE(second);
            EXPECT_EQ(second.error().kind, ErrorKind::refused);
            EXPECT_THAT(second.error().message, HasSubstr("The card at " + path + " is already open"));
        }
        EXPECT_EQ(refusal("memory:" + path + ",offset=8"), "") << "another card in the same file";
        first->reset();
        EXPECT_EQ(refusal("memory:" + path), "");
    }
}

TEST(LivePort, LocksItsCardAgainstOtherPrograms) {
    const Folder folder;
    const std::string path = folder.file("card", std::string(8, '\0'));
    const auto port = open("memory:" + path);
    ASSERT_TRUE(port) << port.error().message;
    const pid_t child = ::fork();
    if (child == 0) {
        const bool refused = refusal("port:" + path).find("is already open") != std::string::npos;
        ::_exit(refused ? 0 : 1);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
}

TEST(LivePort, AnAccessThatTheComputerRefusesIsReportedAndIsTheLast) {
    const Folder folder;
    const std::string path = folder.file("card", std::string(8, '\x11'));
    const auto port = open("port:" + path);
    ASSERT_TRUE(port);
    EXPECT_EQ((*port)->read(6), 0x1111);
    EXPECT_FALSE((*port)->trouble());
    std::filesystem::resize_file(path, 4);
    EXPECT_EQ((*port)->read(6), 0xFFFF);
    ASSERT_TRUE((*port)->trouble());
    EXPECT_THAT((*port)->trouble()->message, HasSubstr("The register at 06h could not be read"));
    (*port)->write(0, 0x2222);
    EXPECT_EQ((*port)->read(0), 0xFFFF);
    EXPECT_EQ(bytes_of(path), std::string(4, '\x11'));
}

TEST(LivePort, ACardOfWhichEveryRegisterReadsAllOnesDoesNotAnswer) {
    for (const char* kind : {"memory:", "port:"})
        for (const char* width : {"", ",width=8"}) {
            const Folder folder;
            const std::string path = folder.file("card", std::string(8, '\x11'));
            const auto port = open(kind + path + width);
            ASSERT_TRUE(port);
            (*port)->write(4, 0xFFFF);
            EXPECT_EQ((*port)->read(4), 0xFFFF);
            EXPECT_FALSE((*port)->trouble()) << "the other register is not all ones: -1 is a position as any other";
            (*port)->write(6, 0xFFFF);
            EXPECT_EQ((*port)->read(6), 0xFFFF);
            ASSERT_TRUE((*port)->trouble());
            EXPECT_EQ((*port)->trouble()->kind, ErrorKind::io);
            EXPECT_THAT((*port)->trouble()->message,
                        AllOf(HasSubstr("no card answers at " + path), HasSubstr("not valid")));
            (*port)->write(0, 0x2222);
            EXPECT_EQ(bytes_of(path), std::string(4, '\x11') + std::string(4, '\xFF')) << "nothing is written after it";
        }
}

TEST(LivePort, TheCheckOfItsCardReadsNoRegisterWithASideEffect) {
    static constexpr RegisterInfo clearing[] = {
        {"A", 0, 16, Access::write, false, "", "", {}},
        {"B", 2, 16, Access::read_clears, false, "", "", {}},
        {"C", 4, 16, Access::read, false, "", "", {}},
    };
    static constexpr CardMap card{"clearing", "Three registers", clearing, {}, {}, {}};
    const Folder folder;
    const std::string path = folder.file("card", std::string(4, '\x11') + std::string(2, '\xFF'));
    const auto absent = open("port:" + path, card);
    ASSERT_TRUE(absent);
    const Result<void> answers = (*absent)->check_answers();
    ASSERT_FALSE(answers) << "C alone tells: B is not read";
    EXPECT_THAT(answers.error().message, HasSubstr("no card answers at " + path));
    const std::string other = folder.file("other", std::string(6, '\x11'));
    const auto there = open("port:" + other, card);
    ASSERT_TRUE(there);
    EXPECT_TRUE((*there)->check_answers());
}

TEST(LivePort, FindsAUioMapByItsFolderInSys) {
    const Folder folder;
    folder.file("uio7/maps/map1/size", "0x0000000000001000\n");
    folder.file("uio7/maps/map1/offset", "0x40\n");
    const auto map = read_uio_map(folder.path() + "/uio7", 1);
    ASSERT_TRUE(map) << map.error().message;
    EXPECT_EQ(map->size, 4096u);
    EXPECT_EQ(map->offset, 64u);
    const auto none = read_uio_map(folder.path() + "/uio7", 0);
    ASSERT_FALSE(none);
    EXPECT_THAT(none.error().message, HasSubstr("uio7 has no map 0"));
    folder.file("uio7/maps/map0/size", "what\n");
    const auto no_number = read_uio_map(folder.path() + "/uio7", 0);
    ASSERT_FALSE(no_number);
    EXPECT_THAT(no_number.error().message, HasSubstr("size has no number"));
}

TEST(LivePort, ItsClockNeverWaitsLessThanRequested) {
    MonotonicClock clock;
    for (const Duration wanted : {nanoseconds(1), microseconds(20), microseconds(200)}) {
        const Instant before = clock.now();
        clock.sleep(wanted);
        EXPECT_GE((clock.now() - before).count(), wanted.count());
    }
}

TEST(LivePort, ItsClockCanWaitForAFileWithoutTimeout) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    ASSERT_EQ(::write(ends[1], "x", 1), 1);
    MonotonicClock clock;
    EXPECT_TRUE(clock.wait_readable(ends[0], never));
    ::close(ends[0]);
    ::close(ends[1]);
}

/// A clock that advances only during waits.
class Counted final : public Clock {
  public:
    Instant now() const override { return now_; }
    void sleep(Duration duration) override { now_ += duration, ++sleeps; }
    bool wait_readable(int, Duration) override { return false; }
    int sleeps = 0;

  private:
    Instant now_{};
};

TEST(LivePort, LeavesTheCardItsGapBetweenTwoAccesses) {
    const Folder folder;
    auto owned = std::make_unique<Counted>();
    Counted& clock = *owned;
    const auto port =
        CardPort::open(*read_port_spec("memory:" + folder.file("card", std::string(8, '\0'))), four, std::move(owned));
    ASSERT_TRUE(port);
    (*port)->write(0, 1);
    EXPECT_EQ(clock.sleeps, 0);
    (*port)->write(0, 1);
    EXPECT_EQ(clock.now(), nanoseconds(250));
    (void)(*port)->read(4);
    EXPECT_EQ(clock.now(), nanoseconds(500));
    (*port)->pass(microseconds(1));
    (void)(*port)->read(4);
    EXPECT_EQ(clock.now(), nanoseconds(1500));
}

TEST(LivePort, AWaitWithoutAnInterruptLastsItsTimeout) {
    const Folder folder;
    const auto port = CardPort::open(*read_port_spec("memory:" + folder.file("card", std::string(8, '\0'))), four,
                                     std::make_unique<Counted>());
    ASSERT_TRUE(port);
    EXPECT_FALSE((*port)->has_interrupt());
    EXPECT_FALSE((*port)->wait(milliseconds(3)));
    EXPECT_EQ((*port)->now(), milliseconds(3));
}

}  // namespace
}  // namespace motionrack::live
