// Reading coverage.toml, and its page.
#include <fmt/format.h>

#include <motionrack/rack/toml_reader.hpp>
#include <tests/fault/coverage.hpp>
#include <tests/text_of.hpp>

namespace motionrack::faults {

namespace {

Result<CoveredFault> covered_fault(const rack::TomlNode& node) {
    CoveredFault out;
    const auto take_texts = [](const rack::TomlNode& entry, std::vector<std::string>& texts) {
        for (const rack::TomlNode& child : entry.children) texts.push_back(child.text);
    };
    for (const rack::TomlNode& entry : node.children) {
        if (entry.key == "id")
            out.id = entry.text;
        else if (entry.key == "about")
            out.about = entry.text;
        else if (entry.key == "rows")
            take_texts(entry, out.rows);
        else if (entry.key == "tests")
            take_texts(entry, out.tests);
        else if (entry.key == "reason")
            out.reason = entry.text;
        else if (entry.key == "missing")
            out.missing = entry.text;
        else
            return fail(Trouble::bad_input, fmt::format("A fault has no key {}.", rack::in_quotes(entry.key)),
                        entry.key_place);
    }
    if (out.id.empty() || out.about.empty())
        return fail(Trouble::bad_input, "A fault needs id and about.", node.key_place);
    if (out.rows.empty() && out.tests.empty() && out.reason.empty() && out.missing.empty())
        return fail(Trouble::bad_input,
                    fmt::format("{} has neither rows nor tests, nor a reason, nor what is missing.", out.id),
                    node.key_place);
    return out;
}

std::string tried_by(const CoveredFault& fault) {
    std::string out;
    const auto add = [&out](const std::string& text) { out += (out.empty() ? "" : "<br>") + text; };
    for (const std::string& row : fault.rows) add("[" + row + "](faults.md)");
    for (const std::string& test : fault.tests) add("`" + test + "`");
    if (!fault.reason.empty()) add(fault.reason);
    if (!fault.missing.empty()) add("**missing**: " + fault.missing);
    return out;
}

}  // namespace

Result<std::vector<CoverageSection>> read_coverage(const std::filesystem::path& file) {
    const std::string text = text_of(file);
    if (text.empty()) return fail(Trouble::io, fmt::format("{} cannot be read.", file.string()));
    MOTIONRACK_TRY(const rack::TomlNode all, rack::parse_toml(text, file.string()));
    const rack::TomlNode* sections = all.find("section");
    if (sections == nullptr) return fail(Trouble::bad_input, fmt::format("{} has no [[section]].", file.string()));
    std::vector<CoverageSection> out;
    for (const rack::TomlNode& node : sections->children) {
        CoverageSection& section = out.emplace_back();
        if (const rack::TomlNode* name = node.find("name")) section.name = name->text;
        const rack::TomlNode* faults = node.find("fault");
        for (std::size_t i = 0; faults != nullptr && i < faults->children.size(); ++i) {
            MOTIONRACK_TRY(CoveredFault one, covered_fault(faults->children[i]));
            section.faults.push_back(std::move(one));
        }
    }
    return out;
}

std::string coverage_page(const std::vector<CoverageSection>& sections) {
    std::size_t all = 0, tried = 0, missing = 0;
    std::string tables;
    for (const CoverageSection& section : sections) {
        tables += fmt::format("\n## {}\n| | fault | tried by |\n|---|---|---|\n", section.name);
        for (const CoveredFault& fault : section.faults) {
            ++all;
            if (!fault.missing.empty())
                ++missing;
            else if (!fault.rows.empty() || !fault.tests.empty())
                ++tried;
            tables += fmt::format("| {} | {} | {} |\n", fault.id, fault.about, tried_by(fault));
        }
    }
    return fmt::format(
               "# What can go wrong, and what tries it\n\n<!-- written by `fault_page coverage`, from "
               "tests/fault/coverage.toml -->\n\n{} faults of machines, cards, programs, networks and people. {} are "
               "tried by a row of [the catalogue of faults](faults.md), which has what stops, how soon and with which "
               "words, or by the test that is named; {} cannot happen here, for the reason that stands beside them; {} "
               "are missing.\n",
               all, tried, all - tried - missing, missing) +
           tables;
}

}  // namespace motionrack::faults
