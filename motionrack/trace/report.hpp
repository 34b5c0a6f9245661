// What a run is told as: one page with the verdict, the path, the charts and the tables, in one HTML file of its own.
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

/// "As programmed" or what went wrong, in words.
struct ReportVerdict {
    bool ok = false;
    std::string text;  ///< one or two sentences for a person
};

/// One of the large numbers under the verdict, as it is to be read: {"Duration", "12.48", "s"}.
struct ReportNumber {
    std::string label;
    std::string value;
    std::string unit;  ///< empty: no unit
};

/// One axis. `unit` is "mm" or "deg"; positions are in it, speeds in unit/s, accelerations in unit/s^2.
struct ReportAxis {
    std::string name;         ///< "X"
    std::string unit = "mm";  ///< "mm" or "deg"
    bool servo = false;       ///< it follows a voltage: no pulses are sent, and none can be lost
    double min_position = 0;  ///< travel; min >= max: the travel is not limited
    double max_position = 0;
    double max_velocity = 0;           ///< limit; 0: none
    double max_accel = 0;              ///< limit; 0: none
    std::int64_t pulses_sent = 0;      ///< counted on the wire, both directions
    std::int64_t pulses_net = 0;       ///< counted on the wire, forward less backward
    std::int64_t pulse_counter = 0;    ///< by how much the card's own counter of them changed
    std::int64_t counts_read = 0;      ///< encoder counts the card read back
    std::int64_t counts_expected = 0;  ///< encoder counts that the pulses sent should give
    std::int64_t lost_steps = 0;
    double peak_velocity = 0;       ///< greatest absolute value measured
    double peak_accel = 0;          ///< greatest absolute value measured
    double peak_velocity_step = 0;  ///< greatest change of speed at once (from standstill or at a corner), unit/s
    double planned_end = 0;         ///< where the program ends
    double real_end = 0;            ///< where the motor really is
    /// Series over ReportData::seconds: each is empty or as long as it. Values that are not finite are left out.
    std::vector<float> position;
    std::vector<float> speed;
    std::vector<float> accel;
    std::vector<float> volts;  ///< at a servo's amplifier, V; of other axes empty
};

/// A piece of the programmed path, from its start to its end; arcs come as the points of a polyline.
struct ReportSegment {
    std::vector<Xyz> points;
    bool rapid = false;  ///< drawn dashed
    int line = 0;        ///< line of the part program, 0: none
};

/// The place where the machine was farthest from the programmed path.
struct ReportMaxDeviation {
    double mm = 0;
    double seconds = 0;
    int line = 0;  ///< 0: none
    Xyz at{};      ///< where the machine was
};

/// Where motion ended before the program did.
struct ReportStop {
    double seconds = 0;
    int line = 0;  ///< 0: none
    Xyz at{};
    std::string text;  ///< why
};

/// One block as it was driven. Lengths and speeds are of the path: mm and mm/s, or deg and deg/s as `unit` says.
struct ReportMove {
    int line = 0;
    std::string text;  ///< the line as written in the part program
    std::string kind;  ///< "traverse", "line", "arc", "dwell"
    double length = 0;
    std::string unit = "mm";  ///< "mm" or "deg"
    double start = 0;         ///< s
    double duration = 0;      ///< s
    double entry_speed = 0;
    double peak_velocity = 0;
    double exit_speed = 0;
    double deviation_mm = 0;  ///< greatest distance from the programmed path
};

struct ReportWarning {
    double seconds = -1;  ///< < 0: no instant
    int line = 0;         ///< 0: none
    std::string text;
};

/// A picture beside others: an SVG that takes its style from the page.
struct ReportPicture {
    std::string title;
    std::vector<std::string> words;  ///< lines below the title
    std::string svg;
    bool wide = false;  ///< takes the page's whole width
};

/// A table of texts; `rows` as long as `heads`.
struct ReportTable {
    std::string title, caption;
    std::vector<std::string> heads;
    std::vector<std::vector<std::string>> rows;
};

/// A line over ReportData::seconds in a chart of its own.
struct ReportSeries {
    std::string title;  ///< with the unit: "X, mm"
    std::string look;   ///< "x", "y", "z", "a", "b", "c" or "d"
    std::vector<float> values;
    std::string limits_name;     ///< "field"
    std::vector<double> limits;  ///< none, or two
};

/// A file as it was written.
struct ReportSource {
    std::string title, text;
};

/// All that a report shows. Everything may be empty; what is not there is not drawn.
struct ReportData {
    std::string title;
    std::string program_kind = "Program";  ///< what the file that was run is called
    std::string program_name;
    std::string rack_name;
    ReportVerdict verdict;
    std::vector<ReportNumber> numbers;
    std::vector<ReportAxis> axes;
    std::vector<double> seconds;      ///< instants of all series, s, never falling
    std::vector<float> deviation_mm;  ///< distance of the machine from the programmed path, over `seconds`
    double tolerance_mm = 0;          ///< what the deviation is held against; 0: no line is drawn
    std::vector<ReportSegment> planned;
    std::vector<Xyz> driven;  ///< where the machine was, over `seconds`
    std::optional<ReportMaxDeviation> worst;
    std::optional<ReportStop> stop;
    std::vector<ReportMove> blocks;  ///< in the order driven; the page lists the first 2,000
    std::vector<ReportWarning> warnings;
    std::vector<ReportPicture> pictures;
    std::string pictures_hint;  ///< what their lines are
    std::vector<ReportTable> tables;
    std::vector<ReportSeries> series;
    std::optional<ReportSource> source;
    std::vector<std::string> notes;  ///< what this report does not show, in sentences
};

/// The page: one HTML text with its style, drawings, numbers and script inside; it fetches nothing. The same data gives
/// the same bytes. Series are thinned so that extremes stay, so the page stays below about 4 MB whatever comes in.
std::string report_html(const ReportData& data);

/// Writes report_html to `path`, over what was there. Errors: io.
Result<void> write_report(const ReportData& data, const std::string& path);

}  // namespace motionrack::trace
