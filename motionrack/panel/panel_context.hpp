// What orders and queries work on: the machine, who holds it, and what the panel remembers. Only the motion thread uses
// it.
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

/// Answers once; whoever is forgotten is told that the machine is gone.
class Reply {
  public:
    explicit Reply(std::function<void(Answer)> call) : call_(std::make_shared<Call>(std::move(call))) {}
    void operator()(Answer answer) const {
        if (call_->call) std::exchange(call_->call, nullptr)(std::move(answer));
    }

  private:
    struct Call {
        explicit Call(std::function<void(Answer)> one) : call(std::move(one)) {}
        ~Call();
        Call(const Call&) = delete;
        Call& operator=(const Call&) = delete;
        std::function<void(Answer)> call;
    };
    std::shared_ptr<Call> call_;
};

/// Events since the start, the last of them kept.
class EventLog {
  public:
    static constexpr std::size_t most = 1000;
    const Event& add(Event event);
    void listen(std::function<void(const Event&)> call) { listeners_.push_back(std::move(call)); }
    const std::deque<Event>& events() const { return events_; }

  private:
    std::deque<Event> events_;
    std::int64_t next_ = 1;
    std::vector<std::function<void(const Event&)>> listeners_;
};

/// Where the machine was, in bounded memory: places nearer than `apart` to the one before are left out.
class ActualPath {
  public:
    static constexpr std::size_t most = 20'000;
    static constexpr double apart = 0.05;
    struct ActualPoint {
        Instant at{};
        control::Point place = {};  ///< as the encoders say
        double error =
            0;  ///< how far it was from where the card sent it: mm of X Y Z, or degrees where only others moved
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
    std::shared_ptr<const ProgramPlan> plan;  ///< of the program that was begun last; nullptr until it is made
    std::int64_t programs = 0;                ///< begun so far: whose plan it is
    std::string program;                      ///< its text
    std::string letters;                      ///< of the axes
    nlohmann::json facts;                     ///< of the rack
    BackgroundWorker worker;                  ///< last, so that it ends first: its work posts to the machine

    /// Runs `work` on the worker; `ready` hears what it gives on the motion thread. Refused: too much waits.
    template <class Made>
    void run_async(std::function<Result<Made>()> work, std::function<void(Result<Made>)> ready) {
        const bool taken = worker.post([this, work = std::move(work), ready]() mutable {
            machine.post([made = work(), ready = std::move(ready)]() mutable { ready(std::move(made)); });
        });
        if (!taken)
            ready(fail(ErrorKind::refused,
                       "Too much is being worked on at this moment; ask again a little later. Nothing was done."));
    }
    /// The same of what is the answer itself.
    void run_async(std::function<Result<nlohmann::json>()> work, std::function<void(Result<nlohmann::json>)> ready) {
        run_async<nlohmann::json>(std::move(work), std::move(ready));
    }
};

/// One order or query: gives the answer's members.
using HandlerFunction = Result<nlohmann::json> (*)(PanelContext& desk, const Caller& caller,
                                                   const nlohmann::json& fields);
/// One that ends later.
using Ready = std::function<void(Result<nlohmann::json>)>;
using AsyncHandlerFunction = void (*)(PanelContext& desk, const Caller& caller, const nlohmann::json& fields,
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
/// An order that answers nothing but that it was taken.
Result<nlohmann::json> accepted(const Result<void>& result);
/// A number of the fields that may be missing.
double number_of(const nlohmann::json& fields, std::string_view name, double otherwise);

/// The letter of a field that names an axis of the rack. Errors: invalid_input.
Result<char> axis_of(PanelContext& desk, const nlohmann::json& fields);

}  // namespace motionrack::panel
