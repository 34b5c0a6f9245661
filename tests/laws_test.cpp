// The laws of the code base: allowed includes, file sizes, and constructs that deterministic modules must not use.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <tests/source_root.hpp>
#include <tests/text_of.hpp>
#include <vector>

namespace {

namespace fs = std::filesystem;
using motionrack::source_root;
std::vector<fs::path> sources(const fs::path& folder) {
    std::vector<fs::path> out;
    for (const auto& entry : fs::recursive_directory_iterator(source_root / folder))
        if (entry.path().extension() == ".hpp" || entry.path().extension() == ".cpp") out.push_back(entry.path());
    return out;
}

/// Returns the handwritten sources of the operator panel's page.
std::vector<fs::path> page_sources() {
    static const std::set<std::string> written = {".ts", ".tsx", ".mjs", ".css", ".html"};
    std::vector<fs::path> out;
    for (const char* folder : {"hmi/src", "hmi/test"})
        for (const auto& entry : fs::recursive_directory_iterator(source_root / folder))
            if (written.count(entry.path().extension())) out.push_back(entry.path());
    return out;
}

std::vector<std::string> lines_of(const fs::path& path) {
    std::ifstream file(path);
    std::vector<std::string> out;
    for (std::string line; std::getline(file, line);) out.push_back(line);
    return out;
}

/// Returns the module of a file: "cards/mcx314/chip/chip.hpp" -> "mcx314/chip"; the map and arithmetic of a card are in
/// "mcx314/map".
std::string module_of(const std::string& path) {
    if (path.find("/test/") != std::string::npos) return "test";
    if (path.rfind("cards/", 0) == 0) {
        const std::size_t card = path.find('/', 6);
        const std::string name = path.substr(6, card - 6), rest = path.substr(card + 1);
        for (const char* part : {"chip", "model", "driver", "axes", "processor", "library"})
            if (rest.rfind(std::string(part) + "/", 0) == 0) return name + "/" + part;
        return name + "/map";
    }
    if (path.rfind("sim/parts/", 0) == 0) return "parts";
    if (path.rfind("frontends/calls/", 0) == 0) return "calls";
    if (path.rfind("frontends/mcx314lib/windows/", 0) == 0) return "mcx314lib/windows";
    if (path.rfind("frontends/mcx314lib/", 0) == 0) return "mcx314lib";
    if (path.rfind("frontends/databoard4002lib/", 0) == 0) return "databoard4002lib";
    if (path.rfind("frontends/rtc5sim/", 0) == 0) return "rtc5sim";
    if (path.rfind("frontends/c/flex2pos", 0) == 0) return "flex2pos";
    return path.substr(0, path.find('/'));
}

const std::map<std::string, std::set<std::string>> may_include = {
    {"base", {}},
    {"disk", {"base"}},
    {"live", {"base"}},
    {"sim", {"base"}},
    {"parts", {"base", "sim"}},
    {"control", {"base"}},
    {"decode", {"base"}},
    {"trace", {"base", "disk"}},
    {"mcx314/map", {"base"}},
    {"mcx314/chip", {"base", "sim", "mcx314/map"}},
    {"mcx314/driver", {"base", "mcx314/map"}},
    {"mcx314/axes", {"base", "control", "mcx314/map", "mcx314/driver"}},
    {"mcx314/library", {"base", "mcx314/driver"}},
    {"databoard4002/map", {"base"}},
    {"databoard4002/model", {"base", "sim", "databoard4002/map"}},
    {"databoard4002/driver", {"base", "databoard4002/map"}},
    {"databoard4002/library", {"base", "databoard4002/driver"}},
    {"ioflex02/map", {"base"}},
    {"ioflex02/model", {"base", "sim", "ioflex02/map"}},
    {"ioflex02/driver", {"base", "ioflex02/map"}},
    {"grating_bus/map", {"base"}},
    {"grating_bus/model", {"base", "sim", "grating_bus/map"}},
    {"grating_bus/driver", {"base", "grating_bus/map"}},
    {"grating_bus/processor", {"base", "grating_bus/map"}},
    {"dds", {"base", "grating_bus/map"}},
    {"rtc5/map", {"base"}},
    {"rtc5/model", {"base", "sim", "rtc5/map"}},
    {"databoard4002/axes", {"base", "control", "databoard4002/driver"}},
    {"rack",
     {"base",
      "sim",
      "parts",
      "control",
      "trace",
      "mcx314/map",
      "mcx314/chip",
      "mcx314/driver",
      "mcx314/axes",
      "mcx314/library",
      "databoard4002/map",
      "databoard4002/model",
      "databoard4002/driver",
      "databoard4002/library",
      "databoard4002/axes",
      "ioflex02/map",
      "ioflex02/model",
      "grating_bus/map",
      "grating_bus/model",
      "grating_bus/processor",
      "rtc5/map",
      "rtc5/model"}},
    {"mark", {"base", "sim", "parts", "control", "trace", "rack", "rtc5/map", "rtc5/model"}},
    {"sweep", {"base", "control", "trace", "rack", "auth"}},
    {"nats", {"base", "sweep"}},
    {"journal", {"base"}},
    {"operate", {"base", "control", "rack", "live", "journal"}},
    {"auth", {"base", "disk"}},
    {"panel", {"base", "control", "rack", "operate", "auth", "journal", "mark"}},
    {"grbl", {"control", "rack", "operate"}},
    {"calls", {"base"}},
    {"frontends",
     {"base", "disk", "calls",   "journal", "operate", "auth", "panel", "grbl", "mark",         "sweep",
      "nats", "live", "control", "decode",  "trace",   "rack", "dds",   "c.h",  "ioflex02/map", "grating_bus/driver"}},
    {"flex2pos", {"rack", "frontends", "flex2pos.h", "ioflex02/driver"}},
    {"mcx314lib", {"base", "calls", "rack", "live", "mcx314/map", "mcx314/driver"}},
    {"mcx314lib/windows", {"base", "sim", "mcx314lib", "mcx314/map", "mcx314/chip"}},
    {"databoard4002lib", {"calls", "rack", "live", "databoard4002/library"}},
    {"rtc5sim", {"calls", "rack", "live", "rtc5/model"}},
    {"python",
     {"base", "sim", "trace", "rack", "operate", "live", "mcx314/driver", "mcx314/library", "databoard4002/map",
      "databoard4002/driver", "databoard4002/library", "ioflex02/driver", "grating_bus/driver", "rtc5/model"}},
};

/// An include from one module to another.
struct Arrow {
    fs::path file;
    std::string own, header, other;
};

/// Returns the includes of all sources; each source also has one from its module to itself.
std::vector<Arrow> arrows() {
    static const std::regex include(R"(#include <motionrack/([^>]+)>)");
    std::vector<Arrow> out;
    for (const char* folder : {"motionrack", "python/src"})
        for (const fs::path& path : sources(folder)) {
            const std::string own = folder == std::string("python/src")
                                        ? "python"
                                        : module_of(fs::relative(path, source_root / folder).generic_string());
            if (own == "test") continue;
            out.push_back({path, own, "", own});
            for (const std::string& line : lines_of(path)) {
                std::smatch match;
                if (std::regex_search(line, match, include)) out.push_back({path, own, match[1], module_of(match[1])});
            }
        }
    return out;
}

TEST(Laws, ModulesIncludeOnlyTheirAllowedModules) {
    for (const Arrow& one : arrows()) {
        ASSERT_TRUE(may_include.count(one.own)) << one.file << " is in an unknown module";
        EXPECT_TRUE(one.other == one.own || may_include.at(one.own).count(one.other))
            << one.file << " includes " << one.header;
    }
}

TEST(Laws, EveryAllowedIncludeIsUsed) {
    std::map<std::string, std::set<std::string>> used;
    for (const Arrow& one : arrows()) used[one.own].insert(one.other);
    for (const auto& [own, others] : may_include) {
        EXPECT_TRUE(used.count(own)) << "no source is in the module " << own << "; remove its row from may_include";
        for (const std::string& other : others)
            EXPECT_TRUE(used[own].count(other))
                << own << " includes nothing of " << other << "; remove it from its row";
    }
}

TEST(Laws, FilesAreSmall) {
    for (const char* folder : {"motionrack", "python", "tests", "bench", "examples"})
        for (const fs::path& path : sources(folder)) EXPECT_LE(lines_of(path).size(), 400u) << path;
    for (const fs::path& path : page_sources()) EXPECT_LE(lines_of(path).size(), 400u) << path;
}

TEST(Laws, DeterministicModulesUseNoWallClockRandOrLibm) {
    const std::regex forbidden(R"(steady_clock|system_clock|sleep_for|usleep|std::rand\b|fast-math|march=native|)"
                               R"(std::sin\(|std::cos\(|std::atan2|std::pow\(|std::exp\()");
    for (const char* folder : {"motionrack/base", "motionrack/sim", "motionrack/cards", "motionrack/control"})
        for (const fs::path& path : sources(folder)) {
            if (path.string().find("/test/") != std::string::npos) continue;
            for (const std::string& line : lines_of(path))
                EXPECT_FALSE(std::regex_search(line, forbidden)) << path << ": " << line;
        }
}

TEST(Laws, SourcesHaveNoOpenTodos) {
    const std::regex later(std::string("TO") + "DO|FIX" + "ME");
    for (const char* folder : {"motionrack", "python", "tests", "bench", "examples"})
        for (const fs::path& path : sources(folder))
            for (const std::string& line : lines_of(path))
                EXPECT_FALSE(std::regex_search(line, later)) << path << ": " << line;
    for (const fs::path& path : page_sources())
        for (const std::string& line : lines_of(path))
            EXPECT_FALSE(std::regex_search(line, later)) << path << ": " << line;
}

TEST(Laws, JourneysNameExistingFunctions) {
    std::string all;
    for (const fs::path& path : sources("motionrack"))
        for (const std::string& line : lines_of(path)) all += line + "\n";
    const std::regex name(R"(`([A-Za-z_]+(::[A-Za-z_]+)*)`)");
    int names = 0;
    for (const std::string& line : lines_of(source_root / "docs/explanations/journeys.md"))
        for (auto it = std::sregex_iterator(line.begin(), line.end(), name); it != std::sregex_iterator(); ++it) {
            const std::string full = (*it)[1];
            const std::string last = full.substr(full.rfind(':') == std::string::npos ? 0 : full.rfind(':') + 1);
            EXPECT_NE(all.find(last), std::string::npos)
                << "journeys.md names " << full << ", which is not in the code";
            if (full.find("::") != std::string::npos) {
                const std::string before = full.substr(0, full.rfind("::"));
                EXPECT_NE(all.find(before.substr(before.rfind(':') == std::string::npos ? 0 : before.rfind(':') + 1)),
                          std::string::npos)
                    << full;
            }
            ++names;
        }
    EXPECT_GT(names, 15);
}

TEST(Laws, EveryPageOfTheDocumentationIsLinked) {
    std::string index;
    for (const std::string& line : lines_of(source_root / "docs/README.md")) index += line + "\n";
    for (const auto& entry : fs::recursive_directory_iterator(source_root / "docs")) {
        if (entry.path().extension() != ".md") continue;
        const std::string relative = fs::relative(entry.path(), source_root / "docs").generic_string();
        EXPECT_TRUE(relative == "README.md" || index.find("(" + relative + ")") != std::string::npos)
            << relative << " is not linked from docs/README.md";
    }
}

}  // namespace
