// Everything that a page or a program may ask of a machine that people operate: orders, queries, pictures, channels,
// events. As JSON, without network; tables.hpp declares what there is.
//
//   any thread ──ask──► [ checked against the tables: name, fields, role, lease ] ──post──► Machine, motion thread
//        ▲                                                                                        │
//        └──────────── reply, when the journal has it ◄────────── Answer ─────────────────────────┘
//   any thread ◄──picture(), ChannelSet::newest()── the newest, shared ◄──every 5 ms at most── motion thread,
//                                                                                           between runs of the kernel
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <motionrack/journal/journal.hpp>
#include <motionrack/operate/clock_pacer.hpp>
#include <motionrack/operate/machine.hpp>
#include <motionrack/panel/answer.hpp>
#include <motionrack/panel/status_snapshot.hpp>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::auth {
class ControlLease;
}

namespace motionrack::panel {

/// An order or a query that is declared in the tables and carried out elsewhere (invite, unpair, users). Any thread.
using Handler = std::function<Answer(const Caller& caller, const nlohmann::json& fields)>;

struct PanelSettings {
    std::string version = {}, boot = {};
    std::string rack_text = {};            ///< the rack file, for the query rack
    operate::ClockPacer* pacer = nullptr;  ///< of the machine; nullptr: its clock cannot be changed
    journal::Journal* journal =
        nullptr;  ///< orders and what the machine does are written to it, and orders are answered when they are safe
    std::function<nlohmann::json()> link = {};  ///< status' "link"; called on the motion thread, never waits
    std::map<std::string, Handler, std::less<>> external = {};
    std::chrono::microseconds picture_every{5'000};  ///< of real time; 0: every slice
};

/// A list of channels that somebody looks at; it is read while anybody holds it.
class ChannelSet {
  public:
    explicit ChannelSet(std::vector<std::string> names) : names_(std::move(names)) {}
    const std::vector<std::string>& names() const { return names_; }
    /// Any thread, cheap; nullptr before the first picture after it was made.
    std::shared_ptr<const Values> newest() const { return std::atomic_load(&values_); }
    void show(std::shared_ptr<const Values> values) { std::atomic_store(&values_, std::move(values)); }

  private:
    std::vector<std::string> names_;
    std::shared_ptr<const Values> values_;
};

/// What a session is called where others see it; tells nothing that would let anybody in.
std::string session_mark(std::string_view session);

class Panel {
  public:
    static constexpr std::size_t max_channels = 64;

    /// Before Machine::run; machine and lease must outlive it, and it the run.
    Panel(operate::Machine& machine, auth::ControlLease& lease, PanelSettings settings);
    ~Panel();

    // ---- any thread
    /// `name`: an order or a query of the tables. `reply` is called once, on any thread, when the order's journal entry
    /// is safe.
    void ask(const Caller& caller, std::string_view name, const nlohmann::json& fields,
             std::function<void(Answer)> reply);
    /// STOP, from anyone; never waits.
    void stop(const Caller& caller);
    /// The connection of this session has ended, and with it what goes on only while it is asked for.
    void left(std::string session);
    /// The set of these channels; equal lists share one. `ready` is called once, on the motion thread. Errors:
    /// invalid_input, unknown names or more than max_channels.
    void subscribe(std::vector<std::string> channels, std::function<void(Result<std::shared_ptr<ChannelSet>>)> ready);
    /// The newest picture of the machine; never nullptr.
    std::shared_ptr<const StatusSnapshot> picture() const { return std::atomic_load(&picture_); }
    /// Everybody who is to hear of events; `call` is called on the motion thread and must not wait. Before
    /// Machine::run.
    void on_event(std::function<void(const Event&)> call);

    /// What HTTP can ask, from the tables.
    static const nlohmann::json& openapi();

  private:
    class Inside;
    std::shared_ptr<const StatusSnapshot> picture_;
    std::unique_ptr<Inside> inside_;  // last: it shows pictures from its begin to its end
};

}  // namespace motionrack::panel
