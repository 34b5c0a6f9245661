// Programs of the catalogue by their text: each is refused before anything moves, or executed to its end, by a run and
// by a served machine alike.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <motionrack/operate/machine.hpp>
#include <nlohmann/json.hpp>
#include <tests/fault/cases.hpp>
#include <tests/ran.hpp>

namespace motionrack::faults {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class GivenProgram : public InFolder, public testing::WithParamInterface<Case> {
  protected:
    GivenProgram() : config_(*rack::read_rack_text(GetParam().fault.setup.rack).config) {}
    static const Fault& fault() { return GetParam().fault; }
    static std::string program() { return GetParam().text(fault().setup.program); }
    static void expect_words(const std::string& said) {
        for (const std::string& words : fault().says) EXPECT_THAT(said, HasSubstr(GetParam().text(words)));
    }
    /// Position of each axis at the end, in pulses from the start; 0 where the catalogue does not name it.
    std::map<char, std::int64_t> pulses_at_end() const {
        std::map<char, std::int64_t> out;
        for (const rack::RackAxis& axis : config_.axes) {
            out[axis.letter] = 0;
            const std::string name = std::string(1, axis.letter) + " = ";
            for (const std::string& shows : fault().shows)
                if (shows.rfind(name, 0) == 0)
                    out[axis.letter] = std::llround(std::stod(shows.substr(name.size())) * axis.pulses_per_unit());
        }
        return out;
    }

    const rack::RackConfig config_;
};

TEST_P(GivenProgram, IsRefusedOrExecutedByARun) {
    write("rack.toml", fault().setup.rack);
    write("part.ngc", program());
    const Ran ran = shell("{ " MOTIONRACK_PROGRAM " run part.ngc -q --json --rack rack.toml > summary.json; }");
    EXPECT_EQ(ran.code, fault().exit) << ran.out;
    expect_words(ran.out);
    EXPECT_EQ(std::filesystem::exists(folder / "report.html"), fault().exit == 0);
    const json summary = json::parse(text_of(folder / "summary.json"), nullptr, false);
    std::map<char, std::int64_t> pulses;
    for (const auto& [letter, none] : pulses_at_end()) pulses[letter] = 0;
    if (summary.is_object())
        for (const json& axis : summary["axes"])
            pulses[axis["axis"].get<std::string>()[0]] = axis["pulse_position"].get<std::int64_t>();
    EXPECT_EQ(pulses, pulses_at_end());
}

TEST_P(GivenProgram, IsRefusedOrExecutedByAServedMachine) {
    std::unique_ptr<operate::Machine> machine;
    std::string refusal;
    bool given = false, over = false;
    Instant moved{};
    operate::MachineSettings settings;
    settings.pace = [&](Instant now) {
        if (!machine || now < milliseconds(50)) return true;
        if (!std::exchange(given, true)) {
            moved = now;
            const Result<void> begun = machine->begin_program(program(), "part.ngc");
            if (!begun) refusal = begun.error().text();
        }
        if (!operate::is_stationary(machine->state())) moved = now;
        if (now > moved + milliseconds(500) && !std::exchange(over, true)) machine->quit();
        return true;
    };
    auto made = operate::Machine::make(config_, std::move(settings));
    ASSERT_TRUE(made) << made.error().text();
    machine = std::move(*made);
    EXPECT_TRUE(machine->enable(true));
    machine->run();
    expect_words(refusal);
    EXPECT_EQ(refusal.empty(), fault().exit == 0) << refusal;
    EXPECT_EQ(machine->state(), operate::MachineState::standstill);
    EXPECT_TRUE(machine->status().alarms.empty());
    std::map<char, std::int64_t> pulses;
    for (const operate::AxisStatus& axis : machine->status().axes) pulses[axis.letter] = axis.pulses;
    EXPECT_EQ(pulses, pulses_at_end());
}

std::vector<Case> given_programs() {
    std::vector<Case> out;
    for (Case& one : all_cases())
        if (one.fault.setup.by == "program") out.push_back(std::move(one));
    return out;
}

INSTANTIATE_TEST_SUITE_P(Catalogue, GivenProgram, testing::ValuesIn(given_programs()),
                         [](const auto& each) { return each.param.name(); });

}  // namespace
}  // namespace motionrack::faults
