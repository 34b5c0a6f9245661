// Texts of a card's location, valid and invalid.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <motionrack/live/port_spec.hpp>

namespace motionrack::live {
namespace {

using testing::HasSubstr;

TEST(LivePortSpec, AcceptsMappedMemoryIoPortsAndUio) {
    const auto uio = read_port_spec("uio:/dev/uio3,map=1,offset=0x100");
    ASSERT_TRUE(uio) << uio.error().message;
    EXPECT_EQ(uio->reach, AddressSpace::uio);
    EXPECT_EQ(uio->path, "/dev/uio3");
    EXPECT_EQ(uio->interrupt, "/dev/uio3");
    EXPECT_EQ(uio->map, 1);
    EXPECT_EQ(uio->offset, 256u);

    const auto memory =
        read_port_spec("memory:/sys/bus/pci/devices/0000:03:00.0/resource1,stride=4,interrupt=/dev/uio0,gap_ns=0");
    ASSERT_TRUE(memory) << memory.error().message;
    EXPECT_EQ(memory->reach, AddressSpace::memory);
    EXPECT_EQ(memory->path, "/sys/bus/pci/devices/0000:03:00.0/resource1");
    EXPECT_EQ(memory->stride, 4u);
    EXPECT_EQ(memory->interrupt, "/dev/uio0");
    EXPECT_EQ(memory->gap, Duration{0});

    const auto port = read_port_spec("port:/dev/port,offset=0x300,width=8");
    ASSERT_TRUE(port) << port.error().message;
    EXPECT_EQ(port->reach, AddressSpace::port);
    EXPECT_EQ(port->offset, 0x300u);
    EXPECT_EQ(port->width, 8);
    EXPECT_EQ(port->interrupt, "");
    EXPECT_EQ(port->gap, nanoseconds(250));
}

TEST(LivePortSpec, InterruptsOfAUioNodeCanBeSwitchedOff) {
    const auto spec = read_port_spec("uio:/dev/uio0,interrupt=none");
    ASSERT_TRUE(spec);
    EXPECT_EQ(spec->interrupt, "");
}

TEST(LivePortSpec, ReportsTheErrorAndTheForm) {
    const std::pair<const char*, const char*> cases[] = {
        {"", "it has no ':'"},
        {"/dev/uio0", "it has no ':'"},
        {"usb:/dev/x", "unknown kind 'usb:'"},
        {"uio:", "the path is empty"},
        {"memory:/x,offset", "'offset' has no '='"},
        {"memory:/x,", "'' has no '='"},
        {"memory:/x,offset=-2", "offset is '-2', which is not a number"},
        {"memory:/x,offset=0x", "offset is '0x', which is not a number"},
        {"memory:/x,offset=99999999999999999999", "which is not a number"},
        {"memory:/x,stride=0", "stride is 0; it must be 1 to 4096"},
        {"memory:/x,stride=8192", "stride is 8192; it must be 1 to 4096"},
        {"memory:/x,width=12", "width is 12; it must be 8 or 16"},
        {"memory:/x,map=1", "only uio: has maps"},
        {"memory:/x,interrupt=", "'interrupt=none' is none"},
        {"memory:/x,irq=7", "unknown key 'irq'"},
    };
    for (const auto& [text, sentence] : cases) {
        const auto spec = read_port_spec(text);
        ASSERT_FALSE(spec) << text;
        EXPECT_THAT(spec.error().message, HasSubstr(sentence)) << text;
        EXPECT_THAT(spec.error().message, HasSubstr("uio:PATH, memory:PATH or port:PATH"));
    }
}

RC_GTEST_PROP(LivePortSpec, AnyTextGivesASpecOrASentence, (const std::string& tail)) {
    for (const char* start : {"", "uio:", "memory:/x,", "port:/x,offset="}) {
        const auto spec = read_port_spec(start + tail);
        const bool reported = spec ? !spec->path.empty() : !spec.error().message.empty();
        RC_ASSERT(reported);
    }
}

}  // namespace
}  // namespace motionrack::live
