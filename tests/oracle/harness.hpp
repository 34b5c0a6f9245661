// Harness of the cards' oracle tests: a card and its twin, an independent second implementation of its rules, execute
// the same random programs and must agree in all observable values. A program that shows a difference is shortened
// while it still shows one, and printed with the command that repeats it.
//
// In the namespace of its type a program has
//   void run_both(const Program&, oracle::Comparison&)   runs it on the card and on the twin, and compares them
//   std::string listing_of(const Program&)               for messages
//   steps_of(Program&)                                   std::tie of the vectors of its steps; `ops` needs none
// and, if its state is saved and restored during the program, a member `snapshot_at`: the number of a step.
//
// MOTIONRACK_SEED and MOTIONRACK_PROGRAMS in the environment select other and more programs,
// MOTIONRACK_ONLY_PROGRAM selects a single one of them.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <tests/environment.hpp>
#include <tuple>
#include <utility>

namespace motionrack::oracle {

/// Value of `snapshot_at` of programs whose state is not saved.
inline constexpr std::size_t never = SIZE_MAX;

/// Compares the observable values of the twin and the card in one program.
class Comparison {
  public:
    template <class Twin, class Card>
    void same(std::string_view what, const Twin& twin, const Card& card) {
        if (!(twin == card)) differ(what, testing::PrintToString(twin), testing::PrintToString(card));
    }
    /// Compares lists; reports the first elements that differ.
    template <class Twin, class Card>
    void same_elements(std::string_view what, const Twin& twin, const Card& card) {
        const auto [t, c] = std::mismatch(std::begin(twin), std::end(twin), std::begin(card), std::end(card));
        if (t == std::end(twin) && c == std::end(card)) return;
        differ(fmt::format("{} {}", what, t - std::begin(twin)),
               t == std::end(twin) ? "none" : testing::PrintToString(*t),
               c == std::end(card) ? "none" : testing::PrintToString(*c));
    }
    /// Adds to a number that is printed after the last program.
    template <std::integral Number>
    void count(const std::string& what, Number number) {
        counts_[what] += static_cast<std::int64_t>(number);
    }
    void note(std::string_view text) { differences_ += text; }

    bool equal() const { return differences_.empty(); }
    const std::string& differences() const { return differences_; }
    const std::map<std::string, std::int64_t>& counts() const { return counts_; }

  private:
    void differ(std::string_view what, const std::string& twin, const std::string& card) {
        differences_ += fmt::format("{}: twin {}, card {}\n", what, twin, card);
    }

    std::string differences_;
    std::map<std::string, std::int64_t> counts_;
};

/// Returns a program as numbered lines, one per step.
template <class Steps>
std::string text_of_steps(const Steps& steps) {
    std::string out;
    for (std::size_t i = 0; i < steps.size(); ++i) out += fmt::format("{:5} {}\n", i, testing::PrintToString(steps[i]));
    return out;
}

/// Saves the kernel's state and the recorded values, calls `disturb`, which changes both, and restores them.
template <class Kernel, class Disturb, class... Recorded>
void disturb_and_restore(Kernel& kernel, const Disturb& disturb, Recorded&... recorded) {
    const auto snapshot = kernel.snapshot();
    const auto copies = std::make_tuple(recorded...);
    disturb();
    kernel.restore(snapshot);
    std::tie(recorded...) = copies;
}

template <class Program>
auto steps_of(Program& program) -> decltype(std::tie(program.ops)) {
    return std::tie(program.ops);
}

template <class Program>
std::string text_of_snapshot(const Program& program) {
    if constexpr (requires { program.snapshot_at; })
        if (program.snapshot_at != never)
            return fmt::format("its state is saved and restored at step {}\n", program.snapshot_at);
    return "";
}

template <class Program>
Comparison comparison_of(const Program& program) {
    Comparison out;
    run_both(program, out);
    return out;
}

/// Removes steps of vector number `part` while `fails(program)`. Keeps the last step, which ends the program.
template <std::size_t part, class Program, class Fails>
void shrink_part(Program& program, const Fails& fails, int max_tries) {
    const auto steps = [](Program& of) -> decltype(auto) { return std::get<part>(steps_of(of)); };
    for (std::size_t piece = std::max<std::size_t>(steps(program).size() / 2, 1); max_tries > 0;) {
        bool dropped = false;
        for (std::size_t at = 0; at + 1 < steps(program).size() && max_tries > 0; --max_tries) {
            const std::size_t count = std::min(piece, steps(program).size() - 1 - at);
            Program smaller = program;
            const auto from = steps(smaller).begin() + static_cast<std::ptrdiff_t>(at);
            steps(smaller).erase(from, from + static_cast<std::ptrdiff_t>(count));
            if constexpr (requires { smaller.snapshot_at; })  // at the same step
                if (program.snapshot_at != never && program.snapshot_at > at)
                    smaller.snapshot_at -= std::min(count, program.snapshot_at - at);
            if (fails(smaller)) {
                program = std::move(smaller);
                dropped = true;
            } else {
                at += piece;
            }
        }
        if (piece == 1 && !dropped) return;
        if (!dropped || piece > steps(program).size()) piece = std::max<std::size_t>(piece / 2, 1);
    }
}

/// Reduces a program to the steps that the failure needs; tries at most `max_tries` programs for each vector.
template <class Program, class Fails>
Program shrink(Program program, const Fails& fails, int max_tries = 3000) {
    [&]<std::size_t... part>(std::index_sequence<part...>) {
        (shrink_part<part>(program, fails, max_tries), ...);
    }
    (std::make_index_sequence<std::tuple_size_v<decltype(steps_of(program))>>());
    return program;
}

/// Return the number of programs of a test.
inline std::uint64_t programs(std::uint64_t everyday) {
    return cases("MOTIONRACK_PROGRAMS", everyday);
}
inline std::uint64_t programs(std::uint64_t everyday, std::uint64_t all) {
    return trials("MOTIONRACK_PROGRAMS", everyday, all);
}

/// Programs of a test: numbers first .. first + count - 1 of a seed.
struct Series {
    std::uint64_t first = 0, count = 0;
    std::uint64_t otherwise = 1;  ///< the seed without MOTIONRACK_SEED
};

/// Returns the command that runs only program `number` of the current test.
inline std::string command_of(std::uint64_t seed, std::uint64_t number, const Series& series) {
    const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
    return fmt::format("MOTIONRACK_SEED={} MOTIONRACK_PROGRAMS={} MOTIONRACK_ONLY_PROGRAM={} ./test -R {}.{}", seed,
                       number - series.first + 1, number, test.test_suite_name(), test.name());
}

/// Compares card and twin in the programs that `make(seed, number)` returns; fails at the first difference.
template <class Make>
void compare(const Series& series, const Make& make) {
    constexpr std::uint64_t every = UINT64_MAX;
    const std::uint64_t seed = seed_from_environment(series.otherwise), end = series.first + series.count;
    const std::uint64_t only = from_environment("MOTIONRACK_ONLY_PROGRAM", every);
    std::cout << "MOTIONRACK_SEED=" << seed << ", programs " << series.first << " .. " << end - 1 << std::endl;
    std::map<std::string, std::int64_t> counts;
    for (std::uint64_t number = series.first; number < end; ++number) {
        if (only != every && only != number) continue;
        const auto program = make(seed, number);
        const Comparison both = comparison_of(program);
        if (!both.equal()) {
            const auto small = shrink(program, [](const auto& p) { return !comparison_of(p).equal(); });
            FAIL() << "the card and its twin differ in program " << number << " of seed " << seed << ":\n"
                   << both.differences() << "and shortened:\n"
                   << comparison_of(small).differences() << text_of_snapshot(small) << listing_of(small)
                   << "To run it again: " << command_of(seed, number, series);
        }
        for (const auto& [what, count] : both.counts()) counts[what] += count;
    }
    for (const auto& [what, count] : counts) std::cout << count << ' ' << what << ", ";
    std::cout << "all the same" << std::endl;
}

}  // namespace motionrack::oracle
