// Report of a run: one HTML file with the verdict, the path, charts and tables.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/base/result.hpp>
#include <optional>
#include <string>
#include <vector>

namespace motionrack::trace {

/// Machine coordinates X, Y, Z in mm.
using Xyz = std::array<double, 3>;

/// "As programmed", or a description of the problem.
struct ReportVerdict {
    bool ok = false;
    std::string text;  ///< one or two sentences
};

/// One of the large numbers under the verdict, as displayed: {"Duration", "12.48", "s"}.
struct ReportNumber {
    std::string label;
    std::string value;
    std::string unit;  ///< empty: no unit
};

/// One axis. `unit` is "mm" or "deg"; positions are in it, velocities in unit/s, accelerations in unit/s^2.
struct ReportAxis {
    std::string name;         ///< "X"
    std::string unit = "mm";  ///< "mm" or "deg"
    bool servo = false;       ///< driven by a voltage: no pulses are sent or lost
    double min_position = 0;  ///< travel; min >= max: unlimited
    double max_position = 0;
    double max_velocity = 0;           ///< limit; 0: unlimited
    double max_accel = 0;              ///< limit; 0: unlimited
    std::int64_t pulses_sent = 0;      ///< counted on the wire, both directions
    std::int64_t pulses_net = 0;       ///< counted on the wire, forward less backward
    std::int64_t pulse_counter = 0;    ///< change of the card's own pulse counter
    std::int64_t encoder_counts = 0;   ///< encoder counts read by the card
    std::int64_t expected_counts = 0;  ///< encoder counts expected from the pulses sent
    std::int64_t lost_steps = 0;
    double peak_velocity = 0;       ///< maximum absolute value measured
    double peak_accel = 0;          ///< maximum absolute value measured
    double peak_velocity_step = 0;  ///< maximum velocity step (from standstill or at a corner), unit/s
    double planned_end = 0;         ///< programmed end position
    double actual_end = 0;          ///< true end position of the motor
    /// Series over ReportData::seconds: each is empty or of the same length. Non-finite values are skipped.
    std::vector<float> position;
    std::vector<float> velocity;
    std::vector<float> accel;
    std::vector<float> volts;  ///< at a servo's amplifier, V; empty for other axes
};

/// Segment of the programmed path, from start to end; an arc is the points of a polyline.
struct ReportSegment {
    std::vector<Xyz> points;
    bool rapid = false;  ///< drawn dashed
    int line = 0;        ///< line of the part program; 0: unknown
};

/// Point of maximum deviation from the programmed path.
struct ReportMaxDeviation {
    double mm = 0;
    double seconds = 0;
    int line = 0;  ///< 0: unknown
    Xyz at{};      ///< true position
};

/// Point at which motion ended before the end of the program.
struct ReportStop {
    double seconds = 0;
    int line = 0;  ///< 0: unknown
    Xyz at{};
    std::string text;  ///< reason
};

/// One executed move. Lengths and velocities are along the path: mm and mm/s, or deg and deg/s, according to `unit`.
struct ReportMove {
    int line = 0;
    std::string text;  ///< line text of the part program
    std::string kind;  ///< "traverse", "line", "arc", "dwell"
    double length = 0;
    std::string unit = "mm";  ///< "mm" or "deg"
    double start = 0;         ///< s
    double duration = 0;      ///< s
    double entry_velocity = 0;
    double peak_velocity = 0;
    double exit_velocity = 0;
    double deviation_mm = 0;  ///< maximum distance from the programmed path
};

struct ReportWarning {
    double seconds = -1;  ///< < 0: no instant
    int line = 0;         ///< 0: unknown
    std::string text;
};

/// Picture beside others: an SVG in the style of the page.
struct ReportPicture {
    std::string title;
    std::vector<std::string> words;  ///< caption lines below the title
    std::string svg;
    bool wide = false;  ///< uses the full width of the page
};

/// Table of texts; each row has as many cells as `heads`.
struct ReportTable {
    std::string title, caption;
    std::vector<std::string> heads;
    std::vector<std::vector<std::string>> rows;
};

/// A series over ReportData::seconds in a separate chart.
struct ReportSeries {
    std::string title;  ///< with unit: "X, mm"
    std::string style;  ///< "x", "y", "z", "a", "b", "c" or "d"
    std::vector<float> values;
    std::string limits_name;     ///< "field"
    std::vector<double> limits;  ///< empty, or two
};

/// A file, unchanged.
struct ReportSource {
    std::string title, text;
};

/// All data of a report. Any part may be empty; empty parts are not drawn.
struct ReportData {
    std::string title;
    std::string program_kind = "Program";  ///< name for the kind of the run's file
    std::string program_name;
    std::string rack_name;
    ReportVerdict verdict;
    std::vector<ReportNumber> numbers;
    std::vector<ReportAxis> axes;
    std::vector<double> seconds;      ///< instants of all series, s, not decreasing
    std::vector<float> deviation_mm;  ///< distance of the true position from the programmed path, over `seconds`
    double tolerance_mm = 0;          ///< reference line of the deviation; 0: not drawn
    std::vector<ReportSegment> planned;
    std::vector<Xyz> driven;  ///< true positions over `seconds`
    std::optional<ReportMaxDeviation> max_deviation;
    std::optional<ReportStop> stop;
    std::vector<ReportMove> moves;  ///< in execution order; the page lists the first 2,000
    std::vector<ReportWarning> warnings;
    std::vector<ReportPicture> pictures;
    std::string pictures_hint;  ///< caption that explains the lines of the pictures
    std::vector<ReportTable> tables;
    std::vector<ReportSeries> series;
    std::optional<ReportSource> source;
    std::vector<std::string> notes;  ///< omissions of this report, in sentences
};

/// Returns the page: one HTML text including style, drawings, numbers and script; it loads nothing. Equal data gives
/// equal bytes. Series are decimated without losing extremes, so that the page stays below about 4 MB.
std::string report_html(const ReportData& data);

/// Writes report_html to `path` and replaces an existing file. Errors: io.
Result<void> write_report(const ReportData& data, const std::string& path);

}  // namespace motionrack::trace
