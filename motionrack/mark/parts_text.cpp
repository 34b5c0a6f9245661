// Formats the parts of a run as a table, one row each, with the reason for each unmarked part.
#include <fmt/format.h>

#include <iterator>
#include <motionrack/mark/render.hpp>

namespace motionrack::mark {

namespace {

constexpr std::size_t max_rows = 40;

std::string lost_text(const PartMarked& part, std::size_t number) {
    switch (part.fate) {
        case PartOutcome::lost_busy:
            return fmt::format(
                "part {}: its start at {:.5f} s was lost, because the list of an earlier part was still running; mark "
                "faster, or increase the spacing of the parts\n",
                number, part.begin_s);
        case PartOutcome::lost_too_many:
            return fmt::format(
                "part {}: its start at {:.5f} s was lost, because eight starts were waiting; move the sensor nearer, "
                "or increase the spacing of the parts\n",
                number, part.begin_s);
        default:
            return fmt::format("part {}: was not started, because the card starts it after the part before it\n",
                               number);
    }
}

}  // namespace

std::string parts_text(const MarkingJob& job, const Marked& marked) {
    if (!job.parts) return {};
    std::string text;
    const auto to = std::back_inserter(text);
    const std::size_t all = marked.parts.size();
    fmt::format_to(to, "parts: {} of {} marked\n{:>6} {:>8} {:>11} {:>11} {:>10} {:>10} {:>10}\n",
                   all - marked.parts_lost(), all, "part", "number", "from s", "to s", "max mm", "rms mm",
                   "missing mm");
    std::size_t rows = 0, hidden = 0;
    for (std::size_t i = 0; i < all; ++i) {
        const PartMarked& part = marked.parts[i];
        if (++rows > max_rows && i + 1 < all) {
            ++hidden;
        } else if (part.fate == PartOutcome::marked) {
            fmt::format_to(to, "{:>6} {:>8} {:>11.5f} {:>11.5f} {:>10.4f} {:>10.4f} {:>10.3f}\n", i + 1, part.number,
                           part.begin_s, part.end_s, part.deviation.max_mm, part.deviation.rms_mm,
                           part.deviation.missing_mm);
        } else {
            text += lost_text(part, i + 1);
        }
    }
    if (hidden > 0) fmt::format_to(to, "{} more parts are in the JSON.\n", hidden);
    return text;
}

}  // namespace motionrack::mark
