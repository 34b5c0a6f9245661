// RemoteFeed with a scripted subscriber, the publishing loop, and settings refused before any network access.
#include <gtest/gtest.h>

#include <motionrack/dds/frame_publisher.hpp>
#include <motionrack/dds/remote_feed.hpp>
#include <motionrack/dds/test/samples.hpp>
#include <vector>

namespace motionrack::dds {
namespace {

/// Subscriber whose samples come from the test.
class ScriptedSubscriber final : public Subscriber {
  public:
    ScriptedSubscriber() : Subscriber(ValidatorSettings{}) {}
    Instant poll(const Use& use) override {
        for (const Sample& sample : waiting) {
            const Validation verdict = judge_.take(sample, now += period);
            if (use) use(sample, verdict, now);
        }
        waiting.clear();
        judge_.poll(now);
        return now;
    }
    bool wait(Duration) override { return !waiting.empty(); }
    std::uint64_t overruns() const override { return 0; }

    std::vector<Sample> waiting;
    Instant now{};
};

TEST(RemoteFeed, GivesACardEachGoodFrameOnce) {
    auto made = std::make_unique<ScriptedSubscriber>();
    ScriptedSubscriber& network = *made;
    RemoteFeed feed(std::move(made));
    std::vector<std::uint32_t> given;
    const auto card = [&](const Frame& frame, Instant now) {
        EXPECT_EQ(now, milliseconds(7));
        given.push_back(frame.sequence);
    };
    EXPECT_TRUE(feed.stale());
    Sample damaged = sample_of(source_named(1), 12);
    damaged.frame.counts[0] ^= 1;
    network.waiting = {sample_of(source_named(1), 10), sample_of(source_named(1), 11), damaged,
                       sample_of(source_named(2), 11), sample_of(source_named(1), 11), sample_of(source_named(1), 13)};
    EXPECT_EQ(feed.give(milliseconds(7), card), 3);
    EXPECT_EQ(feed.give(milliseconds(7), card), 0);
    EXPECT_EQ(given, (std::vector<std::uint32_t>{10, 11, 13}));
    EXPECT_FALSE(feed.stale());
    network.now += 3 * period;
    EXPECT_EQ(feed.give(milliseconds(7), card), 0);
    EXPECT_TRUE(feed.stale());
}

class CountingPublisher final : public Publisher {
  public:
    bool publish(const Frame& frame) override {
        numbers.push_back(frame.sequence);
        ++sent_;
        return true;
    }
    void poll() override {}
    bool next_event(BusEvent&) override { return false; }
    std::vector<std::uint32_t> numbers;
};

/// Source of the frames 0, 1, ...; returns an error at frame `broken`.
class CountingSource final : public FrameSource {
  public:
    std::uint32_t number = 0, frames = 100, broken = 1000;
    Result<bool> next(Frame& frame) override {
        if (number == broken) return fail(ErrorKind::machine, "The scale is broken.");
        frame = sample_of(source_named(1), number).frame;
        return number++ < frames;
    }
};

TEST(FramePublisher, EndsWithTheSourceOrTheCountOrTheStop) {
    PublishingSettings settings;
    settings.time_scale = 1e6;
    {
        CountingPublisher publisher;
        CountingSource source;
        const auto done = publish_frames(publisher, source, settings);
        ASSERT_TRUE(done);
        EXPECT_EQ(publisher.numbers.size(), 100u);
        EXPECT_EQ(publisher.numbers.back(), 99u);
        EXPECT_FALSE(done->stopped);
    }
    {
        CountingPublisher publisher;
        CountingSource source;
        settings.max_frames = 7;
        ASSERT_TRUE(publish_frames(publisher, source, settings));
        EXPECT_EQ(publisher.numbers.size(), 7u);
    }
    {
        CountingPublisher publisher;
        CountingSource source;
        const std::atomic<bool> stop{true};
        settings.stop = &stop;
        const auto done = publish_frames(publisher, source, settings);
        ASSERT_TRUE(done);
        EXPECT_TRUE(done->stopped);
        EXPECT_TRUE(publisher.numbers.empty());
    }
}

TEST(FramePublisher, ReportsTheErrorOfTheSource) {
    CountingPublisher publisher;
    CountingSource source;
    source.broken = 5;
    PublishingSettings settings;
    settings.time_scale = 1e6;
    const auto done = publish_frames(publisher, source, settings);
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().message, "The scale is broken.");
    EXPECT_EQ(publisher.numbers.size(), 5u);
}

TEST(Opening, RejectsInvalidNamesDomainsAndPeriods) {
    EXPECT_FALSE(Subscriber::open({.bus = "a*", .judge = {}}));
    EXPECT_FALSE(Subscriber::open({.bus = "a", .domain = 233, .judge = {}}));
    EXPECT_FALSE(Publisher::open({"", 0, period, period}));
    EXPECT_FALSE(Publisher::open({"a", -1, period, period}));
    const auto fast = Publisher::open({"a", 0, period, nanoseconds(1)});
    ASSERT_FALSE(fast);
    EXPECT_EQ(fast.error().message,
              "The pace of the frames is 0.001 us, but must be 1 us to 60 s. Nothing was published.");
}

}  // namespace
}  // namespace motionrack::dds
