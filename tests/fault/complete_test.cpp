// The catalogue contains every fault that can be injected, each fault has its tests, and the page is current.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <motionrack/rack/catalogue.hpp>
#include <motionrack/rack/config.hpp>
#include <motionrack/rack/faults.hpp>
#include <set>
#include <tests/fault/cases.hpp>
#include <tests/source_root.hpp>
#include <tests/text_of.hpp>

namespace motionrack::faults {
namespace {

TEST(FaultCatalogue, IsThePageOfTheReference) {
    EXPECT_EQ(text_of(source_root / "docs/reference/faults.md"), catalogue_page(catalogue()))
        << "make it anew: fault_page > docs/reference/faults.md";
}

/// Returns the kind of a rack element with faults: "stepping axis", "servo axis", "stage", "belt or table", "lamp", or
/// the card type.
std::string kind_of(rack::Rack& rack, const std::string& target) {
    for (const rack::RunningAxis& axis : rack.axes())
        if (target == std::string(1, axis.config.letter)) return axis.servo ? "servo axis" : "stepping axis";
    if (rack.stage(target) != nullptr) return "stage";
    if (rack.track(target) != nullptr) return "belt or table";
    for (const rack::RackLamp& lamp : rack.config().lamps)
        if (lamp.name == target) return "lamp";
    for (const rack::RackCard& card : rack.config().cards)
        if (card.name == target) return card.type;
    return "?";
}

/// Racks that the faults of the catalogue run on.
std::set<std::string> racks() {
    std::set<std::string> out;
    for (const Case& one : all_cases())
        if (!one.fault.setup.rack.empty()) out.insert(one.text(one.fault.setup.rack));
    return out;
}

std::optional<rack::RackConfig> config_of(const std::string& text) {
    auto reading = text.find('\n') == std::string::npos ? rack::read_rack_file((source_root / text).string())
                                                        : rack::read_rack_text(text);
    EXPECT_TRUE(reading.config) << text;
    return reading.config;
}

TEST(FaultCatalogue, HasEveryFaultOfEveryPartAndCard) {
    std::set<std::pair<std::string, std::string>> can_break, broken;
    std::set<std::string> card_types;
    for (const std::string& text : racks()) {
        const auto config = config_of(text);
        if (!config) continue;
        rack::Rack rack(*config);
        for (const rack::RackCard& card : config->cards) card_types.insert(card.type);
        for (const rack::FaultTarget& target : rack::fault_targets(rack)) {
            const std::string kind = kind_of(rack, target.name);
            for (const std::string_view fault : target.faults) {
                can_break.insert({kind, std::string(fault)});
                for (const Case& one : all_cases()) {
                    if (one.text(one.fault.setup.rack) != text) continue;
                    for (const std::string& option : one.fault.inject) {
                        const std::string injected = one.text(option), name = target.name + "." + std::string(fault);
                        const std::size_t at = injected.rfind(' ') == std::string::npos ? 0 : injected.rfind(' ') + 1;
                        const std::size_t end = injected.find_first_of("=@", at);
                        if (injected.substr(at, end - at) == name) broken.insert({kind, std::string(fault)});
                    }
                }
            }
        }
    }
    for (const std::string_view type : rack::card_type_names())
        EXPECT_TRUE(card_types.count(std::string(type))) << "no fault is run on a rack with a card of type " << type;
    for (const auto& [kind, fault] : can_break)
        EXPECT_TRUE(broken.count({kind, fault})) << "the catalogue has no " << fault << " of a " << kind;
    std::set<std::string> names;
    for (const auto& [kind, fault] : can_break) names.insert(fault);
    for (const std::string_view fault : rack::fault_names())
        EXPECT_TRUE(names.count(std::string(fault))) << "no axis of the catalogue's racks can have " << fault;
}

/// Returns the names of all tests with this ctest label.
std::string tests_labelled(const std::string& label) {
    std::string out;
    std::FILE* pipe = ::popen(
        ("'" + source_dir() + "/tests/programs' '" MOTIONRACK_BUILD_DIR "' list " + label + " 2>&1").c_str(), "r");
    if (pipe == nullptr) return out;
    std::array<char, 4096> buffer{};
    for (std::size_t got; (got = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
        out.append(buffer.data(), got);
    ::pclose(pipe);
    return out;
}

TEST(FaultCatalogue, HasATestForEveryRow) {
    const std::string tests = "\n" + tests_labelled("fault");
    std::set<std::string> names;
    for (const Case& one : all_cases()) {
        EXPECT_TRUE(names.insert(one.name()).second) << one.name() << " is there twice";
        const bool elsewhere = one.fault.setup.by == "test";
        EXPECT_EQ(elsewhere, !one.point.test.empty()) << one.name() << " names a test, or is run here";
        const bool given = one.fault.setup.by == "program";
        const std::string own = given ? "Catalogue/GivenProgram.IsRefusedOrExecutedByARun/"
                                      : "Catalogue/InjectedFault.DoesWhatTheCatalogueStates/";
        const std::string test = elsewhere ? one.point.test : own + one.name();
        EXPECT_NE(tests.find("\n" + test + "\n"), std::string::npos)
            << "ctest -L fault runs no " << test << ", which is to run " << one.name();
    }
}

/// Returns the source file of the test, which contains its name and its words.
std::string source_of(const std::string& test) {
    const std::size_t dot = test.rfind('.'), slash = test.find('/'), end = test.find('/', dot);
    const std::string suite = slash < dot ? test.substr(slash + 1, dot - slash - 1) : test.substr(0, dot),
                      name = test.substr(dot + 1, end == std::string::npos ? end : end - dot - 1);
    for (const char* folder : {"tests", "motionrack"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(source_root / folder))
            if (entry.path().extension() == ".cpp") {
                std::string text = text_of(entry.path());
                if (text.find("(" + suite + ", " + name + ")") != std::string::npos) return text;
            }
    return {};
}

TEST(FaultCatalogue, HasTheWordsThatTestsOfOtherModulesExpect) {
    for (const Case& one : all_cases()) {
        if (one.fault.setup.by != "test") continue;
        const std::string source = source_of(one.point.test);
        ASSERT_FALSE(source.empty()) << one.point.test << " is in no file";
        for (const std::string& words : one.fault.says)
            EXPECT_NE(source.find(words), std::string::npos) << one.point.test << " does not look for: " << words;
    }
}

}  // namespace
}  // namespace motionrack::faults
