// Known breaches of the limits of axes, from the one list that has them.
//
//   known_breaches.txt ──known_breaches("trapezoid")──► LimitFactors ──► the judges of a run
//   the judges ──reached("trapezoid", ..)──► a line for each row that was used, at the end of the test program
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

/// The factors that the list has for these runs. A test that names runs without a row fails.
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

/// Of two kinds of runs at once.
inline LimitFactors larger_of(const LimitFactors& one, const LimitFactors& other) {
    return {std::max(one.max_accel, other.max_accel), std::max(one.max_velocity_step, other.max_velocity_step)};
}

/// The largest factors that the runs of this program reached. Prints them at its end, beside those of the list.
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
    /// That of this program, which GoogleTest owns.
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
