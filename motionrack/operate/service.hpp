// Service of a card: orders call the functions of its library one by one, and the controller drives nothing.
//
//   standstill ──begin──► service: chip reset, its axes not trusted ══ call, call, .. ══ end ──► standstill, home again
//                            │ STOP, emergency stop, alarm, limit switch ──► axes stop at once ──► error stop
//                            └ control lost, client gone, disabling, door, end of the program ──► axes stop at once
//
// A card that moves no axis of the machine needs no standstill of its own: its first call begins the service. Axes stop
// without a ramp, because a ramp would be the one that the calls have written. A real card may stand for such a card:
// see live_card.hpp.
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

namespace motionrack::operate {

class Machine;

/// The functions of a card's library. Errors: invalid_input, with the cards that there are; refused, it has no library.
Result<std::span<const FunctionInfo>> library_of(rack::Rack& rack, const std::string& card);

/// Only the motion thread uses it: orders note, step() does.
class Service {
  public:
    struct Call {
        std::string card, function;
        std::map<std::string, std::int64_t, std::less<>> arguments;
    };
    /// Hears a sentence once the service has begun, or has ended.
    using Told = std::function<void(Result<std::string>)>;
    using Answered = std::function<void(Result<CallAnswer>)>;

    explicit Service(Machine& machine) : machine_(machine) {}
    /// A real card's axes stop first.
    ~Service();
    Service(const Service&) = delete;
    Service& operator=(const Service&) = delete;

    /// The machine must stand, enabled where the card moves one of its axes. Refused else, also while a stop is in
    /// force and where the card has no library.
    Result<void> begin(const std::string& card, const StopOrigin& by, const std::string& session, Told ready);
    /// Stops the axes and gives the card back. Refused: there is no service.
    Result<void> end(Told ready);
    /// One function; checked now, called by the loop, `ready` hears what it gave. Refused: no service of a card that
    /// moves axes of the machine, another card's service, a call that still works. Errors: invalid_input, refused.
    Result<void> call(Call call, const StopOrigin& by, const std::string& session, Answered ready);
    /// The session that began it is gone, or has lost control.
    void end_of(const std::string& session);
    /// Functions that wait return, and the loop ends the service.
    void break_off() { stop_ = stop_ || on(); }

    bool on() const { return !card_.empty(); }
    const std::string& card() const { return card_; }
    const std::string& session() const { return session_; }
    /// The function that works at this moment; empty: none.
    const std::string& working() const { return working_; }
    /// The cards for which real ones stand, and the place of one; nullptr: it is virtual.
    std::span<const LivePlace> live_places() const;
    const LivePlace* live_place(std::string_view card) const;
    /// The real card that is in service; nullptr: there is none.
    const LiveCard* live() const { return live_.get(); }
    /// What the last service took from the axes, with a blank in front; once.
    std::string take_note() { return std::exchange(note_, {}); }
    /// One turn of the loop, while it is on.
    void step();

  private:
    struct Pending {
        CheckedCall call;
        std::string name;
        Answered ready;
    };
    /// The letters of the machine's axes that it moves.
    std::string axes_of(const std::string& card) const;
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
    Told begun_, ended_;
    std::unique_ptr<LiveCard> live_;
    std::unique_ptr<FunctionLibrary> library_;  ///< last of the two: it writes to the card
    std::optional<Pending> pending_;
};

}  // namespace motionrack::operate
