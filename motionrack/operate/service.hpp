// Service of a card: single calls of its library functions, while the controller drives nothing.
//
//   standstill ──begin──► service: chip reset, its axes invalid ══ call, call, .. ══ end ──► standstill, home again
//                            │ STOP, emergency stop, alarm, limit switch ──► axes stop immediately ──► error stop
//                            └ control lost, client gone, disabling, door, end of the program ──► immediate stop
//
// A card without axes of the machine needs no standstill: its first call starts the service. Axes stop without a ramp,
// because the calls themselves write the ramp settings. A real card may replace such a card: see live_card.hpp.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <motionrack/base/function_library.hpp>
#include <motionrack/base/result.hpp>
#include <motionrack/operate/live_card.hpp>
#include <motionrack/operate/status.hpp>
#include <motionrack/rack/rack.hpp>
#include <optional>
#include <string>
#include <vector>

namespace motionrack::operate {

class Machine;

/// Returns the functions of a card's library. Errors: invalid_input, listing the available cards; refused if the card
/// has no library.
Result<std::span<const FunctionInfo>> library_of(rack::Rack& rack, const std::string& card);

/// Stops all motion that the functions of a library have started, and waits for its standstill.
void stop_at_once(FunctionLibrary& library, Interrupt& host);

/// Used only by the motion thread: commands record requests, step() executes them.
class Service {
  public:
    struct FunctionCall {
        std::string card, function;
        std::map<std::string, std::int64_t, std::less<>> arguments;
    };
    /// Called with a sentence once the service has started or ended.
    using Callback = std::function<void(Result<std::string>)>;
    using Answered = std::function<void(Result<CallAnswer>)>;

    explicit Service(Machine& machine) : machine_(machine) {}
    /// Stops the axes of a real card first.
    ~Service();
    Service(const Service&) = delete;
    Service& operator=(const Service&) = delete;

    /// Starts a service. The machine must be at standstill, and enabled if the card moves one of its axes. Also refused
    /// while a stop is in force, or if the card has no library.
    Result<void> begin(const std::string& card, const StopOrigin& by, const std::string& session, Callback ready);
    /// Stops the axes and returns the card to the controller. Refused without a service.
    Result<void> end(Callback ready);
    /// Requests one function call: checked now, executed by the loop; `ready` receives the result. Refused: no service
    /// of a card that moves axes of the machine, another card's service, a running call. Errors: invalid_input,
    /// refused.
    Result<void> call(FunctionCall call, const StopOrigin& by, const std::string& session, Answered ready);
    /// Handles the end of the session that started the service, or its loss of control.
    void end_of(const std::string& session);
    /// Makes waiting functions return; the loop then ends the service.
    void break_off() { stop_ = stop_ || on(); }

    bool on() const { return !card_.empty(); }
    const std::string& card() const { return card_; }
    const std::string& session() const { return session_; }
    /// Function being executed; empty: none.
    const std::string& working() const { return working_; }
    /// Cards replaced by real ones, and the address of one; nullptr: the card is virtual.
    std::span<const LivePlace> live_places() const;
    const LivePlace* live_place(std::string_view card) const;
    /// Real card in service; nullptr: none.
    const LiveCard* live() const { return live_.get(); }
    /// Returns and clears the sentence about the last service's end or failed start, with a leading blank.
    std::string take_note() { return std::exchange(note_, {}); }
    /// Executes one iteration of the machine's loop while the service is active.
    void step();

    /// Letters of the machine's axes that the card moves.
    std::string axes_of(const std::string& card) const;

  private:
    struct Pending {
        CheckedCall call;
        std::string name;
        Answered ready;
    };
    Result<void> check_begin(const std::string& card) const;
    Result<void> take_library();
    void take();
    void work();
    void watch_live();
    void stop_axes();
    void finish();

    Machine& machine_;
    std::string card_, session_, working_, note_;
    StopOrigin by_;
    std::atomic<bool> stop_{false};
    Callback begun_;
    std::vector<Callback> ended_;  ///< all that have commanded the end
    std::unique_ptr<LiveCard> live_;
    std::unique_ptr<FunctionLibrary> library_;  ///< destroyed first of the two: it writes to the card
    std::optional<Pending> pending_;
};

}  // namespace motionrack::operate
