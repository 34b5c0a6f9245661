// Known breaches of the limits of axes, read from tests/known_breaches.txt.
//
//   known_breaches.txt ──known_breaches("trapezoid")──► LimitFactors ──► the checks of a run
//   the checks ──reached("trapezoid", ..)──► a line for each row that was used, at the end of the test program
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <tests/invariants/invariants.hpp>
#include <tests/source_root.hpp>

namespace motionrack::test {

/// Returns the factors of the list for these runs; makes the test fail if the list has no row for them.
inline LimitFactors known_breaches(std::string_view runs) {
    std::ifstream list(source_root / "tests/known_breaches.txt");
    LimitFactors out;
    bool listed = false;
    for (std::string line, name, limit; std::getline(list, line);) {
        std::istringstream row(line);
        double factor = 1;
        if (!(row >> name >> limit >> factor) || name != runs) continue;
        listed = true;
        (limit == "max_accel" ? out.max_accel : out.max_velocity_step) = factor;
    }
    EXPECT_TRUE(listed) << "tests/known_breaches.txt has no row for the runs " << runs;
    return out;
}

/// Returns the larger of each factor.
inline LimitFactors larger_of(const LimitFactors& one, const LimitFactors& other) {
    return {std::max(one.max_accel, other.max_accel), std::max(one.max_velocity_step, other.max_velocity_step)};
}

/// Largest factors that the runs of this program reached; prints them at its end, with those of the list.
class ReachedFactors final : public testing::Environment {
  public:
    void add(std::string_view runs, const LimitFactors& reached) {
        LimitFactors& so_far = reached_[std::string(runs)];
        so_far = larger_of(so_far, reached);
    }
    void TearDown() override {
        for (const auto& [runs, reached] : reached_) {
            const LimitFactors known = known_breaches(runs);
            std::fputs(
                fmt::format("known breaches, {}: max_accel {:.2f} of {:g}, max_velocity_step {:.2f} of {:g}\n", runs,
                            reached.max_accel, known.max_accel, reached.max_velocity_step, known.max_velocity_step)
                    .c_str(),
                stdout);
        }
    }
    /// Returns the object of this program, which GoogleTest owns.
    static ReachedFactors& of_program() {
        static auto* const own = new ReachedFactors;
        static const testing::Environment* const added = testing::AddGlobalTestEnvironment(own);
        static_cast<void>(added);
        return *own;
    }

  private:
    std::map<std::string, LimitFactors> reached_;
};

}  // namespace motionrack::test
