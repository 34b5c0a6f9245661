// The vectorised decoder compared with its reference: every CPU's kernels, every length and alignment, the whole stream
// and block by block.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <motionrack/decode/channel.hpp>

#include "referee.hpp"

namespace motionrack::decode {
namespace {

Referee refereed(const std::uint8_t* samples, std::size_t size, const LineBits& lines) {
    Referee referee;
    for (std::size_t i = 0; i < size; ++i) referee.sample(samples[i], lines);
    return referee;
}

ChannelSettings keep_all() {
    ChannelSettings settings;
    settings.illegal_kept = settings.indexes_kept = ~std::size_t{0};
    return settings;
}

::testing::AssertionResult agrees(const ChannelDecoder& decoder, const Referee& referee) {
    if (decoder.count() != referee.count || decoder.up() != referee.up || decoder.down() != referee.down)
        return ::testing::AssertionFailure() << "counts " << decoder.count() << ", the referee's " << referee.count;
    if (decoder.illegal() != referee.illegal.size() || decoder.illegal_samples() != referee.illegal)
        return ::testing::AssertionFailure()
               << decoder.illegal() << " illegal, the referee's " << referee.illegal.size();
    if (decoder.indexes() != referee.indexes.size() || decoder.index_events() != referee.indexes)
        return ::testing::AssertionFailure()
               << decoder.indexes() << " indexes, the referee's " << referee.indexes.size();
    if (decoder.samples() != referee.samples) return ::testing::AssertionFailure() << decoder.samples() << " samples";
    return ::testing::AssertionSuccess();
}

std::vector<std::uint64_t> plane_of(const std::uint8_t* samples, std::size_t size, int bit) {
    // The data after the last sample are random on purpose.
    std::vector<std::uint64_t> plane(size / 64 + 1, 0xA5A5'5A5A'0FF0'1234U);
    for (std::size_t i = 0; i < size; ++i) {
        plane[i / 64] &= ~(std::uint64_t{1} << i % 64);
        plane[i / 64] |= std::uint64_t{samples[i] >> bit & 1U} << i % 64;
    }
    return plane;
}

class WideDecoder : public testing::TestWithParam<std::size_t> {
  protected:
    const Kernels& kernels() const { return available_kernels()[GetParam()]; }
};

TEST_P(WideDecoder, CountsBytesOfEveryLengthAndAlignmentAsTheReferenceDecoder) {
    for (std::size_t size = 0; size <= 300; ++size)
        for (std::size_t start = 0; start < 64; start += 1 + size % 3) {
            const auto stream = random_lines(size * 64 + start, size + start);
            const LineBits lines{static_cast<int>(size % 8), static_cast<int>((size + 3) % 8),
                                 start % 2 == 0 ? -1 : static_cast<int>((size + 6) % 8)};
            ChannelDecoder decoder(keep_all(), kernels());
            decoder.bytes(stream.data() + start, size, lines);
            ASSERT_TRUE(agrees(decoder, refereed(stream.data() + start, size, lines)))
                << kernels().name << " " << size << " from " << start;
        }
}

TEST_P(WideDecoder, CountsPlanesOfEveryLengthAsTheReferenceDecoder) {
    for (std::size_t size = 0; size <= 300; ++size) {
        const auto stream = random_lines(size, size);
        const auto a = plane_of(stream.data(), size, 0), b = plane_of(stream.data(), size, 1),
                   z = plane_of(stream.data(), size, 2);
        ChannelDecoder decoder(keep_all(), kernels()), without(keep_all(), kernels());
        decoder.planes(a.data(), b.data(), z.data(), size);
        without.planes(a.data(), b.data(), nullptr, size);
        ASSERT_TRUE(agrees(decoder, refereed(stream.data(), size, {0, 1, 2}))) << kernels().name << " " << size;
        ASSERT_TRUE(agrees(without, refereed(stream.data(), size, {0, 1, -1}))) << kernels().name << " " << size;
    }
}

TEST_P(WideDecoder, CountsFourChannelsInAByteAsTheReferenceDecoder) {
    const std::array<Bits, 4> orders[] = {{{{0, 1}, {2, 3}, {4, 5}, {6, 7}}}, {{{7, 0}, {3, 5}, {5, 3}, {1, 1}}}};
    for (std::size_t size = 0; size <= 300; ++size)
        for (const auto& bits : orders) {
            const auto stream = random_lines(size, size);
            FourChannelDecoder decoder(bits, kernels());
            const std::size_t first = size / 3;
            decoder.bytes(stream.data(), first);
            decoder.bytes(stream.data() + first, size - first);
            for (std::size_t channel = 0; channel < 4; ++channel) {
                const Referee referee = refereed(stream.data(), size, {bits[channel].a, bits[channel].b, -1});
                ASSERT_EQ(decoder.count(channel), referee.count) << kernels().name << " " << size;
                ASSERT_EQ(decoder.sums(channel).up, referee.up);
                ASSERT_EQ(decoder.sums(channel).illegal, referee.illegal.size());
            }
        }
}

RC_GTEST_PROP(WideDecoderStreams, AreTheSameInBlocksOfAnyLength, ()) {
    const auto seed = *rc::gen::arbitrary<std::uint64_t>();
    const auto sizes = *rc::gen::container<std::vector<std::size_t>>(rc::gen::inRange<std::size_t>(0, 9000));
    std::size_t total = 0;
    for (const std::size_t size : sizes) total += size;
    const auto stream = random_lines(seed, total);
    const LineBits lines{0, 1, 2};
    const Referee referee = refereed(stream.data(), total, lines);
    for (const Kernels& kernels : available_kernels()) {
        ChannelDecoder bytes(keep_all(), kernels), planes(keep_all(), kernels);
        FourChannelDecoder four({{{0, 1}, {2, 3}, {4, 5}, {6, 7}}}, kernels);
        std::size_t at = 0;
        for (const std::size_t size : sizes) {
            const std::uint8_t* const from = stream.data() + at;
            bytes.bytes(from, size, lines);
            planes.planes(plane_of(from, size, 0).data(), plane_of(from, size, 1).data(),
                          plane_of(from, size, 2).data(), size);
            four.bytes(from, size);
            at += size;
        }
        RC_ASSERT(static_cast<bool>(agrees(bytes, referee)));
        RC_ASSERT(static_cast<bool>(agrees(planes, referee)));
        RC_ASSERT(four.count(0) == referee.count);
        RC_ASSERT(four.count(3) == refereed(stream.data(), total, {6, 7, -1}).count);
    }
}

TEST_P(WideDecoder, CountsMillionsOfCountsInOneDirectionWithoutLosingACarry) {
    std::vector<std::uint8_t> stream(3'000'001);
    for (std::size_t i = 0; i < stream.size(); ++i) stream[i] = static_cast<std::uint8_t>((i ^ (i & 3U) >> 1) & 3U);
    ChannelDecoder up({}, kernels()), down({}, kernels());
    up.bytes(stream.data(), stream.size(), {0, 1, -1});
    down.bytes(stream.data(), stream.size(), {1, 0, -1});
    EXPECT_EQ(up.count(), 3'000'000);
    EXPECT_EQ(down.count(), -3'000'000);
    const auto a = plane_of(stream.data(), stream.size(), 0), b = plane_of(stream.data(), stream.size(), 1);
    ChannelDecoder planes({}, kernels());
    planes.planes(a.data(), b.data(), nullptr, stream.size());
    EXPECT_EQ(planes.up(), 3'000'000u);
    EXPECT_EQ(planes.illegal(), 0u);
}

INSTANTIATE_TEST_SUITE_P(OfThisCpu, WideDecoder, testing::Range<std::size_t>(0, available_kernels().size()),
                         [](const auto& kind) { return std::string(available_kernels()[kind.param].name); });

TEST(ChannelDecoder, StoresTheFirstIllegalTransitionsAndCountsAll) {
    ChannelSettings settings;
    settings.illegal_kept = 2;
    settings.indexes_kept = 1;
    std::vector<std::uint8_t> stream(1000);
    for (const std::size_t at : {100, 300, 301, 900})
        for (std::size_t i = at; i < stream.size(); ++i) stream[i] ^= 3;
    stream[200] = stream[500] = static_cast<std::uint8_t>(stream[200] | 4);
    ChannelDecoder decoder(settings);
    decoder.bytes(stream.data(), stream.size(), {0, 1, 2});
    EXPECT_EQ(decoder.illegal(), 4u);
    EXPECT_EQ(decoder.illegal_samples(), (std::vector<std::uint64_t>{100, 300}));
    EXPECT_EQ(decoder.indexes(), 2u);
    EXPECT_EQ(decoder.index_events(), (std::vector<IndexEvent>{{200, 0}}));
    EXPECT_EQ(decoder.count(), 0);
}

TEST(ChannelDecoder, UsesFallingEdgesOfAnActiveLowIndex) {
    ChannelSettings settings;
    settings.index_low = true;
    const std::vector<std::uint8_t> stream = {4, 5, 7, 3, 7, 7, 6, 2, 4};
    ChannelDecoder decoder(settings);
    decoder.bytes(stream.data(), stream.size(), {0, 1, 2});
    EXPECT_EQ(decoder.index_events(), (std::vector<IndexEvent>{{3, 2}, {7, 3}}));
    EXPECT_EQ(decoder.count(), 4);
}

TEST(ChannelDecoder, NumbersSamplesAfterSkippedOnes) {
    const std::vector<std::uint8_t> stream = {3, 0};
    ChannelDecoder decoder;
    decoder.skip(1000);
    decoder.bytes(stream.data(), stream.size(), {0, 1, -1});
    EXPECT_EQ(decoder.illegal_samples(), (std::vector<std::uint64_t>{1001}));
}

}  // namespace
}  // namespace motionrack::decode
