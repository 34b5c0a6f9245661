// The documentation is correct: generated pages are current, links have targets, code shown is code that runs.
#include <gtest/gtest.h>

#include <filesystem>
#include <motionrack/control/gcode/words.hpp>
#include <motionrack/mark/marking_job.hpp>
#include <motionrack/rack/config.hpp>
#include <motionrack/rack/job.hpp>
#include <motionrack/rack/stop_reactions.hpp>
#include <motionrack/rack/template.hpp>
#include <motionrack/sweep/sweep_file.hpp>
#include <regex>
#include <sstream>
#include <string>
#include <tests/fenced_blocks.hpp>
#include <tests/source_root.hpp>
#include <tests/text_of.hpp>
#include <vector>

namespace motionrack {
namespace {

namespace fs = std::filesystem;
std::string trimmed(const std::string& line) {
    const std::size_t begin = line.find_first_not_of(' '), end = line.find_last_not_of(" \r");
    return begin == std::string::npos ? "" : line.substr(begin, end - begin + 1);
}

std::vector<std::string> lines_in(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> out;
    for (std::string line; std::getline(in, line);) out.push_back(line);
    return out;
}

std::vector<fs::path> pages() {
    std::vector<fs::path> out = {source_root / "README.md", source_root / "CHANGELOG.md"};
    for (const char* folder : {"docs", "examples", "motionrack"})
        for (const auto& entry : fs::recursive_directory_iterator(source_root / folder))
            if (entry.path().extension() == ".md") out.push_back(entry.path());
    return out;
}

/// Returns the anchor of a heading: lower case, hyphens for blanks, without other punctuation.
std::string anchor_of(const std::string& heading) {
    std::string out;
    for (const char c : heading.substr(heading.find_first_not_of("# "))) {
        const auto letter = static_cast<unsigned char>(c);
        if (std::isalnum(letter) || c == '-' || c == '_')
            out += static_cast<char>(std::tolower(letter));
        else if (c == ' ')
            out += '-';
    }
    return out;
}

bool has_heading(const fs::path& page, const std::string& anchor) {
    for (const std::string& line : lines_in(text_of(page)))
        if (!line.empty() && line[0] == '#' && anchor_of(line) == anchor) return true;
    return false;
}

TEST(Docs, TheRackFilePageIsCurrent) {
    EXPECT_EQ(text_of(source_root / "docs/reference/rack-file.md"), rack::rack_file_reference())
        << "make it anew: motionrack describe rack-file > docs/reference/rack-file.md";
}

TEST(Docs, TheMarkingJobPageIsCurrent) {
    EXPECT_EQ(text_of(source_root / "docs/reference/marking-job.md"), mark::job_file_reference())
        << "make it anew: motionrack describe marking-job > docs/reference/marking-job.md";
}

TEST(Docs, TheSafetyPageIsCurrent) {
    EXPECT_EQ(text_of(source_root / "docs/explanations/safety.md"), rack::safety_reference())
        << "make it anew: motionrack describe safety > docs/explanations/safety.md";
}

TEST(Docs, TheSweepFilePageIsCurrent) {
    EXPECT_EQ(text_of(source_root / "docs/reference/sweep-file.md"), sweep::sweep_file_reference())
        << "make it anew: motionrack describe sweep-file > docs/reference/sweep-file.md";
}

TEST(Docs, TheGcodePageIsCurrent) {
    EXPECT_EQ(text_of(source_root / "docs/reference/gcode.md"), control::gcode::gcode_reference())
        << "make it anew: motionrack describe gcode > docs/reference/gcode.md";
}

TEST(Docs, LinksHaveTargets) {
    const std::regex link(R"(\]\(([^)#]*)(#([^)]*))?\))");
    int links = 0;
    for (const fs::path& page : pages()) {
        const std::string text = text_of(page);
        for (auto it = std::sregex_iterator(text.begin(), text.end(), link); it != std::sregex_iterator(); ++it) {
            const std::string target = (*it)[1], anchor = (*it)[3];
            if (target.rfind("http", 0) == 0) continue;
            const fs::path file = target.empty() ? page : page.parent_path() / target;
            EXPECT_TRUE(fs::exists(file)) << page << " links to " << target;
            EXPECT_TRUE(anchor.empty() || has_heading(file, anchor))
                << page << " links to #" << anchor << " in " << file;
            ++links;
        }
    }
    EXPECT_GT(links, 30);
}

TEST(Docs, TheCppOfTheReadmeIsTheLibraryExample) {
    const std::string example = text_of(source_root / "examples/06_library/main.cpp");
    const auto shown = code_in_page(text_of(source_root / "README.md"), "cpp");
    ASSERT_EQ(shown.size(), 1u);
    for (const std::string& line : lines_in(shown[0]))
        EXPECT_NE(example.find("\n    " + trimmed(line) + "\n"), std::string::npos) << line;
}

TEST(Docs, GcodeOfThePagesRuns) {
    const rack::RackConfig config = *rack::read_rack_text(*rack::rack_template("router")).config;
    int programs = 0;
    for (const fs::path& page : pages())
        for (const std::string& program : code_in_page(text_of(page), "gcode")) {
            rack::Rack rack(config);
            rack::JobSettings settings;
            settings.program = program;
            rack::Job job(rack, settings);
            rack.start();
            const rack::JobOutcome outcome = job.run();
            EXPECT_TRUE(outcome.ended) << page << ": " << outcome.ended.error().text();
            EXPECT_TRUE(outcome.run.ended) << page << ": a program shown ends with M2";
            ++programs;
        }
    EXPECT_GE(programs, 2);
}

TEST(Docs, EveryExampleFolderIsInTheIndexAndComplete) {
    const std::string index = text_of(source_root / "examples/README.md");
    int folders = 0;
    for (const auto& entry : fs::directory_iterator(source_root / "examples")) {
        const std::string name = entry.path().filename().string();
        if (!entry.is_directory() || name[0] != '0') continue;
        EXPECT_NE(index.find("(" + name + "/README.md)"), std::string::npos) << name;
        EXPECT_TRUE(fs::exists(entry.path() / "README.md")) << name;
        const bool built = fs::exists(entry.path() / "main.cpp") || fs::exists(entry.path() / "main.c");
        for (const char* file : {"command", "expected.txt", "exit_code"})
            EXPECT_TRUE(built || fs::exists(entry.path() / file)) << name << " " << file;
        ++folders;
    }
    EXPECT_GE(folders, 6);
}

}  // namespace
}  // namespace motionrack
