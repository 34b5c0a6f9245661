// Sampled values as CSV (RFC 4180): a head with units, then one line per sample; CR LF line ends, decimal points.
//
//     time_s,x_position_mm,x_velocity_mm_s
//     0,0,0
//     0.001,0.0125,25
//
//     time_s,event,line,x_mm,y_mm,z_mm,text
//     0,move,3,0,0,0,arc
#pragma once

#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/disk/new_file.hpp>
#include <motionrack/trace/report.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::trace {

/// Writes one CSV file line by line through a buffer. Numbers use the shortest text that reads back as the same number;
/// non-finite values become empty fields. A write error stops writing; close() reports it.
class CsvWriter {
  public:
    /// `columns`: names with units, "x_position_mm", quoted as RFC 4180 requires. Errors: io. The file gets its final
    /// name on close; an existing file stays until then.
    static Result<CsvWriter> create(const std::string& path, const std::vector<std::string>& columns);
    /// Creates a log: the file has its final name from the first line.
    static Result<CsvWriter> create_log(const std::string& path, const std::vector<std::string>& columns);

    CsvWriter(CsvWriter&& other) noexcept;
    CsvWriter& operator=(CsvWriter&& other) noexcept;
    CsvWriter(const CsvWriter&) = delete;
    CsvWriter& operator=(const CsvWriter&) = delete;
    ~CsvWriter();

    /// Adds the fields of a line from left to right; end_line() requires one per column.
    void add(double value);
    void add(float value);
    void add(std::int64_t value);
    void add(std::string_view text);
    void end_line();

    /// Writes the lines so far to the file, so that they survive a crash. Errors: as close.
    Result<void> flush();
    /// Errors: io, the first error; the written part is kept under the name in the sentence. If only the end is
    /// missing, writing can continue and close() can be called again.
    Result<void> close();
    /// Returns true after a write error with data omitted: the file cannot be completed.
    bool gave_up() const { return gave_up_; }

  private:
    CsvWriter() = default;
    static Result<CsvWriter> begin(Result<disk::NewFile> file, const std::string& path,
                                   const std::vector<std::string>& columns);
    void separate();
    void write_out();

    disk::NewFile file_;
    bool gave_up_ = false;  ///< bytes were dropped: the file cannot be completed
    std::string buffer_;
    std::size_t columns_ = 0;
    std::size_t fields_ = 0;
};

/// Writes the events of a run in time order: move starts, warnings, the maximum deviation, the stop. Columns: time_s,
/// event ("move", "warning", "max deviation", "stop"), line, x_mm, y_mm, z_mm (true position), text (kind of move,
/// warning). Unknown values are empty; events without an instant come first. Errors: io.
Result<void> write_events_csv(const ReportData& data, const std::string& path);

/// Writes all samples of a run, not decimated: time; position, velocity and acceleration of each axis that has them;
/// actual path and deviation. Errors: io.
Result<void> write_csv(const ReportData& data, const std::string& path);

}  // namespace motionrack::trace
