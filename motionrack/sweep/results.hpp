// The table of a sweep, and what is kept of it while it runs.
//
//   results.csv.part   a row as soon as its point is done, in that order; what is in it survives a kill
//   results.csv        all rows, by point; written whole when the last one is there, then the other is gone
//
// Rows are found again by their key, the hash of everything that they were made of: rows of another program, rack or
// value are not taken.
#pragma once

#include <cstdint>
#include <memory>
#include <motionrack/sweep/sweep.hpp>
#include <motionrack/trace/csv.hpp>
#include <string>
#include <unordered_map>
#include <vector>

namespace motionrack::sweep {

/// Rows by their keys.
using Rows = std::unordered_map<std::string, Row>;

class Results {
  public:
    /// Takes what an earlier run left, unless `fresh`. A path that ends in .h5 or .hdf5 is HDF5, any other CSV. Errors:
    /// io; refused, there is a file that is no table of a sweep.
    static Result<std::unique_ptr<Results>> open(const Sweep& sweep, const std::string& path, bool fresh);

    bool has(std::int64_t point) const { return rows_.count(sweep_.key(point)) != 0; }
    const Row& row(std::int64_t point) const { return rows_.at(sweep_.key(point)); }
    std::int64_t points() const { return sweep_.points(); }
    /// How many points have their row.
    std::int64_t done() const { return done_; }
    /// The points that have none; of those with the same key the first.
    std::vector<std::int64_t> missing() const;

    /// The row of this point; it is in the file when this returns. Another one with the same key is left out. Errors:
    /// io.
    Result<void> add(std::int64_t point, Row row);
    /// Writes the table, if all rows are there; then the other file is gone. Errors: io.
    Result<void> finish();

    /// Where rows are kept until then.
    std::string part() const { return path_ + ".part"; }

  private:
    Results(const Sweep& sweep, std::string path) : sweep_(sweep), path_(std::move(path)) {}
    Result<void> begin_part();
    void write_row(trace::CsvWriter& csv, std::int64_t point, const std::vector<bool>& shown) const;

    const Sweep& sweep_;
    std::string path_;
    Rows rows_;
    std::unordered_map<std::string, std::int64_t> wanted_;  // how many points have this key
    std::int64_t done_ = 0;
    std::unique_ptr<trace::CsvWriter> csv_;
};

/// A column of the table.
struct TableColumn {
    std::string name, unit;
    bool text = false;
    std::vector<std::string> cells;  ///< one a point; empty where there is none
};
/// key, point, what is varied, and the results that some point has. All rows must be there.
std::vector<TableColumn> table_of(const Sweep& sweep, const Results& results);

/// Writes a table, over what was there. Errors: io.
Result<void> write_table_hdf5(const std::vector<TableColumn>& table, const std::string& path);

/// The rows of a table that was written, or of one that was cut off; none if there is no such file. Errors: io;
/// refused, the file is no table of a sweep.
Result<Rows> read_rows_csv(const std::string& path);
Result<Rows> read_rows_hdf5(const std::string& path);

}  // namespace motionrack::sweep
