// Generates the reference page of the sweep file from the reader's tables.
#include <fmt/format.h>

#include <motionrack/rack/fields_table.hpp>
#include <motionrack/sweep/sweep_fields.hpp>

namespace motionrack::sweep {

namespace {

constexpr std::string_view vary_doc =
    "Varied parameters, one line each. A single value is a list of one.\n\n"
    "| name | values | meaning |\n|---|---|---|\n"
    R"(| `"axis.X.max_limit_mm"`, any key of a [rack file](rack-file.md) | as in the rack file )"
    R"(| put into the rack file, in place of its value; `axis.X.max_limit_mm` without quotes is the same; )"
    R"(names with dots in quotes: `wires."motion.xin1"` |)"
    "\n"
    R"(| `"fault"` | texts | faults as for `run --fault`; several with blanks between, `""` is none |)"
    "\n"
    R"(| `"text.NAME"` | numbers, texts | put into the program for each `{NAME}`; )"
    R"(NAME is up to 32 letters, digits and `_` |)"
    "\n\nInstead of a list, numbers between two others:\n\n";

}  // namespace

std::string sweep_file_reference() {
    const SweepSettings settings;
    const RangeSettings range;
    std::string out = fmt::format(
        "# The sweep file\nTOML, for [`motionrack sweep`](../howto/sweep.md). Unknown keys, wrong types, values out of "
        "range, racks and programs that would be refused are reported all at once, with line and column, "
        "before anything runs. A sweep has at most {} points and {} varied parameters.\n\n",
        max_points, max_parameters);
    out += "## [sweep]\n" + rack::fields_table(sweep_fields, &settings, &settings);
    out += fmt::format("## [vary]\n{}", vary_doc) + rack::fields_table(range_fields, &range, &range);
    out +=
        "A grid has all combinations; its points are numbered so that the last line of `[vary]` changes first. Numbers "
        "between others have few digits: they are off by at most a 20,000th of the range.\n";
    return out;
}

}  // namespace motionrack::sweep
