// Sampled values as CSV (RFC 4180): a head with units, then one line a sample; lines end in CR LF, points in numbers.
//
//     time_s,x_position_mm,x_speed_mm_s
//     0,0,0
//     0.001,0.0125,25
//
//     time_s,event,line,x_mm,y_mm,z_mm,text
//     0,block,3,0,0,0,arc
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

/// Writes one CSV file, line by line, through a buffer. Numbers are the shortest text that reads back as the same
/// number; what is not finite is an empty field. A write error stops the writing and is told by close.
class CsvWriter {
  public:
    /// `columns`: names with units, "x_position_mm"; they are quoted where RFC 4180 asks for it. Errors: io.
    /// The file takes its name when it is closed; what stood there before stays until then.
    static Result<CsvWriter> create(const std::string& path, const std::vector<std::string>& columns);
    /// A log: the file is there from its first line on.
    static Result<CsvWriter> create_log(const std::string& path, const std::vector<std::string>& columns);

    CsvWriter(CsvWriter&& other) noexcept;
    CsvWriter& operator=(CsvWriter&& other) noexcept;
    CsvWriter(const CsvWriter&) = delete;
    CsvWriter& operator=(const CsvWriter&) = delete;
    ~CsvWriter();

    /// The fields of a line, from the left; end_line needs as many as there are columns.
    void add(double value);
    void add(float value);
    void add(std::int64_t value);
    void add(std::string_view text);
    void end_line();

    /// The lines so far are in the file, whatever becomes of this program. Errors: as close.
    Result<void> flush();
    /// Errors: io, the first error met; what was written is kept under the name that the sentence says. If only the
    /// end is missing it can go on and be closed again.
    Result<void> close();

  private:
    CsvWriter() = default;
    static Result<CsvWriter> begin(Result<disk::NewFile> file, const std::string& path,
                                   const std::vector<std::string>& columns);
    void separate();
    void write_out();

    disk::NewFile file_;
    bool gave_up_ = false;  ///< bytes were left out: the file cannot become whole
    std::string buffer_;
    std::size_t columns_ = 0;
    std::size_t fields_ = 0;
};

/// What happened in a run, in order of time: the start of each block, warnings, the worst deviation, the stop. Columns
/// time_s, event ("block", "warning", "worst deviation", "stop"), line, x_mm, y_mm, z_mm (where the machine was), text
/// (the block's kind, what the warning says). What is not known is empty; what has no instant comes first. Errors: io.
Result<void> write_events_csv(const ReportData& data, const std::string& path);

/// All samples of a run, not thinned: time, position, speed and acceleration of each axis that has them, the driven
/// path and the deviation. Errors: io.
Result<void> write_csv(const ReportData& data, const std::string& path);

}  // namespace motionrack::trace
