// Stores rows and sorts them.
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <motionrack/sweep/results.hpp>
#include <motionrack/trace/csv_rows.hpp>
#include <motionrack/trace/former_version.hpp>
#include <system_error>
#include <unordered_set>

namespace motionrack::sweep {

namespace {

bool is_hdf5(const std::string& path) {
    return path.ends_with(".h5") || path.ends_with(".hdf5");
}

Result<void> put_in_place(const std::string& made, const std::string& path) {
    if (std::rename(made.c_str(), path.c_str()) == 0) return {};
    return fail(ErrorKind::io, fmt::format("{} could not be written: {}. Its rows are kept in {}.", path,
                                           std::generic_category().message(errno), made));
}

/// Column names in table order; result columns only if `shown`.
std::vector<std::string> heads(const Sweep& sweep, const std::vector<bool>& shown) {
    std::vector<std::string> out = {"key", "point"};
    for (const VariedParameter& parameter : sweep.parameters()) out.push_back(parameter.name);
    const auto columns = result_columns();
    for (std::size_t c = 0; c < columns.size(); ++c)
        if (shown[c]) out.push_back(columns[c].name);
    return out;
}

std::vector<bool> all_shown() {
    return std::vector<bool>(result_columns().size(), true);
}

/// Result columns that at least one point has.
std::vector<bool> shown_of(const Sweep& sweep, const Results& results) {
    const auto columns = result_columns();
    std::vector<bool> out(columns.size(), false);
    for (std::int64_t i = 0; i < sweep.points(); ++i)
        for (std::size_t c = 0; c < columns.size(); ++c)
            out[c] = out[c] || !cell_of(results.row(i), columns[c].name).empty();
    return out;
}

}  // namespace

Result<std::unique_ptr<Results>> Results::open(const Sweep& sweep, const std::string& path, bool fresh) {
    std::unique_ptr<Results> out(new Results(sweep, path));
    // Reads the file even if it is not used, so that a file that is not a table is not overwritten.
    MOTIONRACK_TRY(Rows whole, is_hdf5(path) ? read_rows_hdf5(path) : read_rows_csv(path));
    MOTIONRACK_TRY(Rows begun, read_rows_csv(out->part()));
    if (!fresh) {
        begun.merge(whole);
        for (std::int64_t i = 0; i < sweep.points(); ++i)
            if (auto row = begun.extract(sweep.key(i))) out->rows_.insert(std::move(row));
    }
    for (std::int64_t i = 0; i < sweep.points(); ++i) ++out->wanted_[sweep.key(i)], out->done_ += out->has(i);
    MOTIONRACK_CHECK(out->begin_part());
    return out;
}

/// Starts the file with the reused rows; it has its final name at once and grows there.
Result<void> Results::begin_part() {
    const std::string made = part() + ".incomplete";
    MOTIONRACK_TRY(trace::CsvWriter csv, trace::CsvWriter::create_log(made, heads(sweep_, all_shown())));
    csv_ = std::make_unique<trace::CsvWriter>(std::move(csv));
    for (std::int64_t i = 0; i < sweep_.points(); ++i)
        if (has(i)) write_row(*csv_, i, all_shown());
    MOTIONRACK_CHECK(csv_->flush());
    return put_in_place(made, part());
}

void Results::write_row(trace::CsvWriter& csv, std::int64_t point, const std::vector<bool>& shown) const {
    csv.add(sweep_.key(point));
    csv.add(point);
    for (const rack::TomlNode& value : sweep_.values(point)) csv.add(value_text(value));
    const auto columns = result_columns();
    for (std::size_t c = 0; c < columns.size(); ++c)
        if (shown[c]) csv.add(cell_of(row(point), columns[c].name));
    csv.end_line();
}

std::vector<std::int64_t> Results::missing() const {
    std::vector<std::int64_t> out;
    std::unordered_set<std::string_view> seen;
    for (std::int64_t i = 0; i < sweep_.points(); ++i)
        if (!has(i) && seen.insert(sweep_.key(i)).second) out.push_back(i);
    return out;
}

Result<void> Results::add(std::int64_t point, Row row) {
    if (!rows_.emplace(sweep_.key(point), std::move(row)).second) return {};
    done_ += wanted_.at(sweep_.key(point));
    write_row(*csv_, point, all_shown());
    return csv_->flush();
}

Result<void> Results::finish() {
    if (is_hdf5(path_)) {
        MOTIONRACK_CHECK(write_table_hdf5(table_of(sweep_, *this), path_));
    } else {
        const std::vector<bool> shown = shown_of(sweep_, *this);
        MOTIONRACK_TRY(trace::CsvWriter csv, trace::CsvWriter::create(path_, heads(sweep_, shown)));
        for (std::int64_t i = 0; i < sweep_.points(); ++i) write_row(csv, i, shown);
        MOTIONRACK_CHECK(csv.close());
    }
    MOTIONRACK_CHECK(csv_->close());
    std::error_code gone;
    std::filesystem::remove(part(), gone);
    return {};
}

std::vector<TableColumn> table_of(const Sweep& sweep, const Results& results) {
    std::vector<TableColumn> out = {{"key", "", true, {}}, {"point", "", false, {}}};
    for (const VariedParameter& parameter : sweep.parameters())
        out.push_back({parameter.name, "", !parameter.numeric(), {}});
    const auto columns = result_columns();
    const std::vector<bool> shown = shown_of(sweep, results);
    for (std::size_t c = 0; c < columns.size(); ++c)
        if (shown[c]) out.push_back({columns[c].name, columns[c].unit, columns[c].text, {}});
    for (std::int64_t i = 0; i < sweep.points(); ++i) {
        out[0].cells.push_back(sweep.key(i));
        out[1].cells.push_back(std::to_string(i));
        std::size_t at = 2;
        for (const rack::TomlNode& value : sweep.values(i)) out[at++].cells.push_back(value_text(value));
        for (; at < out.size(); ++at) out[at].cells.emplace_back(cell_of(results.row(i), out[at].name));
    }
    return out;
}

Result<Rows> read_rows_csv(const std::string& path) {
    Rows out;
    std::error_code missing;
    if (!std::filesystem::exists(path, missing) || std::filesystem::is_empty(path, missing)) return out;
    MOTIONRACK_TRY(trace::CsvRows csv, trace::CsvRows::open(path));
    const std::vector<std::string>& head = csv.head();
    if (head.size() < 3 || head[0] != "key" || head[1] != "point")
        return fail(
            ErrorKind::refused,
            "The existing file is not a table of a sweep. It was not changed; choose another name, or remove it.", {},
            path);
    if (std::find(head.begin(), head.end(), "worst_deviation_mm") != head.end())
        return fail(ErrorKind::refused,
                    fmt::format("The table has format 1, as motionrack {} writes it: its column 'worst_deviation_mm' "
                                "is now 'max_deviation_mm'. It was left as it is; choose another name, or remove it.",
                                trace::format_1_version),
                    {}, path);
    std::vector<std::string> fields;
    while (true) {
        const Result<bool> next = csv.next(fields);
        if (!next && next.error().kind == ErrorKind::io) return tl::unexpected<Error>(next.error());
        // A truncated row is computed again.
        if (!next || !*next || csv.cut()) return out;
        Row row;
        for (const ResultColumn& column : result_columns())
            for (std::size_t f = 2; f < fields.size(); ++f)
                if (head[f] == column.name && !fields[f].empty()) row.emplace_back(column.name, fields[f]);
        if (!cell_of(row, "ended").empty()) out[fields[0]] = std::move(row);
    }
}

}  // namespace motionrack::sweep
