// Any word to any register and any level to any wire at any time: the card keeps its values in their ranges, a peek changes nothing,
// and equal inputs give equal histories.
//
// MOTIONRACK_SEED and MOTIONRACK_ACCESSES in the environment choose another and a longer run.
#include <gtest/gtest.h>

#include <iostream>
#include <motionrack/cards/ioflex02/test/rig.hpp>
#include <random>

namespace motionrack::ioflex02 {
namespace {

struct Fuzz {
    explicit Fuzz(std::uint64_t seed, bool loaded) : random(seed), rig(settings_for(loaded)) { rig.start(); }
    static Settings settings_for(bool loaded) {
        Settings out;
        out.loaded = loaded;
        out.configuration_time = microseconds(70);
        return out;
    }
    std::uint64_t below(std::uint64_t n) { return random() % n; }

    void step() {
        const std::uint64_t what = below(100);
        if (what < 45) {
            const sim::WireId wire = rig.kernel.find_wire("c1." + std::string(map::pins[below(32)].name));
            rig.kernel.set_wire(wire, static_cast<int>(below(2)));
            if (below(2)) rig.kernel.settle();
        } else if (what < 65) {
            rig.write(static_cast<std::uint32_t>(below(20) ? 2 * below(0x34) : below(0x10000)), static_cast<int>(below(65536)));
        } else if (what < 85) {
            rig.read(static_cast<std::uint32_t>(below(20) ? 2 * below(0x34) : below(0x10000)));
        } else if (what == 85 && below(20) == 0) {
            rig.feed(*unpacked(position_image({static_cast<std::uint16_t>(below(65536)), 0, 0, 0})), below(2) != 0);
        } else {
            rig.run(Duration{static_cast<std::int64_t>(below(30) ? below(20'000) : below(20'000'000))});
        }
    }
    void check() {
        const std::uint64_t hash = rig.kernel.state_hash();
        for (std::uint32_t at = 0; at < window; ++at) rig.card.peek(at);
        for (int axis = 0; axis < 4; ++axis) {
            EXPECT_GE(rig.card.position(axis), -8'388'608);
            EXPECT_LE(rig.card.position(axis), 8'388'607);
            EXPECT_EQ(rig.card.status(axis) == sCal, rig.card.calibration(axis) == CalState::calibrated);
        }
        EXPECT_LE(rig.card.time(), mask_24);
        EXPECT_EQ(rig.card.peek(offset("SIGNATURE")), signature);
        for (int i = 16; i < 32; ++i) EXPECT_EQ(rig.level("out" + std::to_string(i)), 0);
        EXPECT_EQ(rig.kernel.state_hash(), hash);
    }

    std::mt19937_64 random;
    Rig rig;
};

TEST(Ioflex02Fuzz, AnyAccessAtAnyTimeDoesNoHarm) {
    const std::uint64_t seed = from_environment("MOTIONRACK_SEED", 2004), accesses = from_environment("MOTIONRACK_ACCESSES", 60'000);
    std::cout << "seed " << seed << ", " << accesses << " accesses" << std::endl;
    for (const bool loaded : {true, false}) {
        Fuzz one(seed, loaded), two(seed, loaded);
        for (std::uint64_t i = 0; i < accesses; ++i) {
            one.step();
            two.step();
            if (i % 50 == 0) one.check();  // looking does not disturb
        }
        EXPECT_EQ(one.rig.kernel.state_hash(), two.rig.kernel.state_hash());
        EXPECT_EQ(one.rig.kernel.trace_hash(), two.rig.kernel.trace_hash());
        for (const sim::Condition& c : one.rig.kernel.conditions()) ASSERT_EQ(describe(c, "c1").find("condition"), std::string::npos);
    }
}

}  // namespace
}  // namespace motionrack::ioflex02
