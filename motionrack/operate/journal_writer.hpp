// What a machine does, written into the journal; and what the next run makes of it.
//
//   Status, every slice ──see──► state, job, alarm, setting, position entries;
//                                "machine" is kept: where the axes are, what runs
//   LastRun ──read_last──► where the axes stood, a sentence about how it ended     (killed: nothing is trusted)
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

/// Only the motion thread uses it; the journal must outlive it.
class JournalWriter {
  public:
    /// Hears every entry, too. `data`: JSON.
    using Told =
        std::function<void(Instant at, const std::string& kind, const std::string& text, const std::string& data)>;
    explicit JournalWriter(journal::Journal& journal) : JournalWriter(&journal, {}) {}
    /// `journal` may be nullptr, `told` empty.
    JournalWriter(journal::Journal* journal, Told told) : journal_(journal), told_(std::move(told)) {}
    /// Of every picture; writes what is another than in the one before.
    void see(const Status& status);
    /// Of every stop that somebody ordered: who, from where, how. What the same one orders again within a second is
    /// the same stop: a page sends its STOP on two ways. Orders to stop a machine that is idle change nothing: of
    /// them 20 at once are written, then one in 10 s of the rack, whoever gives them.
    void stopped(const StopReport& report);

  private:
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
    Told told_;
    bool first_ = true;
    MachineState state_ = MachineState::disabled;
    bool program_runs_ = false, single_step_ = false;
    double feed_ = 1, rapid_ = 1;
    std::vector<bool> trusted_;
    std::int64_t last_alarm_ = 0;
    std::set<std::int64_t> active_, open_;  ///< alarms whose cause is there; that nobody has acknowledged
    Instant kept_{};
    std::vector<double> kept_axes_;  ///< by their counters
    std::optional<StopReport> stopped_;
    std::int64_t repeats_ = 0;  ///< orders to stop an idle machine
    Instant repeated_{};
};

struct LastKnownPositions {
    std::vector<InitialAxisState> axes;  ///< those that this rack has and that stood where they may
    /// How it ended, if it was cut off, and what is wrong with the journal; empty: it ended by itself, and all is well.
    std::string sentence;
};
/// Nothing is trusted after a run that was cut off, and nothing that does not fit its checksum. Axes without a record
/// are left out where the rest is trusted.
LastKnownPositions read_last(const journal::LastRun& last, const rack::RackConfig& config);

}  // namespace motionrack::operate
