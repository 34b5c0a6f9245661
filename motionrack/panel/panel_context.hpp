// Context of commands and queries: the machine, the control lease, and the panel's stored data. Used only by the motion
// thread.
#pragma once

#include <deque>
#include <map>
#include <motionrack/auth/control_lease.hpp>
#include <motionrack/operate/machine.hpp>
#include <motionrack/panel/background_worker.hpp>
#include <motionrack/panel/channel_registry.hpp>
#include <motionrack/panel/operation_specs.hpp>
#include <motionrack/panel/panel.hpp>
#include <motionrack/panel/program_plan.hpp>
#include <motionrack/panel/rack_view.hpp>
#include <motionrack/panel/scope.hpp>
#include <span>
#include <string_view>

namespace motionrack::panel {

/// Reply to a request: passes its first answer on. If it is destroyed unanswered, answers that the machine is gone.
class Reply {
  public:
    explicit Reply(std::function<void(Answer)> call) : call_(std::make_shared<PendingCall>(std::move(call))) {}
    void operator()(Answer answer) const {
        if (call_->call) std::exchange(call_->call, nullptr)(std::move(answer));
    }

  private:
    struct PendingCall {
        explicit PendingCall(std::function<void(Answer)> one) : call(std::move(one)) {}
        ~PendingCall();
        PendingCall(const PendingCall&) = delete;
        PendingCall& operator=(const PendingCall&) = delete;
        std::function<void(Answer)> call;
    };
    std::shared_ptr<PendingCall> call_;
};

/// Log of events; stores the newest max_events.
class EventLog {
  public:
    static constexpr std::size_t max_events = 1000;
    const Event& add(Event event);
    void listen(std::function<void(const Event&)> call) { listeners_.push_back(std::move(call)); }
    const std::deque<Event>& events() const { return events_; }

  private:
    std::deque<Event> events_;
    std::int64_t next_ = 1;
    std::vector<std::function<void(const Event&)>> listeners_;
};

/// Actual path of the machine: the newest max_points positions, each at least `apart` (mm) from the previous one.
class ActualPath {
  public:
    static constexpr std::size_t max_points = 20'000;
    static constexpr double apart = 0.05;
    struct ActualPoint {
        Instant at{};
        control::Point position = {};  ///< by the encoders
        double error = 0;  ///< deviation from the commanded position: mm of X Y Z, or degrees if only other axes moved
    };
    void add(const operate::Status& status);
    void clear() { points_.clear(); }
    const std::deque<ActualPoint>& points() const { return points_; }

  private:
    std::deque<ActualPoint> points_;
};

struct PanelContext {
    PanelContext(operate::Machine& machine_here, auth::ControlLease& lease_here, PanelSettings settings_here)
        : machine(machine_here),
          lease(lease_here),
          settings(std::move(settings_here)),
          channels(machine),
          scope(machine, channels),
          facts(rack_facts(machine)) {
        for (const rack::RackAxis& axis : machine.rack().config().axes) letters += axis.letter;
    }
    operate::Machine& machine;
    auth::ControlLease& lease;
    PanelSettings settings;
    EventLog book;
    ChannelRegistry channels;
    Scope scope;
    ActualPath driven;
    std::shared_ptr<const ProgramPlan> plan;  ///< plan of the last started program; nullptr until it is ready
    std::uint64_t mark_stops = 0;             ///< mark_stop commands so far
    std::int64_t programs = 0;                ///< number of programs started; identifies the plan
    std::string program;                      ///< text of the last started program
    std::string letters;                      ///< letters of the axes
    nlohmann::json facts;                     ///< constant data of the rack
    BackgroundWorker worker;                  ///< destroyed first: its work posts to the machine

    /// Runs `work` on the worker; `ready` receives the result on the motion thread. Refused if too much is pending.
    template <class Made>
    void run_async(std::function<Result<Made>()> work, std::function<void(Result<Made>)> ready) {
        const bool taken = worker.post([this, work = std::move(work), ready]() mutable {
            machine.post([made = work(), ready = std::move(ready)]() mutable { ready(std::move(made)); });
        });
        if (!taken) ready(fail(ErrorKind::refused, "The server is busy. Nothing was done. Try again later."));
    }
    /// Overload for work whose result has the answer's members.
    void run_async(std::function<Result<nlohmann::json>()> work, std::function<void(Result<nlohmann::json>)> ready) {
        run_async<nlohmann::json>(std::move(work), std::move(ready));
    }
};

/// Handler of a command or query; returns the answer's members.
using HandlerFunction = Result<nlohmann::json> (*)(PanelContext& context, const Caller& caller,
                                                   const nlohmann::json& fields);
/// Callback of a handler that answers later, with the answer's members.
using Ready = std::function<void(Result<nlohmann::json>)>;
using AsyncHandlerFunction = void (*)(PanelContext& context, const Caller& caller, const nlohmann::json& fields,
                                      Ready ready);
struct OperationHandler {
    std::string_view name;
    HandlerFunction now = nullptr;
    AsyncHandlerFunction later = nullptr;
};
std::span<const OperationHandler> control_doers();
std::span<const OperationHandler> motion_doers();
std::span<const OperationHandler> program_doers();
std::span<const OperationHandler> card_doers();
std::span<const OperationHandler> library_doers();
std::span<const OperationHandler> scope_doers();
std::span<const OperationHandler> mark_doers();
std::span<const OperationHandler> looking_doers();
/// Converts the result of a command whose answer has no members.
Result<nlohmann::json> accepted(const Result<void>& result);
/// Returns the number in field `name`, or `otherwise` if the field is missing.
double number_of(const nlohmann::json& fields, std::string_view name, double otherwise);

/// Returns the axis letter in the field "axis". Errors: invalid_input unless the rack has that axis.
Result<char> axis_of(PanelContext& context, const nlohmann::json& fields);

}  // namespace motionrack::panel
