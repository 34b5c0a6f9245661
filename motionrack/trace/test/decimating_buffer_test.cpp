// Keeps a bounded number of any number of samples, and always the maximum deviation.
#include <gtest/gtest.h>

#include <algorithm>
#include <motionrack/trace/decimating_buffer.hpp>

namespace motionrack::trace {
namespace {

TEST(DecimatingBuffer, KeepsAllWhileTheyAreFew) {
    DecimatingBuffer<int> keeper(16);
    for (int i = 0; i < 16; ++i) keeper.add(i, 0.5 * i);
    ASSERT_EQ(keeper.samples().size(), 16u);
    EXPECT_EQ(keeper.samples()[5], 5);
    EXPECT_EQ(keeper.deviations()[5], 2.5);
}

TEST(DecimatingBuffer, KeepsTheMaxDeviationWhereverItIs) {
    constexpr int all = 1000;
    for (int max_error = 0; max_error < all; ++max_error) {
        DecimatingBuffer<int> keeper(16);
        for (int i = 0; i < all; ++i) keeper.add(i, i == max_error ? 7 : 1);
        ASSERT_LE(keeper.samples().size(), 16u);
        ASSERT_EQ(keeper.samples().size(), keeper.deviations().size());
        const auto found = std::max_element(keeper.deviations().begin(), keeper.deviations().end());
        ASSERT_EQ(*found, 7) << "of sample " << max_error;
        ASSERT_LE(keeper.samples()[static_cast<std::size_t>(found - keeper.deviations().begin())], max_error)
            << "it is told at the sample that it became one with";
    }
}

}  // namespace
}  // namespace motionrack::trace
