// Commands during a run that change nothing leave its history and its results as they are, bit for bit.
// MOTIONRACK_SEED=N selects the first program, MOTIONRACK_PROGRAMS=N their number.
#include <array>
#include <motionrack/rack/command_schedule.hpp>
#include <motionrack/rack/job_report.hpp>
#include <random>
#include <utility>
#include <vector>

#include "journey.hpp"
#include "random_program.hpp"

namespace motionrack::rack {
namespace {

using TimedCommands = std::vector<std::pair<Instant, std::string>>;

/// An instant that no run of these tests reaches.
constexpr Instant after_everything = whole_seconds(100'000);

struct CommandedRun {
    JobOutcome outcome;
    std::string json;  ///< summary without the number of events, which counts the commands
    Instant end{};
    std::size_t not_done = 0;  ///< commands after the end
};

std::string without_events(const std::string& json) {
    const std::size_t begin = json.find("  \"events\":");
    return json.substr(0, begin) + json.substr(json.find('\n', begin));
}

/// Executes a program with commands, and one after everything that makes each run take them.
CommandedRun run_with(const RackConfig& config, const std::string& program, const TimedCommands& commands) {
    Rack rack(config);
    std::vector<ScheduledText> texts = {{after_everything, "feed=1", "feed=1"}};
    for (const auto& [at, action] : commands) texts.push_back({at, action, action});
    CommandedRun out;
    auto schedule = CommandSchedule::create(rack, texts);
    if (!schedule) {
        ADD_FAILURE() << schedule.error().text();
        return out;
    }
    JobSettings settings;
    settings.program = program;
    settings.program_name = "test";
    settings.commands = schedule->get();
    Job job(rack, settings);
    rack.start();
    (*schedule)->begin();
    out.outcome = job.run();
    out.json = without_events(summary_json(config, out.outcome));
    out.end = rack.kernel().now();
    out.not_done = (*schedule)->not_done().size();
    return out;
}

/// Compares runs whose commands change nothing with a run without them.
void expect_unchanged(const RackConfig& config, const std::string& program, std::uint64_t seed) {
    const CommandedRun plain = run_with(config, program, {});
    ASSERT_TRUE(plain.outcome.ended) << plain.outcome.ended.error().text();
    std::mt19937_64 random(seed);
    const auto within = [&] {
        return Instant{static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(plain.outcome.time.count()))};
    };
    const Instant after = plain.end + whole_seconds(1);
    const std::array<TimedCommands, 5> unchanging = {{{{within(), "feed=1"}},
                                                      {{within(), "rapid=1"}},
                                                      {{within(), "resume"}},
                                                      {{after, "hold"}, {after + whole_seconds(1), "resume"}},
                                                      {{after, "stop"}}}};
    for (const TimedCommands& commands : unchanging) {
        SCOPED_TRACE(commands.front().second + " at " + std::to_string(to_seconds(commands.front().first)) + " s");
        const CommandedRun commanded = run_with(config, program, commands);
        EXPECT_EQ(commanded.outcome.trace_hash, plain.outcome.trace_hash);
        EXPECT_EQ(commanded.outcome.time, plain.outcome.time);
        EXPECT_EQ(commanded.json, plain.json);
        const std::size_t after_end = commands.front().first > plain.end ? commands.size() : 0;
        EXPECT_EQ(commanded.not_done, plain.not_done + after_end);
    }
}

class OrdersThatChangeNothing : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(With, OrdersThatChangeNothing, testing::Values("trapezoid", "jerk_limited"),
                         [](const auto& each) { return std::string(each.param); });

TEST_P(OrdersThatChangeNothing, LeaveEveryEventAndResultOfARandomProgramAsTheyAre) {
    const std::uint64_t first = seed_from_environment(), everyday = thorough() ? 20 : 4,
                        count = cases("MOTIONRACK_PROGRAMS", everyday);
    constexpr std::array sizes = {test::ProgramSize::mixed, test::ProgramSize::small, test::ProgramSize::tiny,
                                  test::ProgramSize::big};
    const RackConfig config = router(GetParam());
    std::uint64_t driven = 0;
    for (std::uint64_t made = 0; driven < count && made < 20 * count; ++made) {
        const std::uint64_t seed = first + made;
        const test::RandomProgram program = test::ProgramMaker(seed, sizes[driven % sizes.size()]).make();
        if (!control::gcode::check_program(program.text, reader_settings(config), 1).problems.empty()) continue;
        SCOPED_TRACE("MOTIONRACK_SEED=" + std::to_string(seed) + "\n" + program.text);
        expect_unchanged(config, program.text, seed);
        ++driven;
        if (testing::Test::HasFailure()) break;
    }
    EXPECT_EQ(driven, count);
}

}  // namespace
}  // namespace motionrack::rack
