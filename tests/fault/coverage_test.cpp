// Every fault in coverage.toml has an existing test, and the page is current.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tests/fault/cases.hpp>
#include <tests/fault/coverage.hpp>
#include <tests/source_root.hpp>
#include <tests/text_of.hpp>

namespace motionrack::faults {
namespace {

const std::vector<CoverageSection>& coverage() {
    static const std::vector<CoverageSection> sections = [] {
        auto read = read_coverage(source_root / "tests/fault/coverage.toml");
        if (!read) throw std::runtime_error(read.error().text());
        return *read;
    }();
    return sections;
}

/// Returns all files in a folder tree with one of these extensions, concatenated.
std::string texts_below(const std::filesystem::path& folder, const std::set<std::string>& endings) {
    std::string out;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(source_root / folder))
        if (endings.count(entry.path().extension().string()) != 0) out += text_of(entry.path());
    return out;
}

TEST(FaultCoverage, IsThePageOfTheReference) {
    EXPECT_EQ(text_of(source_root / "docs/reference/fault-coverage.md"), coverage_page(coverage(), catalogue()))
        << "make it anew: fault_page coverage > docs/reference/fault-coverage.md";
}

TEST(FaultCoverage, HasEachFaultOnce) {
    std::set<std::string> ids;
    for (const CoverageSection& section : coverage())
        for (const CoveredFault& fault : section.faults) EXPECT_TRUE(ids.insert(fault.id).second) << fault.id;
    EXPECT_EQ(ids.size(), 147u);
}

TEST(FaultCoverage, NamesRowsOfTheCatalogue) {
    std::set<std::string> rows;
    for (const Group& group : catalogue())
        for (const Fault& fault : group.faults) rows.insert(group.name + ": " + fault.name);
    for (const CoverageSection& section : coverage())
        for (const CoveredFault& fault : section.faults)
            for (const std::string& row : fault.rows) EXPECT_TRUE(rows.count(row)) << fault.id << ": " << row;
}

TEST(FaultCoverage, TriesEachFaultAtTwoPointsAloneAndServedOrStatesWhyNot) {
    for (const CoverageSection& section : coverage())
        for (const CoveredFault& fault : section.faults) {
            const std::string run = fault.reason + fault.not_tried.run + section.not_tried.run;
            const std::string serve = fault.reason + fault.not_tried.serve + section.not_tried.serve;
            EXPECT_TRUE(points_of(fault, catalogue(), Tried::alone).size() >= 2 || !run.empty())
                << fault.id << " is tried at fewer than two points by a run, and does not say why";
            EXPECT_TRUE(points_of(fault, catalogue(), Tried::served).size() >= 2 || !serve.empty())
                << fault.id << " is tried at fewer than two points in a served machine, and does not say why";
        }
}

TEST(FaultCoverage, GivesReasonsAsSentences) {
    const auto expect_sentence = [](const std::string& who, const std::string& reason) {
        EXPECT_THAT(reason, testing::MatchesRegex("([A-Z].{28,}[.])?")) << who;
    };
    for (const CoverageSection& section : coverage()) {
        expect_sentence(section.name, section.not_tried.run);
        expect_sentence(section.name, section.not_tried.serve);
        for (const CoveredFault& fault : section.faults) {
            expect_sentence(fault.id, fault.reason);
            expect_sentence(fault.id, fault.not_tried.run);
            expect_sentence(fault.id, fault.not_tried.serve);
        }
    }
}

/// Replaces every run of white space by one blank.
std::string on_one_line(const std::string& text) {
    std::string out;
    for (const char c : text) {
        const bool blank = c == ' ' || c == '\n';
        if (!blank)
            out += c;
        else if (out.empty() || out.back() != ' ')
            out += ' ';
    }
    return out;
}

TEST(FaultCoverage, NamesExistingTests) {
    const std::string programs = on_one_line(texts_below("tests", {".cpp"}) + texts_below("motionrack", {".cpp"})),
                      pages = texts_below("hmi/test", {".mjs", ".ts", ".tsx"});
    const std::string of_page = "hmi: ";
    for (const CoverageSection& section : coverage())
        for (const CoveredFault& fault : section.faults)
            for (const std::string& test : fault.tests) {  // those of its points, too
                const bool page = test.rfind(of_page, 0) == 0;
                const std::size_t dot = test.find('.');
                const std::string words =
                    page ? test.substr(of_page.size()) : "(" + test.substr(0, dot) + ", " + test.substr(dot + 1);
                const std::string& texts = page ? pages : programs;
                const std::size_t at = texts.find(words);
                const bool whole = at != std::string::npos &&
                                   (page || texts.find_first_of("),", at + words.size()) == at + words.size());
                EXPECT_TRUE(whole) << fault.id << " names " << test << ", which is in no file";
            }
}

}  // namespace
}  // namespace motionrack::faults
