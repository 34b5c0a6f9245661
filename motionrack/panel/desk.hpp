// What orders and queries work on: the machine, who holds it, and what the panel remembers. Only the motion thread uses it.
#pragma once

#include <deque>
#include <map>
#include <motionrack/authority/control_lease.hpp>
#include <motionrack/operate/machine.hpp>
#include <motionrack/panel/channels.hpp>
#include <motionrack/panel/panel.hpp>
#include <motionrack/panel/tables.hpp>
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
class EventBook {
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

struct Desk {
    operate::Machine& machine;
    authority::ControlLease& lease;
    PanelSettings settings;
    EventBook book;
    ChannelBook channels;

    rack::Rack& rack() { return machine.rack(); }
};

/// One order or query: gives the answer's members.
using Doing = Result<nlohmann::json> (*)(Desk& desk, const Caller& caller, const nlohmann::json& fields);
/// One that ends later.
using LongDoing = void (*)(Desk& desk, const Caller& caller, const nlohmann::json& fields, std::function<void(Result<nlohmann::json>)> ready);
struct Doer {
    std::string_view name;
    Doing now = nullptr;
    LongDoing later = nullptr;
};
std::span<const Doer> control_doers();
std::span<const Doer> motion_doers();
std::span<const Doer> program_doers();
std::span<const Doer> looking_doers();

/// The letter of a field that names an axis of the rack. Errors: bad_input.
Result<char> axis_of(Desk& desk, const nlohmann::json& fields);

}  // namespace motionrack::panel
