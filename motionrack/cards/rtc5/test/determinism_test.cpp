// Checks that random jobs give the same samples and states, as one hash, with every compiler and optimisation level.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <motionrack/base/fnv.hpp>
#include <motionrack/cards/rtc5/model/engine.hpp>
#include <motionrack/cards/rtc5/test/job.hpp>

namespace motionrack::rtc5 {
namespace {

class Mixer final : public Sink {
  public:
    void samples(const Samples& b) override {
        for (std::size_t i = 0; i < b.x.size(); ++i) {
            mix(static_cast<std::uint32_t>(b.x[i]));
            mix(static_cast<std::uint32_t>(b.y[i]));
            mix(b.laser[i]);
        }
    }
    void mix(std::uint64_t value) { hash = fnv_step(hash, value); }
    std::uint64_t hash = 1469598103934665603ull;
};

TEST(Rtc5Card, SamplesAndStatesHaveTheSameBitsOnEveryCompiler) {
    Mixer mixer;
    const CorrectionFile file = *correction_of({});
    for (const auto* plane : {&file.x, &file.inverse_y})
        for (const std::int32_t v : *plane) mixer.mix(static_cast<std::uint32_t>(v));
    const auto table = table_of(file);
    for (std::uint64_t seed = 777; seed < 877; ++seed) {
        const Job job = JobMaker(seed).make();
        Engine card({1700, 800, 800});
        ASSERT_TRUE(card.parts().heads.load_table(table, 1));
        ASSERT_TRUE(card.parts().heads.select_tables(1, 0));
        ASSERT_TRUE(card.parts().encoders.simulate(3));
        for (const Command& c : job.list1)
            if (!card.put(c)) break;
        card.parts().execution.start_loop();
        ASSERT_TRUE(card.execute_list(1));
        card.run_until(20'000, &mixer);
        std::array<unsigned char, sizeof(State)> bytes{};
        std::memcpy(bytes.data(), &card.state(), sizeof(State));
        for (std::size_t i = 0; i < offsetof(State, memory_hash); ++i) mixer.mix(bytes[i]);
    }
    // The hash computed by g++ 12 -O3 and clang 14 -O0; it changes with the rules and the random jobs.
    EXPECT_EQ(mixer.hash, 0xCDDE303A03E3F080ull);
}

}  // namespace
}  // namespace motionrack::rtc5
