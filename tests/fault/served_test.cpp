// Faults of a program run, of homing and of stages in a served machine. It ends in the state given by the catalogue,
// with one alarm in the words of a run. Positions are valid as after the run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <motionrack/operate/machine.hpp>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/scheduled_text.hpp>
#include <motionrack/sim/parts/conditions.hpp>
#include <tests/fault/cases.hpp>
#include <tests/source_root.hpp>
#include <tests/text_of.hpp>

namespace motionrack::faults {
namespace {

using operate::Machine;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

rack::RackConfig served_config(const std::string& text) {
    auto reading = text.find('\n') == std::string::npos ? rack::read_rack_file((source_root / text).string())
                                                        : rack::read_rack_text(text);
    if (!reading.config) throw std::runtime_error("a rack of the catalogue cannot be read");
    return *reading.config;
}

/// Injects the faults of the catalogue at their times after the program start.
struct Breaking {
    explicit Breaking(const Case& one) {
        for (const std::string& option : one.fault.inject) {
            const std::string text = one.text(option);
            const auto timed = rack::read_timed_text(text.substr(text.rfind(' ') + 1));
            if (!timed) throw std::runtime_error(text + " has no time");
            todo.push_back(*timed);
        }
    }
    void apply(Machine& machine, Instant since) {
        std::erase_if(todo, [&](const rack::ScheduledText& one) {
            if (one.at > machine.now() - since) return false;
            const std::string action(one.action), name = action.substr(0, action.find('='));
            const std::size_t dot = name.find('.');
            const Result<void> done =
                machine.wires().knows(name)
                    ? machine.wires().force(name, std::stod(action.substr(action.find('=') + 1)))
                    : rack::inject_fault(machine.rack(), action.substr(dot + 1), action.substr(0, dot));
            EXPECT_TRUE(done) << done.error().message;
            return true;
        });
    }
    std::vector<rack::ScheduledText> todo;
};

/// A machine with the rack of the case. It runs the program, or homes, from 0.2 s until it has been stationary for 0.5
/// s. With stage faults it remains stationary for the duration of the case.
class Served {
  public:
    explicit Served(const Case& one)
        : by_(one.fault.setup.by), breaking_(one), program_(one.text(one.fault.setup.program)) {
        operate::MachineSettings settings;
        settings.pace = [this](Instant now) {
            if (machine) pace(now);
            return true;
        };
        if (by_ == "frames") watch_for_ = from_seconds(std::stod(one.text("{for}")));
        auto made = Machine::make(served_config(rack_of(one)), std::move(settings));
        if (!made) throw std::runtime_error(made.error().text());
        machine = std::move(*made);
        EXPECT_TRUE(machine->enable(true));
    }
    std::unique_ptr<Machine> machine;
    operate::MachineState state{};  ///< at the end, before quitting

  private:
    void quit() {
        state = machine->state();
        machine->quit();
    }
    /// Adds an axis to a rack of stages only, because a served machine needs one.
    static std::string rack_of(const Case& one) {
        std::string text = one.text(one.fault.setup.rack);
        if (one.fault.setup.by != "frames") return text;
        if (text.find('\n') == std::string::npos) text = text_of(source_root / text);
        return "[card.axes]\ntype = \"mcx314\"\n[axis.X]\ncard = \"axes\"\nchannel = \"x\"\n" + text;
    }
    void pace(Instant now) {
        if (by_ == "frames") {
            breaking_.apply(*machine, Instant{});
            if (now > Instant{} + watch_for_ && !std::exchange(over_, true)) quit();
            return;
        }
        if (now >= milliseconds(100) && !std::exchange(declared_, true))
            for (const rack::RackAxis& axis : machine->rack().config().axes)
                if (!machine->position_valid(axis)) {
                    EXPECT_TRUE(machine->manual().set_position(axis.letter, axis.initial_position));
                }
        if (now < milliseconds(200)) return;
        if (begun_ == never) {
            begun_ = moved_ = now;
            const Result<void> begun =
                by_ == "home" ? machine->manual().home("X") : machine->begin_program(program_, "part.ngc");
            EXPECT_TRUE(begun) << begun.error().text();
        }
        breaking_.apply(*machine, begun_);
        if (!operate::is_stationary(machine->state())) moved_ = now;
        if (now > moved_ + milliseconds(500) && breaking_.todo.empty() && !std::exchange(over_, true)) quit();
    }
    std::string by_;
    Breaking breaking_;
    std::string program_;
    Duration watch_for_{};
    bool declared_ = false, over_ = false;
    Instant begun_ = never, moved_{};
};

/// The fault occurs at another point of the path than in a run; a stop there may lose steps.
bool lost_steps(rack::Rack& rack) {
    const std::vector<sim::Condition> all = rack.kernel().conditions();
    return std::any_of(all.begin(), all.end(), [](const sim::Condition& one) {
        return one.code == static_cast<std::uint16_t>(parts::AxisCondition::lost_steps);
    });
}

class ServedFault : public testing::TestWithParam<Case> {};

TEST_P(ServedFault, EndsAsItDoesInARun) {
    const Fault& fault = GetParam().fault;
    Served served(GetParam());
    served.machine->run();
    const operate::Status& status = served.machine->status();
    std::vector<std::string> alarms;
    for (const operate::Alarm& alarm : status.alarms) alarms.push_back(alarm.text);
    EXPECT_EQ(name_of(served.state), fault.state_when_served()) << status.reason;
    const bool lost = lost_steps(served.machine->rack());
    std::vector<testing::Matcher<std::string>> expected;
    for (const std::string& words : fault.alarms_when_served()) expected.push_back(HasSubstr(GetParam().text(words)));
    if (lost && fault.positions_valid && *fault.positions_valid)
        expected.front() = testing::AllOf(expected.front(), HasSubstr("not valid any more: steps may have been lost"));
    if (fault.setup.by == "frames") {
        EXPECT_THAT(alarms, testing::AllOf(Not(testing::IsEmpty()), testing::Each(expected.front())))
            << "one of each stage";
    } else {
        EXPECT_THAT(alarms, testing::ElementsAreArray(expected)) << "one cause, one alarm";
    }
    if (!fault.positions_valid || fault.setup.by == "frames") return;
    const bool valid =
        std::all_of(status.axes.begin(), status.axes.end(), [](const auto& axis) { return axis.position_valid; });
    EXPECT_EQ(valid, *fault.positions_valid && !lost);
    if (!valid) {
        EXPECT_THAT(alarms, Contains(HasSubstr("not valid")));
    }
}

std::vector<Case> served_cases() {
    std::vector<Case> out;
    for (Case& one : all_cases())
        if (one.fault.is_served()) out.push_back(std::move(one));
    return out;
}

INSTANTIATE_TEST_SUITE_P(Catalogue, ServedFault, testing::ValuesIn(served_cases()),
                         [](const auto& each) { return each.param.name(); });

}  // namespace
}  // namespace motionrack::faults
