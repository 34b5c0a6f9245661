// Result table as HDF5: one dataset per column; texts of equal length, numbers as 64-bit floats with NaN if missing.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <motionrack/base/numbers.hpp>
#include <motionrack/sweep/results.hpp>
#include <motionrack/trace/csv_rows.hpp>
#include <motionrack/trace/former_version.hpp>
#include <motionrack/trace/hdf5.hpp>

namespace motionrack::sweep {

namespace {

using trace::hdf5::Hdf5File;
using trace::hdf5::Type;

constexpr const char* format = "motionrack sweep";
constexpr std::int64_t format_version = 2;

/// Path of a column name's text: names contain dots and quotes, and HDF5 paths must not contain slashes.
std::string path_of(std::string name) {
    std::replace(name.begin(), name.end(), '/', '_');
    return name;
}

void write_column(Hdf5File& file, const TableColumn& column) {
    trace::hdf5::ColumnSettings settings;
    settings.unit = column.unit;
    settings.chunk = std::clamp<std::size_t>(column.cells.size(), 1, 1 << 14);
    settings.type = column.text ? Type::text : column.name == "point" ? Type::int64 : Type::float64;
    if (column.text) {
        settings.text_bytes = 1;
        for (const std::string& cell : column.cells) settings.text_bytes = std::max(settings.text_bytes, cell.size());
    }
    auto writer = file.make_column(path_of(column.name), settings);
    bool good = true;
    if (settings.type == Type::text) {
        std::string bytes;
        for (std::string cell : column.cells) cell.resize(settings.text_bytes, '\0'), bytes += cell;
        good = writer.append(bytes.data(), column.cells.size());
    } else if (settings.type == Type::int64) {
        std::vector<std::int64_t> numbers;
        for (const std::string& cell : column.cells) numbers.push_back(static_cast<std::int64_t>(number_of(cell)));
        good = writer.append(numbers.data(), numbers.size());
    } else {
        std::vector<double> numbers;
        for (const std::string& cell : column.cells) numbers.push_back(number_of(cell));
        good = writer.append(numbers.data(), numbers.size());
    }
    if (!good) file.set_trouble("could not be written");
}

Result<std::vector<std::string>> read_column(const Hdf5File& file, const ResultColumn& column) {
    MOTIONRACK_TRY(const auto reader, file.column(column.name));
    std::vector<std::string> out(reader.size());
    std::vector<double> numbers(column.text ? 0 : out.size());
    MOTIONRACK_CHECK(reader.read(0, numbers.size(), numbers.data()));
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (column.text) {
            MOTIONRACK_TRY(out[i], reader.text(i));
        } else if (std::isfinite(numbers[i])) {
            out[i] = fmt::format("{}", numbers[i]);
        }
    }
    return out;
}

}  // namespace

Result<void> write_table_hdf5(const std::vector<TableColumn>& table, const std::string& path) {
    MOTIONRACK_TRY(Hdf5File file, Hdf5File::create(path));
    file.set("/", "format", std::string_view(format));
    file.set("/", "format_version", format_version);
    for (const TableColumn& column : table) write_column(file, column);
    return file.close();
}

Result<Rows> read_rows_hdf5(const std::string& path) {
    Rows out;
    std::error_code missing;
    if (!std::filesystem::exists(path, missing) || std::filesystem::is_empty(path, missing)) return out;
    const Result<Hdf5File> file = Hdf5File::open(path);
    MOTIONRACK_TRY(const std::string found, file ? file->attribute_text("format") : "");
    if (found != format)
        return fail(
            ErrorKind::refused,
            "The existing file is not a table of a sweep. It was not changed; choose another name, or remove it.", {},
            path);
    MOTIONRACK_TRY(const std::int64_t version, file->attribute_number("format_version"));
    if (version != format_version)
        return fail(
            ErrorKind::refused,
            fmt::format("The table has format {}{}; this program continues tables of format {}. It was left as "
                        "it is; choose another name, or remove it.",
                        version,
                        version == 1 ? fmt::format(", as motionrack {} writes it", trace::format_1_version) : "",
                        format_version),
            {}, path);
    MOTIONRACK_TRY(const std::vector<std::string> keys, read_column(*file, {"key", "", true}));
    std::vector<Row> rows(keys.size());
    for (const ResultColumn& column : result_columns()) {
        MOTIONRACK_TRY(const bool has_column, file->has(column.name));
        if (!has_column) continue;
        MOTIONRACK_TRY(const std::vector<std::string> cells, read_column(*file, column));
        for (std::size_t i = 0; i < std::min(cells.size(), rows.size()); ++i)
            if (!cells[i].empty()) rows[i].emplace_back(column.name, cells[i]);
    }
    for (std::size_t i = 0; i < keys.size(); ++i)
        if (!cell_of(rows[i], "ended").empty()) out[keys[i]] = std::move(rows[i]);
    return out;
}

}  // namespace motionrack::sweep
