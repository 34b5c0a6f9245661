// Tests which samples a validator uses, counts and reports.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/dds/test/samples.hpp>
#include <vector>

namespace motionrack::dds {
namespace {

using testing::HasSubstr;

/// A validator, and functions that give it a frame each period.
class FrameValidatorTest : public testing::Test {
  protected:
    FrameValidator judge;
    PublisherIdentity first = source_named(1), second = source_named(2, "wafer2");
    Instant now = whole_seconds(5);

    Validation hear(const Sample& sample) { return judge.take(sample, now += period); }
    Validation hear(std::uint32_t number) { return hear(sample_of(first, number)); }
    std::vector<BusEvent> events() {
        std::vector<BusEvent> out;
        for (BusEvent event; judge.next_event(event);) out.push_back(event);
        return out;
    }
    /// Returns the messages of the waiting events of this kind, one per line; takes all waiting events.
    std::string reported(EventKind kind) {
        std::string out;
        for (const BusEvent& event : events())
            if (event.kind == kind) {
                if (!out.empty()) out += '\n';
                out += sentence(event);
            }
        return out;
    }
};

TEST_F(FrameValidatorTest, UsesFramesThatFollowEachOther) {
    EXPECT_TRUE(judge.stale());
    for (std::uint32_t i = 10; i < 20; ++i) {
        EXPECT_EQ(hear(i), Validation::used);
        EXPECT_EQ(judge.frame().counts[3], i * 1000 + 3);
    }
    EXPECT_EQ(judge.counts().used, 10u);
    EXPECT_EQ(judge.counts().lost, 0u);
    EXPECT_FALSE(judge.stale());
    EXPECT_THAT(reported(EventKind::joined), HasSubstr("wafer1, process 101, id 0101010101010101"));
}

TEST_F(FrameValidatorTest, CountsMissingFrames) {
    hear(10);
    EXPECT_EQ(hear(14), Validation::used);
    EXPECT_EQ(judge.counts().lost, 3u);
    EXPECT_EQ(reported(EventKind::lost),
              "3 frames after number 10 did not come, 3 so far. The next one is used; the lost ones are not replaced.");
}

TEST_F(FrameValidatorTest, SubtractsALateFrameFromTheLostOnesAndDoesNotUseIt) {
    hear(10);
    hear(12);
    EXPECT_EQ(hear(11), Validation::late);
    EXPECT_EQ(judge.counts().lost, 0u);
    EXPECT_EQ(judge.frame().sequence, 12u);
    EXPECT_EQ(hear(11), Validation::duplicate);
    EXPECT_EQ(hear(12), Validation::duplicate);
    EXPECT_EQ(hear(9), Validation::late) << "from before it listened";
    EXPECT_EQ(judge.counts().lost, 0u);
}

TEST_F(FrameValidatorTest, ContinuesWhereTheSequenceWraps) {
    const auto wrapped = [&](std::uint32_t number, std::int64_t periods) {
        Sample out = sample_of(first, number);
        out.frame.time = periods * period.count();
        seal(out);
        return out;
    };
    EXPECT_EQ(hear(wrapped(0xFFFF'FFFE, 10)), Validation::used);
    EXPECT_EQ(hear(wrapped(1, 13)), Validation::used);
    EXPECT_EQ(judge.counts().lost, 2u);
    EXPECT_EQ(hear(wrapped(0xFFFF'FFFF, 11)), Validation::late);
    EXPECT_EQ(judge.counts().lost, 1u);
}

TEST_F(FrameValidatorTest, RejectsASequenceNumberInconsistentWithItsTime) {
    hear(10);
    Sample jumped = sample_of(first, 5000);
    jumped.frame.time = sample_of(first, 11).frame.time;
    seal(jumped);
    EXPECT_EQ(hear(jumped), Validation::jump);
    EXPECT_EQ(judge.frame().sequence, 10u);
    EXPECT_THAT(reported(EventKind::jump), HasSubstr("Frame 5000 does not follow frame 10"));
    EXPECT_EQ(hear(12), Validation::used);
    EXPECT_EQ(judge.counts().lost, 1u);
}

TEST_F(FrameValidatorTest, FollowsACardThatWasReset) {
    hear(100);
    hear(101);
    const auto after_reset = [&](std::uint32_t number) {
        Sample out = sample_of(first, number);
        out.frame.time = sample_of(first, 102 + number).frame.time;
        seal(out);
        return out;
    };
    EXPECT_EQ(hear(after_reset(0)), Validation::jump) << "one frame alone is not believed";
    EXPECT_EQ(hear(after_reset(1)), Validation::used);
    EXPECT_EQ(judge.counts().anew, 1u);
    EXPECT_EQ(judge.counts().lost, 0u);
    EXPECT_THAT(reported(EventKind::anew), HasSubstr("restarted: frame 1 follows frame 101"));
    EXPECT_EQ(hear(after_reset(2)), Validation::used);
}

TEST_F(FrameValidatorTest, ReportsStaleFramesOnceAfterTwoPeriods) {
    hear(10);
    judge.poll(now + 2 * period);
    EXPECT_FALSE(judge.stale());
    judge.poll(now + 2 * period + Duration{1});
    EXPECT_TRUE(judge.stale());
    judge.poll(now + 3 * period);
    EXPECT_THAT(reported(EventKind::stale), HasSubstr("positions of frame 10 are stale"));
    now += whole_seconds(3);
    EXPECT_EQ(hear(10 + 15'001), Validation::used);
    EXPECT_FALSE(judge.stale());
    EXPECT_EQ(judge.counts().stale, 1u);
    EXPECT_EQ(judge.counts().lost, 15'000u);
    EXPECT_EQ(reported(EventKind::fresh), "Frames are received again, from number 15011 on.");
}

TEST_F(FrameValidatorTest, CountsAnInterruptionThatEndedBeforeTheNextQuery) {
    hear(10);
    now += 5 * period;
    hear(16);
    EXPECT_EQ(judge.counts().stale, 1u);
    EXPECT_FALSE(judge.stale());
}

TEST_F(FrameValidatorTest, NeverUsesASecondPublisherWhileTheFirstIsActive) {
    hear(10);
    EXPECT_EQ(hear(sample_of(second, 700)), Validation::other_source);
    EXPECT_FALSE(judge.in_conflict()) << "the first may be gone";
    hear(11);
    EXPECT_TRUE(judge.in_conflict());
    hear(sample_of(second, 701));
    hear(12);
    const std::string conflict = reported(EventKind::conflict);
    EXPECT_THAT(conflict, HasSubstr("[wafer1, process 101, id " + first.id_text() + "] has it"));
    EXPECT_THAT(conflict, HasSubstr("[wafer2, process 102, id " + second.id_text() + "] publishes too"));
    EXPECT_EQ(conflict.find('\n'), std::string::npos) << "told once";
    EXPECT_EQ(judge.counts().conflicts, 1u);
    EXPECT_EQ(judge.counts().used, 3u);
    ASSERT_EQ(judge.others().size(), 1u);
    EXPECT_EQ(judge.others()[0].frames, 2u);
}

TEST_F(FrameValidatorTest, EndsAConflictWhenTheSecondIsSilent) {
    hear(10);
    hear(sample_of(second, 700));
    for (std::uint32_t i = 11; judge.in_conflict() || i < 13; ++i) ASSERT_EQ(hear(i), Validation::used);
    EXPECT_THAT(reported(EventKind::conflict_over), HasSubstr("wafer2, process 102"));
    EXPECT_TRUE(judge.others().empty());
}

TEST_F(FrameValidatorTest, AcceptsTheNextSourceWhenTheFirstIsGone) {
    hear(10);
    hear(sample_of(second, 700));
    now += ValidatorSettings{}.release;
    EXPECT_EQ(hear(sample_of(second, 701)), Validation::used);
    EXPECT_EQ(judge.source(), second);
    EXPECT_EQ(judge.counts().takeovers, 1u);
    EXPECT_EQ(judge.counts().lost, 0u);
    EXPECT_EQ(judge.counts().conflicts, 0u);
    EXPECT_THAT(reported(EventKind::takeover), HasSubstr("[wafer2, process 102"));
    EXPECT_EQ(hear(11), Validation::other_source) << "the first comes back too late";
}

TEST_F(FrameValidatorTest, RecognisesAPublisherThatWasRestarted) {
    hear(10);
    const PublisherIdentity again = source_named(3);
    now += ValidatorSettings{}.release;
    EXPECT_EQ(hear(sample_of(again, 0)), Validation::used);
    EXPECT_EQ(judge.counts().restarts, 1u);
    EXPECT_EQ(judge.counts().takeovers, 0u);
    EXPECT_THAT(reported(EventKind::restart), HasSubstr("restarted"));
}

TEST_F(FrameValidatorTest, NeverUsesDamagedFrames) {
    hear(10);
    const auto damaged = [&](auto change) {
        Sample sample = sample_of(first, 11);
        change(sample);
        const Validation verdict = hear(sample);
        EXPECT_EQ(judge.frame().sequence, 10u);
        return verdict;
    };
    EXPECT_EQ(damaged([](Sample& s) { s.frame.counts[2] ^= 1; }), Validation::wrong_crc);
    EXPECT_EQ(damaged([](Sample& s) { s.frame.addresses[2] ^= 1; }), Validation::wrong_crc);
    EXPECT_EQ(damaged([](Sample& s) { s.frame.sequence ^= 1; }), Validation::wrong_crc);
    EXPECT_EQ(damaged([](Sample& s) { s.frame.crc ^= 1; }), Validation::wrong_crc);
    EXPECT_EQ(damaged([](Sample& s) { s.source.id[0] ^= 1; }), Validation::wrong_crc);
    EXPECT_EQ(damaged([](Sample& s) { s.pace += 1; }), Validation::wrong_crc);
    EXPECT_EQ(damaged([](Sample& s) { s.format += 1; }), Validation::foreign);
    EXPECT_EQ(damaged([](Sample& s) { s.frame.words = 0; }), Validation::malformed);
    EXPECT_EQ(damaged([](Sample& s) { s.frame.words = 129; }), Validation::malformed);
    EXPECT_EQ(damaged([](Sample& s) { s.frame.time = -1, seal(s); }), Validation::malformed);
    EXPECT_EQ(damaged([](Sample& s) { s.period = 0, seal(s); }), Validation::malformed);
    EXPECT_EQ(damaged([](Sample& s) { s.pace = -5, seal(s); }), Validation::malformed);
    EXPECT_EQ(damaged([](Sample& s) { s.source.host.fill('x'), seal(s); }), Validation::malformed)
        << "a name without end";
    EXPECT_EQ(damaged([](Sample& s) { s.source.host[0] = '\033', seal(s); }), Validation::malformed);
    EXPECT_EQ(damaged([](Sample& s) { s.period += 1, seal(s); }), Validation::malformed)
        << "another period than before";
    EXPECT_EQ(damaged([](Sample& s) { s.frame.words = 5, seal(s); }), Validation::wrong_words);
    EXPECT_EQ(judge.counts().wrong_crc, 6u);
    EXPECT_EQ(judge.counts().foreign, 1u);
    EXPECT_EQ(judge.counts().malformed, 8u);
    EXPECT_EQ(judge.counts().wrong_words, 1u);
    EXPECT_EQ(judge.counts().used, 1u);
    int kinds = 0;
    for (const BusEvent& event : events()) {
        EXPECT_FALSE(sentence(event).empty());
        kinds += event.kind == EventKind::joined ? 0 : 1;
    }
    EXPECT_EQ(kinds, 4) << "each kind is told once a second";
}

TEST_F(FrameValidatorTest, RejectsSourcesWithAnUnexpectedN) {
    judge = FrameValidator({.words = 8});
    EXPECT_EQ(hear(10), Validation::wrong_words);
    EXPECT_FALSE(judge.joined());
    EXPECT_THAT(reported(EventKind::wrong_words), HasSubstr("has 6 positions, but 8 are expected"));
    EXPECT_EQ(hear(sample_of(second, 3, 8)), Validation::used);
}

TEST_F(FrameValidatorTest, ReportsOnlyPrintableText) {
    Sample rude = sample_of(first, 1);
    rude.source.host[2] = '\033';
    hear(rude);
    EXPECT_THAT(reported(EventKind::wrong_crc), HasSubstr("wa?er1"));
}

TEST_F(FrameValidatorTest, StoresAFewOtherSourcesAndCountsTheRemainingOnes) {
    hear(10);
    for (std::uint8_t id = 50; id < 80; ++id) hear(sample_of(source_named(id, "crowd"), 1));
    EXPECT_EQ(judge.others().size(), FrameValidator::max_others);
    EXPECT_EQ(judge.counts().other_source, 30u);
    hear(42);
    EXPECT_EQ(judge.counts().conflicts, FrameValidator::max_others);
}

}  // namespace
}  // namespace motionrack::dds
