// A stop of the machine also stops every sender in any state: none of its later lines is executed.
#include <algorithm>
#include <random>
#include <tests/environment.hpp>

#include "bench.hpp"

namespace motionrack::grbl {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// A careless sender: keeps this number of bytes pending and continues after any answer.
class Careless {
  public:
    Careless(Bench& bench, std::function<std::string(int)> line) : bench_(bench), line_(std::move(line)) {}
    /// Sends these bytes and returns the output within `seconds`.
    std::string push(const std::string& bytes, double seconds) {
        sent += static_cast<int>(std::count(bytes.begin(), bytes.end(), '\n'));
        std::string heard = bench_.ask(bytes, seconds);
        for (int n = answers(heard); n > 0; --n, ++answered) {
            if (sizes_.empty()) continue;
            under_way_ -= sizes_.front();
            sizes_.pop_front();
        }
        return heard;
    }
    /// Streams for this time; returns the output.
    std::string stream(double seconds) {
        std::string out;
        for (double left = seconds; left > 0; left -= 0.01) {
            std::string bytes;
            for (std::string next = line_(lines_); under_way_ + next.size() <= 120; next = line_(lines_)) {
                under_way_ += next.size();
                sizes_.push_back(next.size());
                bytes += next;
                ++lines_;
            }
            out += push(bytes, 0.01);
        }
        return out;
    }
    int sent = 0, answered = 0;

  private:
    Bench& bench_;
    std::function<std::string(int)> line_;
    std::deque<std::size_t> sizes_;
    std::size_t under_way_ = 0;
    int lines_ = 0;
};

struct Source {
    const char* name;
    const char* reported;  ///< message to the sender
    void (*stop)(operate::Machine& machine);
};
const std::array<Source, 5> sources = {{
    {"a page's STOP", "STOP by anna (?192.168.1.5?)",
     [](auto& m) {
         m.stop({"anna", "[192.168.1.5]", "STOP"});
     }},
    {"a STOP by HTTP, of nobody", "STOP (127.0.0.1)",
     [](auto& m) {
         m.stop({"", "127.0.0.1", "STOP"});
     }},
    {"a page's reset", "Reset by anna",
     [](auto& m) {
         m.reset({"anna", "", "Reset"});
     }},
    {"another sender's reset", "^X by a sender",
     [](auto& m) {
         m.reset({"a sender", "127.0.0.1:4", "^X"});
     }},
    {"disabling", "Disabling: ", [](auto& m) { ASSERT_TRUE(m.enable(false)); }},
}};

std::string zigzag(int i) {
    return "G1X" + std::to_string(i % 7) + "." + std::to_string(i % 10) + "Y" + std::to_string(i % 5) + "F3000\n";
}

rack::RackConfig no_switches() {
    return three_axes();
}
rack::RackConfig far_probe() {
    return with_probe("x_min_mm = 290\n");
}
void nothing_more(operate::Machine&) {}

/// Activity of the sender, or of the machine beside it, at the stop; `before` is sent first.
struct Doing {
    const char* name;
    std::string before;
    std::function<std::string(int)> line;
    bool homes = false;
    rack::RackConfig (*config)() = no_switches;
    void (*begin)(operate::Machine& machine) = nothing_more;
};
const std::array<Doing, 12> doings = {{
    {"streams lines", "", zigzag},
    {"streams one long line", "", [](int i) { return i % 2 == 0 ? "G1X200F1500\n" : std::string("G1X0\n"); }},
    {"brakes into a feed hold", "G1X200F6000\n", [](int i) { return i == 0 ? "!G1X0\n" : zigzag(i); }},
    {"is held", "G1X200F3000\n", [](int i) { return i == 3 ? "!G1X0\n" : zigzag(i); }},
    {"is held where it stands", "!", zigzag},
    {"dwells", "G1X1F3000\nG4P3\n", zigzag},
    {"waits at M0", "G1X1F3000\nM0\n", zigzag},
    {"jogs", "", [](int i) { return "$J=G91X" + std::string(i % 3 == 2 ? "-2" : "3") + "F1500\n"; }},
    {"probes", "G38.2X280F1200\n", zigzag, false, far_probe},
    {"executes single blocks", "", zigzag, false, no_switches,
     [](operate::Machine& m) { m.programs().set_single_block(true); }},
    {"sends lines beside a page's program", "", zigzag, false, no_switches,
     [](operate::Machine& m) {
         ASSERT_TRUE(m.enable(true));
         ASSERT_TRUE(m.begin_program("G21 G90 F1200\nG1 X200\nG1 X0\nM2\n", "page.ngc"));
     }},
    {"homes", "$H\n", zigzag, true, router},
}};
constexpr std::size_t doings_without_homing = doings.size() - 1;

/// Returns the number of tested instants for each source of a stop in each state.
std::uint64_t stop_instants() {
    return trials("MOTIONRACK_STOPS", 3, 100);
}
double some_instant(std::mt19937& random) {
    return 0.05 + static_cast<double>(random() % 1000) / 2500;
}

/// Expects that a line of the sender moves the machine after the stop's reset.
void expect_to_move(Bench& b) {
    b.machine->programs().set_single_block(false);
    const std::int64_t stood = b.machine->status().axes[0].pulses;
    EXPECT_EQ(b.ask("G91 G1 X0.5 F600\n", 0.02), "ok\r\n");
    b.until_idle();
    EXPECT_NE(b.machine->status().axes[0].pulses, stood);
}

class SenderStop : public testing::TestWithParam<std::tuple<std::size_t, std::size_t>> {
  protected:
    void try_once(double after, const Source& source, const Doing& doing) {
        Bench b(doing.config());
        Careless sender(b, doing.line);
        sender.push(doing.before, 0.1);
        doing.begin(*b.machine);
        sender.stream(after);
        source.stop(*b.machine);
        const std::string heard = sender.stream(0.7);
        const std::string alarm = doing.homes ? "ALARM:" : "ALARM:3\r\n[MSG:";
        ASSERT_THAT(heard, AllOf(HasSubstr(alarm), HasSubstr(source.reported)));
        ASSERT_TRUE(operate::idle(b.machine->state())) << operate::name_of(b.machine->state());
        const std::vector<operate::AxisStatus> stood = b.machine->status().axes;
        const std::string later = sender.stream(1) + sender.push("~G1X2F600\n", 0.2);
        EXPECT_THAT(later, Not(HasSubstr("ok\r\n")));
        EXPECT_THAT(later, AnyOf(HasSubstr("error:9\r\n"), HasSubstr("error:8\r\n")));
        // An aborted homing discards the waiting lines.
        if (!doing.homes) {
            EXPECT_EQ(sender.answered, sender.sent);
        }
        for (std::size_t i = 0; i < stood.size(); ++i)
            EXPECT_EQ(b.machine->status().axes[i].pulses, stood[i].pulses) << "a line was driven after the stop";
        EXPECT_THAT(b.report(), StartsWith("<Alarm|"));
        EXPECT_THAT(b.ask("$X\n", 0.2), EndsWith("[MSG:Caution: Unlocked]\r\nok\r\n"));
        if (doing.homes) return;
        expect_to_move(b);
    }
};

/// MOTIONRACK_STOPS=N sets the number of tested instants.
TEST_P(SenderStop, DiscardsAllPendingLinesOfTheSender) {
    const auto [which, what] = GetParam();
    const std::uint64_t seed = seed_from_environment();
    std::mt19937 random(static_cast<std::uint32_t>(seed * 1000 + which * 100 + what));
    for (std::uint64_t i = 0; i < stop_instants(); ++i) {
        const double after = some_instant(random);
        SCOPED_TRACE(sources[which].name + std::string(" while it ") + doings[what].name + ", " +
                     std::to_string(after) + " s; MOTIONRACK_SEED=" + std::to_string(seed));
        try_once(after, sources[which], doings[what]);
        if (HasFailure()) return;
    }
}
INSTANTIATE_TEST_SUITE_P(By, SenderStop,
                         testing::Combine(testing::Range(std::size_t{0}, sources.size()),
                                          testing::Range(std::size_t{0}, doings.size())));

/// A pressed emergency stop: no line is answered, and $X does nothing, before the sender's own reset.
class SenderAtTheButton : public testing::TestWithParam<std::size_t> {
  protected:
    static void try_once(double after, const Doing& doing) {
        Bench b(doing.config());
        Careless sender(b, doing.line);
        sender.push(doing.before, 0.1);
        doing.begin(*b.machine);
        sender.stream(after);
        ASSERT_TRUE(b.machine->wires().force("estop", 0));
        ASSERT_THAT(sender.stream(0.7), AllOf(HasSubstr("ALARM:"), HasSubstr("[MSG:Reset to continue]\r\n")));
        ASSERT_EQ(b.machine->state(), operate::MachineState::error_stop) << operate::name_of(b.machine->state());
        const std::vector<operate::AxisStatus> stood = b.machine->status().axes;
        ASSERT_TRUE(b.machine->wires().force("estop", 1));
        const std::string later = sender.stream(0.5) + sender.push("$X\n~G1X2F600\n", 0.5);
        EXPECT_THAT(later, Not(HasSubstr("ok\r\n")));
        for (std::size_t i = 0; i < stood.size(); ++i)
            EXPECT_EQ(b.machine->status().axes[i].pulses, stood[i].pulses) << "a line was driven after the stop";
        EXPECT_THAT(b.ask("\x18", 0.2), EndsWith("[MSG:'$H'|'$X' to unlock]\r\n"));
        EXPECT_THAT(b.ask("$X\n", 0.2), EndsWith("[MSG:Caution: Unlocked]\r\nok\r\n"));
        for (std::size_t i = 0; i < stood.size(); ++i)
            EXPECT_EQ(b.machine->status().axes[i].pulses, stood[i].pulses) << "a reset moves nothing";
        expect_to_move(b);
    }
};

/// MOTIONRACK_STOPS=N sets the number of tested instants.
TEST_P(SenderAtTheButton, HasNoLineExecutedBeforeItsOwnReset) {
    const std::uint64_t seed = seed_from_environment();
    std::mt19937 random(static_cast<std::uint32_t>(seed * 1000 + 900 + GetParam()));
    for (std::uint64_t i = 0; i < stop_instants(); ++i) {
        const double after = some_instant(random);
        SCOPED_TRACE(std::string("the button while it ") + doings[GetParam()].name + ", " + std::to_string(after) +
                     " s; MOTIONRACK_SEED=" + std::to_string(seed));
        try_once(after, doings[GetParam()]);
        if (HasFailure()) return;
    }
}
INSTANTIATE_TEST_SUITE_P(By, SenderAtTheButton, testing::Range(std::size_t{0}, doings_without_homing));

/// Parameter: the bytes that the sender sends in the slice of the stop.
class StoppedHoming : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(AndThen, StoppedHoming, testing::Values("", "!", "$C\n"));

TEST_P(StoppedHoming, StaysStoppedUntilAReset) {
    Bench b(router());
    b.ask("$H\n", 0.3);
    ASSERT_EQ(b.machine->state(), operate::MachineState::homing);
    b.machine->stop({"anna", "", "STOP"});
    EXPECT_THAT(b.ask(GetParam(), 2), HasSubstr("ALARM:"));
    EXPECT_EQ(b.machine->state(), operate::MachineState::error_stop) << name_of(b.machine->state());
    b.ask("$C\n", 0.1);
    EXPECT_TRUE(b.machine->rack().stop_latch().latched());
    EXPECT_THAT(b.report(), HasSubstr("Alarm"));
    b.ask("\x18", 0.5);
    EXPECT_EQ(b.machine->state(), operate::MachineState::standstill);
}

}  // namespace
}  // namespace motionrack::grbl
