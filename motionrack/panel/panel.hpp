// Panel: the complete interface of an operated machine for pages and programs: commands, queries, status, channels,
// events. JSON, without a network; operation_specs.hpp declares the operations.
//
//   any thread ──ask──► [ checked against the specs: name, fields, role, lease ] ──post──► Machine, motion thread
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

/// A command or query declared in the specs and executed elsewhere (invite, revoke_user, users). Any thread.
using Handler = std::function<Answer(const Caller& caller, const nlohmann::json& fields)>;

struct PanelSettings {
    std::string version = {}, boot = {};
    std::string rack_text = {};            ///< the rack file, for the query rack
    operate::ClockPacer* pacer = nullptr;  ///< pacer of the machine; nullptr: its clock cannot be changed
    journal::Journal* journal =
        nullptr;  ///< journal of commands and machine events; commands are answered when their entries are safe
    std::function<nlohmann::json()> link = {};  ///< "link" of the status; called on the motion thread, never waits
    std::map<std::string, Handler, std::less<>> external = {};
    std::chrono::microseconds picture_every{5'000};  ///< status period in real time; 0: every slice
};

/// A list of channels with an observer; it is read while a reference to it exists.
class ChannelSet {
  public:
    explicit ChannelSet(std::vector<std::string> names) : names_(std::move(names)) {}
    const std::vector<std::string>& names() const { return names_; }
    /// Returns the newest values; nullptr before the first ones. Any thread, never waits.
    std::shared_ptr<const Values> newest() const { return std::atomic_load(&values_); }
    void show(std::shared_ptr<const Values> values) { std::atomic_store(&values_, std::move(values)); }

  private:
    std::vector<std::string> names_;
    std::shared_ptr<const Values> values_;
};

/// Returns a public identifier of a session, which grants no access.
std::string session_mark(std::string_view session);

class Panel {
  public:
    static constexpr std::size_t max_channels = 64;

    /// Call before Machine::run; machine and lease must outlive the panel, and the panel must outlive the run.
    Panel(operate::Machine& machine, auth::ControlLease& lease, PanelSettings settings);
    ~Panel();

    // ---- any thread
    /// Executes a command or query of the specs. `reply` is called once, on any thread; for a recorded command when its
    /// journal entry is on disk.
    void ask(const Caller& caller, std::string_view name, const nlohmann::json& fields,
             std::function<void(Answer)> reply);
    /// Commands a STOP for any caller, whatever the role; never waits.
    void stop(const Caller& caller);
    /// Handles the end of this session's connection: ends its jogs and its service.
    void left(std::string session);
    /// Returns the set of these channels; equal lists share one. `ready` is called once, on the motion thread. Errors:
    /// invalid_input for unknown names or more than max_channels.
    void subscribe(std::vector<std::string> channels, std::function<void(Result<std::shared_ptr<ChannelSet>>)> ready);
    /// Newest status of the machine; never nullptr.
    std::shared_ptr<const StatusSnapshot> picture() const { return std::atomic_load(&picture_); }
    /// Adds a listener for events, which is called on the motion thread and must not wait. Call before Machine::run.
    void on_event(std::function<void(const Event&)> call);

    /// Returns the OpenAPI description of the operations, from the specs.
    static const nlohmann::json& openapi();

  private:
    class Inside;
    std::shared_ptr<const StatusSnapshot> picture_;
    std::unique_ptr<Inside> inside_;  // last member: publishes statuses during its whole lifetime
};

}  // namespace motionrack::panel
