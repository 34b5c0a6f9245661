// Random calls of motionrack/c.h with valid and invalid arguments: each returns a code, an error has its sentence and
// changes nothing, and a copy stays the same.
#include <gtest/gtest.h>
#include <motionrack/c.h>

#include <cstdlib>
#include <iostream>
#include <limits>
#include <random>
#include <string>
#include <tests/environment.hpp>
#include <vector>

namespace {

class Hostile {
  public:
    explicit Hostile(std::uint64_t seed) : random_(seed) {
        EXPECT_EQ(mr_rack_open("[card.c1]\ntype = \"mcx314\"\n[axis.X]\ncard = \"c1\"\nchannel = "
                               "\"x\"\n[axis.X.switches]\nlimit_plus_mm = "
                               "301\n[axis.B]\ncard = \"c1\"\nchannel = \"y\"\n",
                               &rack_),
                  MR_OK)
            << mr_last_error();
    }
    ~Hostile() { mr_rack_close(rack_); }

    void call() {
        const std::uint64_t before = mr_state_hash(rack_);
        const int code = one();
        EXPECT_TRUE(code == MR_OK || code == MR_BAD_CALL || code == MR_REFUSED) << code << ": " << mr_last_error();
        if (code == MR_OK) return;
        EXPECT_GT(std::string(mr_last_error()).size(), 20u);
        EXPECT_EQ(mr_state_hash(rack_), before) << mr_last_error();
    }

  private:
    int one() {
        std::uint16_t word = 0;
        std::uint64_t wide = 0;
        double value = 0;
        switch (pick(14)) {
            case 0:
                return mr_advance_ns(rack_, pick(3) == 0 ? random_() : pick(2'000'000));
            case 1:
                return mr_read16(rack_, card(), offset(), pick(50) == 0 ? nullptr : &word);
            case 2:
                return mr_peek(rack_, card(), name(), &wide);
            case 3:
                return mr_wire_get(rack_, name(), &value);
            case 4:
            case 5:
                return mr_wire_set(rack_, name(), number());
            case 6:
                return mr_part_get(rack_, name(), &value);
            case 7:
                return mr_part_set(rack_, name(), number());
            case 8:
                return mr_fault(rack_, name(), name());
            case 9:
                return copies();
            default:
                return mr_write16(rack_, card(), offset(), static_cast<std::uint16_t>(random_()));
        }
    }

    int copies() {
        if (pick(20) != 0) return mr_wire_get(rack_, "estop", nullptr);
        mr_rack* copy = nullptr;
        const int code = mr_snapshot(rack_, &copy);
        EXPECT_EQ(mr_state_hash(copy), mr_state_hash(rack_));
        mr_rack* gone = pick(2) == 0 ? copy : rack_;
        if (gone == rack_) rack_ = copy;
        mr_rack_close(gone);
        return code;
    }

    std::uint64_t pick(std::uint64_t below) { return random_() % below; }
    const char* card() { return pick(50) == 0 ? nullptr : pick(20) == 0 ? "c2" : "c1"; }
    std::uint32_t offset() { return static_cast<std::uint32_t>(pick(20) == 0 ? random_() : 2 * pick(8)); }
    double number() {
        static const double some[] = {0,  1,     std::numeric_limits<double>::quiet_NaN(), 0.5,
                                      -1, 1e300, -std::numeric_limits<double>::infinity(), 17.25,
                                      1e6};
        return pick(3) == 0   ? some[pick(2)]
               : pick(5) == 0 ? static_cast<double>(random_()) / 1e9
                              : some[pick(std::size(some))];
    }
    const char* name() {
        static const char* const some[] = {"c1.xlmtp",
                                           "c1.xlmtm",
                                           "c1.xeca",
                                           "c1.xecb",
                                           "c1.yeca",
                                           "c1.yecb",
                                           "c1.xin0",
                                           "c1.emgn",
                                           "c1.xalarm",
                                           "estop",
                                           "X.limit_plus",
                                           "X.enc_z",
                                           "B.enc_z",
                                           "X.step",
                                           "c1.xpp",
                                           "c1.int_n",
                                           "X.position_mm",
                                           "B.position_deg",
                                           "X.position_pulses",
                                           "X.in_step",
                                           "RR0",
                                           "x.RR1",
                                           "u.LP",
                                           "X",
                                           "B",
                                           "motor.stall",
                                           "motor.stall=0",
                                           "motor.push=99",
                                           "motor.lose_steps=3",
                                           "encoder.broken_a",
                                           "encoder.swapped=1",
                                           "limit_plus.stuck_closed",
                                           "encoder.broken_b=0",
                                           "home.stuck_open"};
        if (pick(60) == 0) return nullptr;
        if (pick(8) != 0) return some[pick(std::size(some))];
        scratch_[next_ ^= 1] = some[pick(std::size(some))];
        std::string& text = scratch_[next_];
        for (std::uint64_t i = pick(4); i-- > 0;) {
            const std::size_t at = pick(text.size() + 1);
            if (pick(2) == 0 && at < text.size())
                text.erase(at, 1);
            else
                text.insert(at, 1, static_cast<char>(pick(255) + 1));
        }
        return text.c_str();
    }

    std::mt19937_64 random_;
    mr_rack* rack_ = nullptr;
    std::string scratch_[2];
    std::size_t next_ = 0;
};

std::uint64_t seed_given() {
    const std::uint64_t seed = motionrack::seed_from_environment();
    std::cout << "MOTIONRACK_SEED=" << seed << std::endl;
    return seed;
}

TEST(CHostile, RandomCallsReturnCodesAndMessagesOnly) {
    const std::uint64_t seed = seed_given();
    for (std::uint64_t world = 0; world < 20 && !testing::Test::HasFailure(); ++world) {
        Hostile hostile(seed * 1000 + world);
        for (int i = 0; i < 2000 && !testing::Test::HasFailure(); ++i) hostile.call();
    }
}

/// Any output connected to any input: the rack is rejected, or runs with any data written to the card.
TEST(CHostile, RacksWithRandomWiresRunOrAreRejected) {
    const std::uint64_t seed = seed_given();
    std::mt19937_64 random(seed);
    static const char* const outputs[] = {"xpp",   "xpm",     "ypp",     "ypm",     "xout0",  "xout3",
                                          "xout4", "xout5",   "xout6",   "xout7",   "yout7",  "int_n",
                                          "estop", "X.enc_a", "X.enc_b", "X.enc_z", "X.home", "open"};
    static const char* const inputs[] = {"xin0",  "xin1",  "xin2",  "xlmtp", "xlmtm",   "xalarm", "xinpos",
                                         "xexpp", "xexpm", "xeca",  "xecb",  "yin0",    "yexpp",  "yexpm",
                                         "yeca",  "yecb",  "ylmtp", "emgn",  "expls_n", "X.step", "X.dir"};
    const auto full = [](const char* name) {
        const std::string text = name;
        return text.find('.') != std::string::npos || text == "estop" || text == "open" ? text : "c1." + text;
    };
    int opened = 0;
    for (int world = 0; world < 300; ++world) {
        std::string text =
            "[card.c1]\ntype = \"mcx314\"\n[axis.X]\ncard = \"c1\"\nchannel = \"x\"\n[axis.X.switches]\nhome_mm = "
            "1\n[wires]\n";
        for (const char* input : inputs)
            if (random() % 4 == 0)
                text += '"' + full(input) + "\" = \"" + full(outputs[random() % std::size(outputs)]) + "\"\n";
        mr_rack* rack = nullptr;
        const int code = mr_rack_open(text.c_str(), &rack);
        ASSERT_TRUE(code == MR_OK || code == MR_BAD_INPUT) << mr_last_error();
        if (code != MR_OK) continue;
        ++opened;
        for (int i = 0; i < 300; ++i) {
            mr_write16(rack, "c1", static_cast<std::uint32_t>(2 * (random() % 8)),
                       static_cast<std::uint16_t>(random()));
            mr_write16(rack, "c1", 0, static_cast<std::uint16_t>(random() % 16 << 8 | random() % 0x40));
            if (random() % 8 == 0) mr_advance_ns(rack, random() % 200'000);
        }
        mr_rack_close(rack);
    }
    EXPECT_GT(opened, 20);
}

}  // namespace
