// Channels that a recorder samples by functions.
#include <gmock/gmock.h>

#include <bit>
#include <memory>
#include <motionrack/rack/recorder.hpp>
#include <string>
#include <utility>
#include <vector>

namespace motionrack::rack {
namespace {

struct KeptChange {
    std::string channel;
    double value = 0;
    Instant at{};
    friend bool operator==(const KeptChange&, const KeptChange&) = default;
};

class KeptChanges final : public ChangeSink {
  public:
    KeptChanges(std::vector<KeptChange>& kept, std::vector<Channel> channels)
        : kept_(kept), channels_(std::move(channels)) {}
    void change(std::size_t index, std::int64_t value, Instant at) override {
        kept_.push_back({channels_[index].name, channels_[index].shown(value), at});
    }

  private:
    std::vector<KeptChange>& kept_;
    std::vector<Channel> channels_;
};

/// Cannot be ended.
class LostSink final : public ChangeSink {
  public:
    void change(std::size_t, std::int64_t, Instant) override {}
    Result<void> close(Instant) override { return fail(ErrorKind::io, "The disk is full."); }
    bool can_end_again() const override { return false; }
};

/// A running rack whose time is sampled each 2 ms, from 1 ms on.
struct SampledTime {
    explicit SampledTime(bool breaks, bool lost = false)
        : rack(*read_rack_text("card.c1 = \"mcx314\"").config), tap(rack.kernel()) {
        rack.start();
        RecorderSettings settings;
        settings.period = milliseconds(2);
        settings.tap = &tap;
        settings.breaks = breaks;
        settings.sampled = {
            {{"seconds", ChannelKind::quantity},
             [this] { return std::bit_cast<std::int64_t>(to_seconds(rack.kernel().now())); }},
            {{"milliseconds", ChannelKind::number}, [this] { return rack.kernel().now() / milliseconds(1); }}};
        settings.sink = [this, lost](const Declaration& declared) -> Result<std::shared_ptr<ChangeSink>> {
            if (lost) return std::make_shared<LostSink>();
            return std::make_shared<KeptChanges>(kept, declared.channels);
        };
        recorder = std::move(*Recorder::create(rack, settings));
        recorder->begin(milliseconds(1));
    }

    Rack rack;
    RecorderTap tap;
    std::vector<KeptChange> kept;
    std::unique_ptr<Recorder> recorder;
};

TEST(Recorder, SamplesEachPeriodWithinARun) {
    SampledTime bench(false);
    EXPECT_EQ(bench.rack.kernel().run_until(milliseconds(4)), sim::RunEnd::reached);
    EXPECT_TRUE(bench.kept.empty()) << "a sink runs between runs";
    bench.recorder->drain();
    const std::vector<KeptChange> samples = {{"seconds", to_seconds(milliseconds(1)), milliseconds(1)},
                                             {"milliseconds", 1, milliseconds(1)},
                                             {"seconds", to_seconds(milliseconds(3)), milliseconds(3)},
                                             {"milliseconds", 3, milliseconds(3)}};
    EXPECT_EQ(bench.kept, samples);
}

TEST(Recorder, EndsARunForEachSampleThatIsTakenBetweenRuns) {
    SampledTime bench(true);
    sim::Kernel& kernel = bench.rack.kernel();
    EXPECT_EQ(kernel.run_until(milliseconds(4)), sim::RunEnd::broken);
    EXPECT_EQ(kernel.now(), milliseconds(1));
    bench.recorder->poll_due();
    bench.recorder->poll_due();  // nothing is due
    bench.recorder->drain();
    const std::vector<KeptChange> sample = {{"seconds", to_seconds(milliseconds(1)), milliseconds(1)},
                                            {"milliseconds", 1, milliseconds(1)}};
    EXPECT_EQ(bench.kept, sample);
    EXPECT_TRUE(bench.recorder->finish());
    EXPECT_EQ(kernel.run_until(milliseconds(4)), sim::RunEnd::reached) << "a finished recorder ends no run";
}

TEST(Recorder, EndsARunBeforeItsBufferOfSamplesIsFull) {
    SampledTime bench(false);
    sim::Kernel& kernel = bench.rack.kernel();
    int ended = 0;
    for (; kernel.run_until(whole_seconds(200)) == sim::RunEnd::broken; ++ended) bench.recorder->drain();
    bench.recorder->drain();
    EXPECT_GT(ended, 1);
    EXPECT_EQ(bench.kept.size(), 200'000u) << "two each 2 ms";
    EXPECT_TRUE(bench.recorder->finish()) << "none was omitted";
}

TEST(Recorder, ReportsOmittedChangesOfARecordingThatIsOtherwiseComplete) {
    SampledTime bench(false);
    sim::Kernel& kernel = bench.rack.kernel();
    while (kernel.run_until(whole_seconds(200)) == sim::RunEnd::broken) continue;  // nothing drains the buffer
    const Result<void> ended = bench.recorder->finish();
    ASSERT_FALSE(ended);
    EXPECT_THAT(ended.error().message, testing::HasSubstr("The recording has all others"));
    EXPECT_TRUE(bench.recorder->is_closed());
    EXPECT_FALSE(bench.recorder->can_end_again());
    EXPECT_GT(bench.kept.size(), 100'000u);
    EXPECT_LT(bench.kept.size(), 200'000u);
}

TEST(Recorder, StopsListeningOnceItCannotBeEndedAnyMore) {
    SampledTime bench(true, true);
    EXPECT_FALSE(bench.recorder->finish());
    EXPECT_EQ(bench.rack.kernel().run_until(milliseconds(4)), sim::RunEnd::reached) << "no sample is due";
    EXPECT_FALSE(bench.recorder->finish()) << "it stays lost";
}

TEST(Recorder, LeavesItsTapToTheNextOne) {
    SampledTime bench(false);
    bench.recorder.reset();
    EXPECT_EQ(bench.rack.kernel().run_until(milliseconds(4)), sim::RunEnd::reached);
    EXPECT_TRUE(bench.kept.empty());
}

}  // namespace
}  // namespace motionrack::rack
