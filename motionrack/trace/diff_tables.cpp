// Compares two CSV tables row by row.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/base/numbers.hpp>
#include <motionrack/trace/changes.hpp>
#include <motionrack/trace/csv_rows.hpp>
#include <motionrack/trace/diff_parts.hpp>

namespace motionrack::trace {

namespace {

constexpr std::uint64_t rows_between_looks = 1 << 12;

/// A column that both tables have.
struct Column {
    std::string name;
    std::size_t a = 0, b = 0;
    bool differs = false;
};

/// Matches columns by name; duplicates of a name are matched in order.
std::vector<Column> common_columns(const CsvRows& a, const CsvRows& b, Diff& diff) {
    std::vector<Column> out;
    std::vector<bool> taken(b.head().size());
    for (std::size_t i = 0; i < a.head().size(); ++i) {
        std::size_t other = 0;
        while (other < taken.size() && (taken[other] || b.head()[other] != a.head()[i])) ++other;
        if (other == taken.size()) {
            diff.only_a.push_back(a.head()[i]);
            continue;
        }
        taken[other] = true;
        out.push_back({a.head()[i], i, other, false});
    }
    for (std::size_t i = 0; i < taken.size(); ++i)
        if (!taken[i]) diff.only_b.push_back(b.head()[i]);
    return out;
}

/// Equal as text or as numbers.
bool equal(const std::string& a, const std::string& b) {
    if (a == b) return true;
    const double x = number_of(a), y = number_of(b);
    return !std::isnan(x) && x == y;
}

std::optional<Instant> time_of(const std::vector<Column>& columns, const std::vector<std::string>& a) {
    std::int64_t ps = 0;
    for (const Column& column : columns)
        if (column.name == "time_s" && read_ps(a[column.a], ps)) return Instant{(ps + 50) / 100};
    return std::nullopt;
}

std::string shown_cell(const std::string& value) {
    return value.empty() ? "nothing" : value;
}

void compare_rows(std::vector<Column>& columns, const std::vector<std::string>& a, const std::vector<std::string>& b,
                  Diff& diff) {
    for (Column& column : columns) {
        ++diff.compared;
        if (column.differs || equal(a[column.a], b[column.b])) continue;
        column.differs = true;
        diff.differences.push_back(
            {column.name, time_of(columns, a), shown_cell(a[column.a]), shown_cell(b[column.b]), ""});
    }
}

/// Reports that the longer table continues with this row.
void report_rest(const std::vector<Column>& columns, const std::vector<std::string>& row, bool of_a, std::uint64_t rows,
                 Diff& diff) {
    std::vector<Column> own = columns;
    if (!of_a)
        for (Column& column : own) column.a = column.b;
    const std::string goes_on = "goes on", ends = fmt::format("ends after {} rows", rows);
    diff.differences.push_back({"number of rows", time_of(own, row), of_a ? goes_on : ends, of_a ? ends : goes_on, ""});
}

}  // namespace

Result<Diff> diff_tables(const std::string& path_a, const std::string& path_b, const DiffSettings& settings) {
    MOTIONRACK_TRY(CsvRows a, CsvRows::open(path_a));
    MOTIONRACK_TRY(CsvRows b, CsvRows::open(path_b));
    Diff diff;
    diff.kind = "tables";
    std::vector<Column> columns = common_columns(a, b, diff);
    diff.signals = columns.size();
    std::vector<std::string> row_a, row_b;
    for (std::uint64_t rows = 0;; ++rows) {
        MOTIONRACK_TRY(const bool more_a, a.next(row_a));
        MOTIONRACK_TRY(const bool more_b, b.next(row_b));
        if (more_a && more_b) compare_rows(columns, row_a, row_b, diff);
        if (more_a != more_b) report_rest(columns, more_a ? row_a : row_b, more_a, rows, diff);
        if (!more_a || !more_b) break;
        if (rows % rows_between_looks != 0) continue;
        if (settings.progress) settings.progress(a.part());
        if (settings.stop && settings.stop()) {
            diff.stopped = true;
            break;
        }
    }
    if (a.cut()) diff.notes.push_back(path_a + " does not end with a whole row: it was cut off.");
    if (b.cut()) diff.notes.push_back(path_b + " does not end with a whole row: it was cut off.");
    sort_differences(diff);
    return diff;
}

}  // namespace motionrack::trace
