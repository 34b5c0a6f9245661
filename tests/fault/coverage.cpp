// Reads coverage.toml and writes its page.
#include <fmt/format.h>

#include <motionrack/rack/toml_reader.hpp>
#include <tests/fault/coverage.hpp>
#include <tests/text_of.hpp>
#include <utility>

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
            return fail(ErrorKind::invalid_input, fmt::format("A fault has no key {}.", rack::in_quotes(entry.key)),
                        entry.key_place);
    }
    if (out.id.empty() || out.about.empty())
        return fail(ErrorKind::invalid_input, "A fault needs id and about.", node.key_place);
    if (out.rows.empty() && out.tests.empty() && out.reason.empty() && out.missing.empty())
        return fail(ErrorKind::invalid_input,
                    fmt::format("{} has neither rows nor tests, nor a reason, nor a missing test.", out.id),
                    node.key_place);
    return out;
}

const Fault* find_row(const std::vector<Group>& catalogue, const std::string& row) {
    for (const Group& group : catalogue)
        for (const Fault& fault : group.faults)
            if (group.name + ": " + fault.name == row) return &fault;
    return nullptr;
}

std::string names_of(const std::vector<Point>& points) {
    std::string out;
    for (const Point& point : points) out += (out.empty() ? "" : ", ") + point.name;
    return out;
}

/// Returns table cells, line for line: the tests of a fault, and its operating points alone and in a served machine.
std::string tried_by(const CoveredFault& fault, const std::vector<Group>& catalogue) {
    std::string what, alone, served;
    bool first = true;
    const auto add = [&](const std::string& a, const std::string& b = "", const std::string& c = "") {
        const char* const line = std::exchange(first, false) ? "" : "<br>";
        what += line + a, alone += line + b, served += line + c;
    };
    for (const std::string& row : fault.rows) {
        const Fault* found = find_row(catalogue, row);
        const std::string points = found == nullptr ? "?" : names_of(found->setup.points);
        add("[" + row + "](faults.md)", points, found != nullptr && found->is_served() ? points : "-");
    }
    for (const std::string& test : fault.tests) add("`" + test + "`");
    if (!fault.reason.empty()) add(fault.reason);
    if (!fault.missing.empty()) add("**missing**: " + fault.missing);
    return what + " | " + alone + " | " + served;
}

}  // namespace

Result<std::vector<CoverageSection>> read_coverage(const std::filesystem::path& file) {
    const std::string text = text_of(file);
    if (text.empty()) return fail(ErrorKind::io, fmt::format("{} cannot be read.", file.string()));
    MOTIONRACK_TRY(const rack::TomlNode all, rack::parse_toml(text, file.string()));
    const rack::TomlNode* sections = all.find("section");
    if (sections == nullptr)
        return fail(ErrorKind::invalid_input, fmt::format("{} has no [[section]].", file.string()));
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

std::string coverage_page(const std::vector<CoverageSection>& sections, const std::vector<Group>& catalogue) {
    std::size_t all = 0, tried = 0, missing = 0;
    std::string tables;
    for (const CoverageSection& section : sections) {
        tables +=
            fmt::format("\n## {}\n| | fault | tried by | at | served at |\n|---|---|---|---|---|\n", section.name);
        for (const CoveredFault& fault : section.faults) {
            ++all;
            if (!fault.missing.empty())
                ++missing;
            else if (!fault.rows.empty() || !fault.tests.empty())
                ++tried;
            tables += fmt::format("| {} | {} | {} |\n", fault.id, fault.about, tried_by(fault, catalogue));
        }
    }
    return fmt::format(
               "# Coverage of faults\n\n<!-- written by `fault_page coverage`, from "
               "tests/fault/coverage.toml -->\n\n{} faults of machines, cards, programs, networks and people. {} are "
               "tried by a row of [the catalogue of faults](faults.md), which has what stops, how soon and with which "
               "words, or by the test that is named; {} cannot happen here, for the reason that stands beside them; "
               "missing: {}.\n\nA row is passed at two operating points. Where they stand under \"served at\", too, a "
               "machine that people operate is broken in the same way at both: it raises one alarm with the words of "
               "the run, and its positions are valid exactly as in the run. The other rows are of files, of the "
               "process "
               "and of the network, or of parts that no program drives.\n",
               all, tried, all - tried - missing, missing) +
           tables;
}

}  // namespace motionrack::faults
