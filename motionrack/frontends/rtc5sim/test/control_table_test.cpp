// The card's table of control commands matches rtc5sim.h: the same names, parameters and ranges.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <motionrack/cards/rtc5/model/control_commands.hpp>
#include <motionrack/frontends/rtc5sim/test/session.hpp>
#include <regex>
#include <sstream>
#include <tests/source_root.hpp>

namespace motionrack::rtc5sim_test {
namespace {

using rtc5::ControlCommand;
using rtc5::ControlParam;
using rtc5::Engine;

struct Declared {
    bool answers = false;                 ///< not void
    std::vector<std::string> parameters;  ///< by value
    std::size_t places = 0;               ///< number of pointers to results
};

std::map<std::string, Declared> declared_commands() {
    std::ifstream file(source_dir() + "/motionrack/frontends/rtc5sim/rtc5sim.h");
    std::map<std::string, Declared> out;
    const std::regex function(R"(^RTC5_API (\w+) (\w+)\((.*)\);)"), parameter(R"((\w+)([* ]+)(\w+)$)");
    std::smatch match;
    for (std::string line; std::getline(file, line);) {
        if (!std::regex_search(line, match, function)) continue;
        Declared& one = out[match[2]];
        one.answers = match[1] != "void";
        std::istringstream all(match[3]);
        for (std::string each; std::getline(all, each, ',');) {
            std::smatch part;
            if (!std::regex_search(each, part, parameter)) continue;
            if (part[2].str().find('*') != std::string::npos)
                ++one.places;
            else
                one.parameters.push_back(part[3]);
        }
    }
    return out;
}

std::vector<double> min_of(const ControlCommand& command) {
    std::vector<double> out;
    for (const ControlParam& param : command.params()) out.push_back(param.min);
    return out;
}

TEST(Rtc5ControlTable, HasTheNamesAndParametersOfTheHeader) {
    const auto declared = declared_commands();
    ASSERT_EQ(declared.size(), 166u);
    for (const ControlCommand& command : rtc5::control_commands()) {
        SCOPED_TRACE(command.name);
        const auto found = declared.find(std::string(command.name));
        ASSERT_NE(found, declared.end());
        std::vector<std::string> names;
        for (const ControlParam& param : command.params()) names.emplace_back(param.name);
        EXPECT_EQ(names, found->second.parameters);
        EXPECT_EQ(command.answers, found->second.places + (found->second.answers ? 1 : 0));
        EXPECT_EQ(rtc5::find_control_command(command.name), &command) << "twice";
        EXPECT_FALSE(command.meaning.empty());
        EXPECT_FALSE(command.source.empty());
    }
    EXPECT_EQ(rtc5::find_control_command("jump_abs"), nullptr) << "a list command";
}

TEST(Rtc5ControlTable, TheCardAcceptsBothEndsOfEachRangeAndNothingBeyond) {
    for (const ControlCommand& command : rtc5::control_commands()) {
        SCOPED_TRACE(command.name);
        const std::vector<double> min_values = min_of(command);
        for (std::size_t i = 0; i < min_values.size(); ++i) {
            const ControlParam& param = command.params()[i];
            SCOPED_TRACE(param.name);
            for (const double end : {param.min, param.max}) {
                std::vector<double> given = min_values;
                given[i] = end;
                if (command.name == "set_mcbsp_out") given = {7, end == 0 ? 0.0 : 45.0};
                EXPECT_TRUE(command.check(given));
                Engine card;
                const auto done = command.run(card, given);
                EXPECT_TRUE(done || command.refusal == rtc5::Refusal::rejected) << done.error().message;
            }
            for (const double beyond :
                 {param.min - 1, param.max + 1, std::nan(""), std::numeric_limits<double>::infinity()}) {
                std::vector<double> given = min_values;
                given[i] = beyond;
                const auto checked = command.check(given);
                ASSERT_FALSE(checked) << beyond;
                EXPECT_THAT(checked.error().message,
                            testing::StartsWith(std::string(command.name) + ": " + std::string(param.name) + " is "));
            }
            std::vector<double> fraction = min_values;
            fraction[i] += 0.5;
            EXPECT_EQ(command.check(fraction).has_value(), !param.whole);
        }
        std::vector<double> more = min_values;
        more.push_back(0);
        EXPECT_FALSE(command.check(more));
    }
}

TEST(Rtc5ControlTable, EachCommandReturnsTheDeclaredNumberOfValues) {
    for (const ControlCommand& command : rtc5::control_commands()) {
        SCOPED_TRACE(command.name);
        Engine card;
        ASSERT_TRUE(card.parts().fly.set_mcbsp_in(3, 0));
        card.parts().mcbsp.receive(0x00010002);
        card.run_until(1);
        const auto answer = command.run(card, min_of(command));
        ASSERT_TRUE(answer) << answer.error().message;
        EXPECT_EQ(answer->size(), command.answers);
    }
}

}  // namespace
}  // namespace motionrack::rtc5sim_test
