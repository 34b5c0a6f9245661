// Pages of docs/reference are generated from the C headers, and motionrack/c.h names all entries of the tables.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/quantities.hpp>
#include <motionrack/rack/toml_reader.hpp>
#include <sstream>
#include <string>
#include <tests/source_root.hpp>
#include <tests/text_of.hpp>
#include <vector>

namespace motionrack {
namespace {

namespace fs = std::filesystem;
std::string contents(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Converts a header to Markdown: sections become headings, each declaration a block of code with its comment below.
class Page {
  public:
    /// `title`: first lines; `api`: the macro before each function.
    Page(const std::string& header, std::string title, std::string api)
        : title_(std::move(title)), api_(std::move(api)) {
        std::istringstream in(header);
        for (std::string line; std::getline(in, line);) take(line);
        end_declaration();
    }
    std::string text() const { return text_; }

  private:
    void take(const std::string& line) {
        if (!inside_ && line.rfind("/* ---- ", 0) == 0) {
            end_declaration();
            text_ += "## " + line.substr(8, line.rfind(" ----") - 8) + "\n\n";
        } else if (!inside_ && line.rfind("/* ", 0) == 0) {
            end_declaration();
            comment_.clear();
            inside_ = true;
            add_comment(line.substr(3));
        } else if (inside_) {
            add_comment(line.substr(std::min<std::size_t>(line.size(), line == " */" ? 1 : 3)));
        } else if (line.empty() || line[0] == '#' || line.rfind("extern", 0) == 0 ||
                   (line == "}" && declaration_.empty())) {
            end_declaration();
        } else {
            declaration_ += (line.rfind(api_, 0) == 0 ? line.substr(api_.size()) : line) + "\n";
        }
    }

    void add_comment(std::string line) {
        const std::size_t end = line.rfind("*/");
        inside_ = end == std::string::npos;
        if (!inside_) line.resize(end);
        while (!line.empty() && line.back() == ' ') line.pop_back();
        if (!line.empty() || inside_) comment_.push_back(line);
        if (!inside_ && text_.empty()) {
            text_ = title_;
            end_declaration();
        }
    }

    /// Writes the declaration, then the comment before it.
    void end_declaration() {
        if (declaration_.empty() && comment_.empty()) return;
        if (!declaration_.empty()) text_ += "```c\n" + declaration_ + "```\n";
        bool code = false;
        for (std::size_t i = 0; i < comment_.size(); ++i) {
            const std::string& line = comment_[i];
            const bool indented = line.rfind("  ", 0) == 0;
            if (indented != code) text_ += indented ? "```text\n" : "```\n";
            code = indented;
            text_ += (code ? line.substr(2) : line) + "\n";
        }
        if (code) text_ += "```\n";
        text_ += "\n";
        declaration_.clear();
        comment_.clear();
    }

    std::string title_, api_;
    std::string text_;
    std::string declaration_;
    std::vector<std::string> comment_;
    bool inside_ = false;
};

/// Expects a page of docs/reference to equal the page generated from its header.
void is_made_from(const std::string& page, const std::string& header, const std::string& title, const std::string& api,
                  const std::string& continued = "") {
    const std::string behind = continued.empty() ? "" : contents(source_root / continued);
    std::string text = Page(contents(source_root / header) + behind, title, api).text();
    while (text.size() > 1 && text[text.size() - 2] == '\n') text.pop_back();
    if (text == contents(source_root / "docs/reference" / page)) return;
    const fs::path made = fs::temp_directory_path() / ("motionrack_" + page);
    std::ofstream(made, std::ios::binary) << text;
    ADD_FAILURE() << "docs/reference/" << page << " is not what " << header << " says; take " << made;
}

TEST(CReference, ThePagesAreMadeFromTheHeaders) {
    is_made_from("c.md", "motionrack/c.h",
                 "# The C interface\n\n`motionrack/c.h`, as a page: this one is made from it.\n\n", "MR_API ");
    is_made_from(
        "flex2pos.md", "motionrack/flex2pos.h",
        "# The IOFLEX02's function library in C\n\n`motionrack/flex2pos.h`, as a page: this one is made from it.\n\n",
        "MR_API ");
    is_made_from("mcx314lib.md", "motionrack/frontends/mcx314lib/mcx314lib.h",
                 "# The MCX314's function library in C\n\n`mcx314lib.h`, as a page: this one is made from it.\n\n",
                 "MCX314_API ");
    is_made_from(
        "databoard4002lib.md", "motionrack/frontends/databoard4002lib/databoard4002lib.h",
        "# The DataBoard 4002's library in C\n\n`databoard4002lib.h`, as a page: this one is made from it.\n\n",
        "DATABOARD4002_API ");
    is_made_from("rtc5sim.md", "motionrack/frontends/rtc5sim/rtc5sim.h",
                 "# The RTC5's commands in C\n\n`rtc5sim.h`, as a page: this one is made from it.\n\n", "RTC5_API ",
                 "motionrack/frontends/rtc5sim/rtc5sim_virtual.h");
}

TEST(CReference, TheHeaderHasEveryQuantityAndFaultWithItsMeaning) {
    const std::string header = contents(source_root / "motionrack/c.h");
    const auto has = [&](std::string_view kind, std::size_t begin) {
        EXPECT_FALSE(rack::declared_quantities(kind).empty()) << kind;
        for (const auto& [name, doc] : rack::declared_quantities(kind)) {
            const std::size_t at = header.find(" *   " + rack::with_unit(name, "mm") + " ", begin);
            ASSERT_NE(at, std::string::npos) << name;
            EXPECT_NE(header.substr(at, header.find('\n', at) - at).find(doc), std::string::npos) << name;
        }
    };
    has("axis", 0);
    has("stage", header.find("Of a stage"));
    has("conveyor", header.find("Of a belt or a rotary table"));
    has("scanner", header.find("Of a scan head"));
    has("lamp", header.find("Of a signal lamp"));
    std::size_t at = header.find("Injects a fault, or repairs it");
    for (const std::string_view fault : rack::fault_names()) {
        at = header.find("\n *   " + std::string(fault), at);
        EXPECT_NE(at, std::string::npos) << fault;
    }
}

}  // namespace
}  // namespace motionrack
