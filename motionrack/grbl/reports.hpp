// Reports to a sender: the status "<..>", the parser state of $G, the parameters of $#, and results of probing.
#pragma once

#include <cstdint>
#include <motionrack/grbl/answers.hpp>
#include <motionrack/grbl/gcode_lines.hpp>
#include <motionrack/grbl/grbl_state.hpp>
#include <motionrack/grbl/line_reader.hpp>
#include <motionrack/grbl/override_state.hpp>
#include <motionrack/grbl/session_settings.hpp>
#include <motionrack/grbl/settings.hpp>
#include <motionrack/operate/machine.hpp>
#include <string>

namespace motionrack::grbl {

class Reports {
  public:
    /// Read for the reports. All must outlive them.
    struct Sources {
        operate::Machine& machine;
        const SessionSettings& settings;
        const SessionSettingValues& own;
        const LineReader& reader;
        const GcodeLines& gcode;
        const GrblState& state;
        const OverrideState& overrides;
    };
    Reports(const Sources& sources, Answers& answers) : from_(sources), answers_(answers) {}

    /// Requests a status report. Several requests before the next answer count as one.
    void request_status() { status_wanted_ = true; }
    /// Sends the status report if one is requested.
    void answer_request();
    /// Sends the result of a probing move that has ended. Returns true for a result that is new.
    bool report_probe();
    /// Sends overrides and accessories with the next status report.
    void repeat_overrides() { until_overrides_ = 0; }
    /// Sends the work offset with the next status report, and the overrides after it.
    void repeat_all() { until_offset_ = until_overrides_ = 0; }

    /// Returns the answer to $G.
    std::string parser_state() const;
    /// Returns the answer to $#.
    std::string parameters() const;

  private:
    std::string state_text(State now) const;
    std::string values(const control::Point& point) const;
    std::string counted_reports(State now);
    std::string pins() const;
    std::string accessories() const;
    std::string probe_text() const;
    double spindle_rpm() const;

    const Sources from_;
    Answers& answers_;
    bool status_wanted_ = false;
    std::int64_t probes_reported_ = 0;            ///< see control::ProbeReport::count
    int until_offset_ = 0, until_overrides_ = 0;  ///< countdown of reports
    control::Point reported_offset_ = {};
    Overrides reported_overrides_;
    std::string reported_accessories_;
};

}  // namespace motionrack::grbl
