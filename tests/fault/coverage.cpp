// Reads coverage.toml and writes its page.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/rack/toml_reader.hpp>
#include <tests/fault/coverage.hpp>
#include <tests/text_of.hpp>
#include <utility>

namespace motionrack::faults {

namespace {

/// Reads "slow: Suite.Name".
TestedPoint tested_point(const std::string& text) {
    const std::size_t colon = text.find(": ");
    if (colon == std::string::npos) return {"", text};
    return {text.substr(0, colon), text.substr(colon + 2)};
}

bool take(Reasons& reasons, const rack::TomlNode& entry) {
    if (entry.key == "no_run")
        reasons.run = entry.text;
    else if (entry.key == "no_serve")
        reasons.serve = entry.text;
    else
        return false;
    return true;
}

Result<CoveredFault> covered_fault(const rack::TomlNode& node) {
    CoveredFault out;
    const auto take_texts = [](const rack::TomlNode& entry, std::vector<std::string>& texts) {
        for (const rack::TomlNode& child : entry.children) texts.push_back(child.text);
    };
    const auto take_points = [](const rack::TomlNode& entry, std::vector<TestedPoint>& points) {
        for (const rack::TomlNode& child : entry.children) points.push_back(tested_point(child.text));
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
        else if (entry.key == "run_at")
            take_points(entry, out.run_at);
        else if (entry.key == "served_at")
            take_points(entry, out.served_at);
        else if (entry.key == "reason")
            out.reason = entry.text;
        else if (entry.key == "missing")
            out.missing = entry.text;
        else if (!take(out.not_tried, entry))
            return fail(ErrorKind::invalid_input, fmt::format("A fault has no key {}.", rack::in_quotes(entry.key)),
                        entry.key_location);
    }
    if (out.id.empty() || out.about.empty())
        return fail(ErrorKind::invalid_input, "A fault needs id and about.", node.key_location);
    for (const std::vector<TestedPoint>* points : {&out.run_at, &out.served_at})
        for (const TestedPoint& point : *points)
            if (std::find(out.tests.begin(), out.tests.end(), point.test) == out.tests.end())
                out.tests.push_back(point.test);
    if (out.rows.empty() && out.tests.empty() && out.reason.empty() && out.missing.empty())
        return fail(ErrorKind::invalid_input,
                    fmt::format("{} has neither rows nor tests, nor a reason, nor a missing test.", out.id),
                    node.key_location);
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

/// Names of the points that this test tries.
std::string names_of(const std::vector<TestedPoint>& points, const std::string& test) {
    std::string out;
    for (const TestedPoint& point : points)
        if (point.test == test) out += (out.empty() ? "" : ", ") + point.name;
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
        add("[" + row + "](faults.md)", found != nullptr && found->is_tried_alone() ? points : "-",
            found != nullptr && found->is_tried_served() ? points : "-");
    }
    for (const std::string& test : fault.tests)
        add("`" + test + "`", names_of(fault.run_at, test), names_of(fault.served_at, test));
    for (const std::string& reason : {fault.reason, fault.not_tried.run, fault.not_tried.serve})
        if (!reason.empty()) add(reason);
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
        for (const rack::TomlNode& entry : node.children) take(section.not_tried, entry);
        const rack::TomlNode* faults = node.find("fault");
        for (std::size_t i = 0; faults != nullptr && i < faults->children.size(); ++i) {
            MOTIONRACK_TRY(CoveredFault one, covered_fault(faults->children[i]));
            section.faults.push_back(std::move(one));
        }
    }
    return out;
}

std::set<std::string> points_of(const CoveredFault& fault, const std::vector<Group>& catalogue, Tried how) {
    std::set<std::string> out;
    for (const std::string& row : fault.rows) {
        const Fault* found = find_row(catalogue, row);
        if (found == nullptr || !(how == Tried::alone ? found->is_tried_alone() : found->is_tried_served())) continue;
        for (const Point& point : found->setup.points) out.insert(row + ", " + point.name);
    }
    for (const TestedPoint& point : how == Tried::alone ? fault.run_at : fault.served_at)
        out.insert(point.test + ", " + point.name);
    return out;
}

std::string coverage_page(const std::vector<CoverageSection>& sections, const std::vector<Group>& catalogue) {
    std::size_t all = 0, tried = 0, missing = 0;
    std::string tables;
    for (const CoverageSection& section : sections) {
        tables += fmt::format("\n## {}\n", section.name);
        for (const std::string& reason : {section.not_tried.run, section.not_tried.serve})
            if (!reason.empty()) tables += reason + "\n\n";
        tables += "| | fault | tried by | at | served at |\n|---|---|---|---|---|\n";
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
               "missing: {}.\n\nEach fault is tried at two operating points by a run, or another command (\"at\"), and "
               "at two in a served machine (\"served at\"); a sentence says why where it is not. A served machine is "
               "broken in the same way as a run: it raises one alarm with the words of the run, and its positions are "
               "valid exactly as in the run.\n",
               all, tried, all - tried - missing, missing) +
           tables;
}

}  // namespace motionrack::faults
