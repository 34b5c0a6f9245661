// Result table of a sweep and its partial file during the run.
//
//  results.csv.part   each row as soon as its point is done, in that order; survives a kill
//  results.csv        all rows, by point; written as a whole at the end, then the partial file is removed
//
// Rows are found by their key, the hash of all their inputs; rows of another program, rack or value are not reused.
#pragma once

#include <cstdint>
#include <memory>
#include <motionrack/sweep/sweep.hpp>
#include <motionrack/trace/csv_writer.hpp>
#include <string>
#include <unordered_map>
#include <vector>

namespace motionrack::sweep {

/// Rows by key.
using Rows = std::unordered_map<std::string, Row>;

class Results {
  public:
    /// Reuses the rows of an earlier run unless `fresh`. Paths ending in .h5 or .hdf5 are HDF5, others CSV. Errors: io;
    /// refused if an existing file is not a sweep table.
    static Result<std::unique_ptr<Results>> open(const Sweep& sweep, const std::string& path, bool fresh);

    bool has(std::int64_t point) const { return rows_.count(sweep_.key(point)) != 0; }
    const Row& row(std::int64_t point) const { return rows_.at(sweep_.key(point)); }
    std::int64_t points() const { return sweep_.points(); }
    /// Number of points with a row.
    std::int64_t done() const { return done_; }
    /// Points without a row; one per key, the first.
    std::vector<std::int64_t> missing() const;

    /// Adds the row of this point; it is in the file on return. Ignores a second row with the same key. Errors: io.
    Result<void> add(std::int64_t point, Row row);
    /// Writes the table if all rows exist, then removes the partial file. Errors: io.
    Result<void> finish();

    /// Path of the partial file.
    std::string part() const { return path_ + ".part"; }

  private:
    Results(const Sweep& sweep, std::string path) : sweep_(sweep), path_(std::move(path)) {}
    Result<void> begin_part();
    void write_row(trace::CsvWriter& csv, std::int64_t point, const std::vector<bool>& shown) const;

    const Sweep& sweep_;
    std::string path_;
    Rows rows_;
    std::unordered_map<std::string, std::int64_t> wanted_;  // number of points with this key
    std::int64_t done_ = 0;
    std::unique_ptr<trace::CsvWriter> csv_;
};

/// A column of the table.
struct TableColumn {
    std::string name, unit;
    bool text = false;
    std::vector<std::string> cells;  ///< one per point; empty if missing
};
/// Columns: key, point, varied parameters, and the results that at least one point has. Requires all rows.
std::vector<TableColumn> table_of(const Sweep& sweep, const Results& results);

/// Writes a table and replaces an existing file. Errors: io.
Result<void> write_table_hdf5(const std::vector<TableColumn>& table, const std::string& path);

/// Returns the rows of a complete or partial table; none if the file does not exist. Errors: io; refused if the file is
/// not a sweep table.
Result<Rows> read_rows_csv(const std::string& path);
Result<Rows> read_rows_hdf5(const std::string& path);

}  // namespace motionrack::sweep
