// Writes the machine's events to the journal, and restores the state of the last run from it.
//
//   Status, every slice ──see──► state, job, alarm, setting, position entries;
//                                "machine" is stored: axis positions, running program
//   LastRun ──read_last──► axis positions, a sentence about its end         (killed: no position is valid)
#pragma once

#include <functional>
#include <motionrack/journal/journal.hpp>
#include <motionrack/operate/status.hpp>
#include <motionrack/rack/config.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace motionrack::operate {

/// Used only by the motion thread. The journal must outlive this.
class JournalWriter {
  public:
    /// Receives every entry, in addition to the journal. `data`: JSON.
    using Callback =
        std::function<void(Instant at, const std::string& kind, const std::string& text, const std::string& data)>;
    explicit JournalWriter(journal::Journal& journal) : JournalWriter(&journal, {}) {}
    /// `journal` may be nullptr, `reported` empty.
    JournalWriter(journal::Journal* journal, Callback reported) : journal_(journal), reported_(std::move(reported)) {}
    /// Call with every status; writes its differences from the previous one.
    void see(const Status& status);
    /// Writes a stop command with its user, address and kind. Further stops by the same source within a second count as
    /// the same stop, since a page sends its STOP on two channels. Stops of an idle machine change nothing: 20 in a row
    /// are written, then one per 10 s of virtual time, whatever their source. A machine that is stopping already writes
    /// one of each source, of 20 sources at most.
    void stopped(const StopReport& report);

  private:
    bool is_first_of_its_source(const StopReport& report);
    bool may_repeat(Instant at);
    void see_state(const Status& status);
    void see_job(const Status& status);
    void see_alarms(const Status& status);
    void see_settings(const Status& status);
    void see_positions(const Status& status);
    bool has_shifted(const Status& status) const;
    void keep(const Status& status);
    void write(Instant at, const std::string& kind, const std::string& text, const std::string& data);

    journal::Journal* journal_;
    Callback reported_;
    bool first_ = true;
    MachineState state_ = MachineState::disabled;
    bool program_runs_ = false, single_block_ = false;
    double feed_ = 1, rapid_ = 1;
    std::vector<bool> positions_valid_;
    std::int64_t last_alarm_ = 0;
    std::set<std::int64_t> active_, open_;  ///< alarms with an active cause; alarms that are not acknowledged
    Instant kept_{};
    std::vector<double> kept_axes_;  ///< positions by their counters
    std::optional<StopReport> stopped_;
    std::vector<StopOrigin> stopped_by_;  ///< sources of the entries about the stop in force
    std::int64_t repeats_ = 0;            ///< stop commands to an idle machine
    Instant repeated_{};
};

struct LastKnownPositions {
    std::vector<InitialAxisState> axes;  ///< axes of this rack with a stored position in their travel
    /// Describes the end of an interrupted run, and problems of the journal; empty: a clean end.
    std::string sentence;
};
/// Restores the axis positions that the last run has stored. After an interrupted run, or if the journal is damaged, no
/// position is valid. After an intact run axes without a record are left out.
LastKnownPositions read_last(const journal::LastRun& last, const rack::RackConfig& config);

}  // namespace motionrack::operate
