// Generates the reference page of the marking job from the reader's tables.
#include <fmt/format.h>

#include <motionrack/mark/job_fields.hpp>
#include <motionrack/rack/fields_table.hpp>

namespace motionrack::mark {

namespace {

/// Returns the object whose members hold the defaults of a section.
const void* defaults_of(const MarkingJob& job, const DrawingSource& drawing, const rack::RackLens& lens,
                        const PartsSettings& parts, std::string_view section) {
    if (section == "drawing") return &drawing;
    if (section == "optics") return &job.optics;
    if (section == "lens") return &lens;
    if (section == "galvo") return &job.galvo;
    if (section == "laser") return &job.laser;
    if (section == "pace") return &job.pace;
    if (section == "fly") return &job.fly;
    if (section == "parts") return &parts;
    if (section == "sender") return &job.sender;
    return &job.belt;
}

std::string array_row(const fields::ArrayKey& key, std::string_view section) {
    const auto both = [&](std::string_view text, std::string_view quote) {
        const auto one = [&](std::string_view unit) {
            return fmt::format("{}{}{}", quote, rack::with_unit(text, unit), quote);
        };
        if (text.find("{u}") == std::string_view::npos) return one("");
        if (section == "belt" || section == "table") return one(section == "belt" ? "mm" : "deg");
        return one("mm") + " / " + one("deg");
    };
    return fmt::format("| {} | {} | {} | {} | {} |\n", both(key.key, "`"), both(key.unit, ""), key.range, key.absent,
                       key.doc);
}

}  // namespace

std::string job_file_reference() {
    const MarkingJob job;
    const DrawingSource drawing;
    const rack::RackLens lens;
    const PartsSettings parts;
    std::string out =
        "# The marking job\nTOML, for `motionrack mark`. Every section but `[drawing]` may be left out; its files are "
        "searched for in its folder. Unknown keys, wrong types, values out of range and keys that do not go together "
        "are "
        "errors; all are reported at once, with line and column. Where a key has two names, the first is for a belt, "
        "the second for a table.\n\n";
    for (const fields::SectionInfo& section : fields::sections) {
        const void* defaults = defaults_of(job, drawing, lens, parts, section.name);
        out += fmt::format("## [{}]\n", section.name);
        if (!section.doc.empty()) out += fmt::format("{}\n\n", section.doc);
        std::string table = rack::fields_table(section.fields, defaults, defaults);
        if (!section.array.key.empty()) table.insert(table.size() - 1, array_row(section.array, section.name));
        out += table;
    }
    out.pop_back();
    return out;
}

}  // namespace motionrack::mark
