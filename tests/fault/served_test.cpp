// The faults of a program that is run, in a machine that people operate: its positions are trusted after them as the
// catalogue says, and where they are not an alarm says so.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <motionrack/operate/machine.hpp>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/timed_text.hpp>
#include <motionrack/sim/parts/conditions.hpp>
#include <tests/fault/cases.hpp>
#include <tests/source_root.hpp>

namespace motionrack::faults {
namespace {

using operate::Machine;
using testing::HasSubstr;

rack::RackConfig served_config(const std::string& text) {
    auto reading = text.find('\n') == std::string::npos ? rack::read_rack_file((source_root / text).string())
                                                        : rack::read_rack_text(text);
    if (!reading.config) throw std::runtime_error("a rack of the catalogue cannot be read");
    return *reading.config;
}

/// Breaks what the catalogue breaks, at its times after the program's begin.
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
        std::erase_if(todo, [&](const rack::TimedText& one) {
            if (one.at > machine.now() - since) return false;
            const std::string action(one.action), name = action.substr(0, action.find('='));
            const std::size_t dot = name.find('.');
            const Result<void> done =
                machine.wires().knows(name)
                    ? machine.wires().set(name, std::stod(action.substr(action.find('=') + 1)))
                    : rack::inject_fault(machine.rack(), action.substr(dot + 1), action.substr(0, dot));
            EXPECT_TRUE(done) << done.error().message;
            return true;
        });
    }
    std::vector<rack::TimedText> todo;
};

/// A machine that drives a case's program from 0.2 s on, until it has stood for half a second.
class Served {
  public:
    explicit Served(const Case& one) : breaking_(one), program_(one.text(one.fault.setup.program)) {
        operate::MachineSettings settings;
        settings.pace = [this](Instant now) {
            if (machine) pace(now);
            return true;
        };
        auto made = Machine::make(served_config(one.text(one.fault.setup.rack)), std::move(settings));
        if (!made) throw std::runtime_error(made.error().text());
        machine = std::move(*made);
        EXPECT_TRUE(machine->enable(true));
    }
    std::unique_ptr<Machine> machine;

  private:
    void pace(Instant now) {
        if (now >= milliseconds(100) && !std::exchange(declared_, true))
            for (const rack::RackAxis& axis : machine->rack().config().axes)
                if (!machine->trusted(axis)) {
                    EXPECT_TRUE(machine->declare_position(axis.letter, axis.start_position));
                }
        if (now < milliseconds(200)) return;
        if (begun_ == never) {
            begun_ = moved_ = now;
            const Result<void> begun = machine->begin_program(program_, "part.ngc");
            EXPECT_TRUE(begun) << begun.error().text();
        }
        breaking_.apply(*machine, begun_);
        if (!operate::idle(machine->state())) moved_ = now;
        if (now > moved_ + milliseconds(500) && breaking_.todo.empty()) machine->quit();
    }
    Breaking breaking_;
    std::string program_;
    bool declared_ = false;
    Instant begun_ = never, moved_{};
};

/// The fault comes at another place of the path than in a run, where a stop may cost steps.
bool lost_steps(rack::Rack& rack) {
    const std::vector<sim::Condition> all = rack.kernel().conditions();
    return std::any_of(all.begin(), all.end(), [](const sim::Condition& one) {
        return one.code == static_cast<std::uint16_t>(parts::AxisCondition::lost_steps);
    });
}

class AServedFault : public testing::TestWithParam<Case> {};

TEST_P(AServedFault, TakesTheTrustThatItTakesInARun) {
    const Fault& fault = GetParam().fault;
    Served served(GetParam());
    served.machine->run();
    const operate::Status& status = served.machine->status();
    const bool trusted =
        std::all_of(status.axes.begin(), status.axes.end(), [](const auto& axis) { return axis.trusted; });
    std::string alarms;
    for (const operate::Alarm& alarm : status.alarms) alarms += alarm.text + "\n";
    EXPECT_EQ(trusted, *fault.trusted && !lost_steps(served.machine->rack())) << alarms;
    if (!trusted) {
        EXPECT_THAT(alarms, HasSubstr("trusted"));
    }
    for (const std::string& words : fault.says)
        if (words.rfind("encoder of", 0) == 0 || words.rfind("The following error", 0) == 0) {
            EXPECT_THAT(alarms, HasSubstr(words));
        }
}

/// Not the program itself.
bool breaks_parts(const Fault& fault) {
    return std::all_of(fault.inject.begin(), fault.inject.end(),
                       [](const std::string& option) { return option.rfind("--fault ", 0) == 0; });
}

std::vector<Case> cases_of_runs() {
    std::vector<Case> out;
    for (Case& one : all_cases())
        if (one.fault.setup.by == "run" && one.fault.trusted && breaks_parts(one.fault)) out.push_back(std::move(one));
    return out;
}

INSTANTIATE_TEST_SUITE_P(Catalogue, AServedFault, testing::ValuesIn(cases_of_runs()),
                         [](const auto& each) { return each.param.name(); });

}  // namespace
}  // namespace motionrack::faults
