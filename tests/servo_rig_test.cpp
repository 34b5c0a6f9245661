// The rig of appendix 1 of the DataBoard 4002 has the numbers shown on its page.
#include <gtest/gtest.h>

#include <motionrack/rack/session.hpp>
#include <string>
#include <tests/source_root.hpp>
#include <tests/text_of.hpp>

namespace motionrack {
namespace {

/// The rig of rig.toml at 3 V, with or without its [wires] row, for one second; counts and degrees.
struct Turned {
    double counts, degrees;
};

Turned turned(const std::string& rig, const std::string& wire) {
    auto session = std::move(*rack::Session::open(rig));
    const auto out = [&](std::uint32_t port, unsigned value) {
        EXPECT_TRUE(session->write("c1", 8, port, value));
        EXPECT_TRUE(session->advance(1'000'000));
    };
    out(1, 13);
    out(3, 'P');
    for (const unsigned byte : {0x00U, 0x00U, 0x70U}) out(0, byte);
    out(3, 'R');
    for (const unsigned byte : {16'250U & 0xFFU, 16'250U >> 8U}) out(0, byte);  // 3 V
    out(3, 'G');
    EXPECT_TRUE(session->advance(500'000'000));
    EXPECT_NEAR(*session->wire(wire), 3, 1e-6);
    EXPECT_NEAR(*session->wire("C.drive"), 3, 1e-6);
    const double counts = *session->part("C.position_counts"), degrees = *session->part("C.position_deg");
    EXPECT_TRUE(session->advance(1'000'000'000));
    return {*session->part("C.position_counts") - counts, *session->part("C.position_deg") - degrees};
}

TEST(ServoRig, ThreeVoltsAreAThousandTurnsAMinuteOfItsEncoderBehindTheRelayOrDirectly) {
    std::string rig = text_of(source_root / "examples/servo_rig/rig.toml");
    const Turned behind = turned(rig, "c1.vout");
    const std::string row = "# \"C.drive\" = \"c1.vdirect\"";
    ASSERT_NE(rig.find(row), std::string::npos);
    const Turned direct = turned(rig.replace(rig.find(row), 2, ""), "c1.vdirect");
    for (const Turned& each : {behind, direct}) {
        EXPECT_NEAR(each.degrees / 360 * 60, 1000, 10);
        EXPECT_NEAR(each.counts / each.degrees * 360, 4000, 1);
    }
}

}  // namespace
}  // namespace motionrack
