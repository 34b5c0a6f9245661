// The laws of the code base: allowed includes, file sizes, and constructs that deterministic modules must not use.
#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
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
    {"mcx314/chip", {"base", "sim", "mcx314/map"}},
    {"mcx314/axes", {"base", "control", "mcx314/map", "mcx314/driver"}},
    {"mcx314/library", {"base", "mcx314/driver"}},
    {"databoard4002/library", {"base", "databoard4002/driver"}},
    {"grating_bus/processor", {"base", "grating_bus/map"}},
    {"dds", {"base", "grating_bus/map"}},
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
     {"base", "trace", "rack", "operate", "live", "mcx314/driver", "mcx314/library", "databoard4002/map",
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

/// Returns what the map, the model and the driver of each card may include; nothing for other modules.
std::optional<std::set<std::string>> allowed_for_cards(const std::string& own) {
    const std::size_t slash = own.find('/');
    if (slash == std::string::npos) return std::nullopt;
    const std::string map = own.substr(0, slash) + "/map", part = own.substr(slash + 1);
    if (part == "map") return std::set<std::string>{"base"};
    if (part == "model") return std::set<std::string>{"base", "sim", map};
    if (part == "driver") return std::set<std::string>{"base", map};
    return std::nullopt;
}

bool may_use(const std::string& own, const std::string& other) {
    const auto listed = may_include.find(own);
    const std::optional<std::set<std::string>> allowed =
        listed != may_include.end() ? std::optional(listed->second) : allowed_for_cards(own);
    if (allowed && allowed->count(other)) return true;
    // The plug-in of a card knows its map and its model.
    return own == "rack" && std::regex_match(other, std::regex("[a-z0-9_]+/(map|model)"));
}

TEST(Laws, ModulesIncludeOnlyTheirAllowedModules) {
    for (const Arrow& one : arrows()) {
        ASSERT_TRUE(may_include.count(one.own) || allowed_for_cards(one.own)) << one.file << " is in an unknown module";
        EXPECT_TRUE(one.other == one.own || may_use(one.own, one.other)) << one.file << " includes " << one.header;
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

bool in_word(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// Returns the position of `name` as a whole word from `from` on, with one of the characters `before` (empty: any)
/// before it and with `after` ('\0': any) behind it; npos if there is none.
std::size_t find_word(const std::string& text, const std::string& name, std::size_t from = 0,
                      const std::string& before = {}, char after = '\0') {
    for (std::size_t at = text.find(name, from); at != std::string::npos; at = text.find(name, at + 1)) {
        const char left = at == 0 ? '\n' : text[at - 1];
        const char right = at + name.size() < text.size() ? text[at + name.size()] : '\n';
        if (in_word(left) || in_word(right)) continue;
        if (!before.empty() && before.find(left) == std::string::npos) continue;
        if (after == '\0' || right == after) return at;
    }
    return std::string::npos;
}

/// Returns true if a class or struct of this name declares the function, or it is defined as a member of such a class.
/// A class ends, as clang-format writes it, at the first "};" with the indentation of its head.
bool has_member(const std::string& code, const std::string& name, const std::string& function) {
    if (find_word(code, name + "::" + function, 0, {}, '(') != std::string::npos) return true;
    for (const char* kind : {"class ", "struct "})
        for (std::size_t at = find_word(code, kind + name); at != std::string::npos;
             at = find_word(code, kind + name, at + 1)) {
            const std::size_t begin = code.find_first_of("{;", at);
            if (begin == std::string::npos || code[begin] == ';') continue;
            const std::size_t line = code.rfind('\n', at) + 1;
            const std::string indentation = code.substr(line, code.find_first_not_of(' ', line) - line);
            const std::size_t end = code.find("\n" + indentation + "};", begin);
            const std::string body = code.substr(begin, end - begin);
            if (find_word(body, function, 0, " *&", '(') != std::string::npos) return true;
        }
    return false;
}

TEST(Laws, JourneysNameExistingFunctions) {
    std::string all = "\n";
    for (const fs::path& path : sources("motionrack")) {
        if (path.generic_string().find("/test/") != std::string::npos) continue;
        for (const std::string& line : lines_of(path)) all += line + "\n";
    }
    const std::regex name(R"(`([A-Za-z_]+(::[A-Za-z_]+)*)`)");
    int names = 0;
    for (const std::string& line : lines_of(source_root / "docs/explanations/journeys.md"))
        for (auto it = std::sregex_iterator(line.begin(), line.end(), name); it != std::sregex_iterator(); ++it) {
            const std::string full = (*it)[1];
            const std::size_t colons = full.rfind("::");
            if (colons == std::string::npos) {
                EXPECT_NE(find_word(all, full), std::string::npos) << "journeys.md names " << full << ", which the code"
                                                                   << " does not have";
            } else {
                const std::string before = full.substr(0, colons);
                const std::size_t outer = before.rfind("::");
                EXPECT_TRUE(has_member(all, outer == std::string::npos ? before : before.substr(outer + 2),
                                       full.substr(colons + 2)))
                    << "journeys.md names " << full << ", which the code does not have";
            }
            ++names;
        }
    EXPECT_GT(names, 15);
}

TEST(Laws, AFunctionOfAnotherClassIsNoMember) {
    const std::string code = "\nclass One {\n  public:\n    void go();\n};\nstruct Two {\n    int stay();\n};\n";
    EXPECT_TRUE(has_member(code, "One", "go"));
    EXPECT_TRUE(has_member(code, "Two", "stay"));
    EXPECT_FALSE(has_member(code, "One", "stay")) << "both names are there, apart";
    EXPECT_FALSE(has_member(code, "Two", "go"));
    EXPECT_FALSE(has_member(code, "On", "go"));
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
