// Start and end conditions of a service, and the state of the machine afterwards.
#include <fmt/format.h>

#include <motionrack/operate/machine.hpp>
#include <motionrack/operate/service.hpp>
#include <motionrack/rack/bus_access.hpp>
#include <utility>

namespace motionrack::operate {

namespace {

constexpr Duration look_at_stop_every = milliseconds(1);
/// Limit of the polls for standstill after a stop; pulses end with the stop command.
constexpr int max_looks = 100;

}  // namespace

Result<std::span<const FunctionInfo>> library_of(rack::Rack& rack, const std::string& card) {
    MOTIONRACK_TRY(const rack::Card* found, rack::card_named(rack, card));
    const std::span<const FunctionInfo> functions = found->library_functions();
    if (!functions.empty()) return functions;
    return fail(ErrorKind::refused,
                fmt::format("Card {} is of type {}: it has no function library for a service. Nothing was done.", card,
                            found->map().name));
}

void stop_at_once(FunctionLibrary& library, Interrupt& host) {
    library.stop_now();
    for (int i = 0; i < max_looks && library.moving(); ++i) host.pass(look_at_stop_every);
}

std::string Service::axes_of(const std::string& card) const {
    std::string letters;
    for (const rack::RackAxis& axis : machine_.rack_.config().axes)
        if (axis.card == card) letters += axis.letter;
    return letters;
}

// ---- commands

Result<void> Service::check_begin(const std::string& card) const {
    static constexpr const char* what = "The service was not started";
    if (on())
        return fail(ErrorKind::refused,
                    fmt::format("{}: card {} is in service. Nothing was changed; end that first.", what, card_));
    MOTIONRACK_CHECK(library_of(machine_.rack_, card));
    MOTIONRACK_CHECK(machine_.conditions_.may_begin(what));
    const std::string letters = axes_of(card);
    if (!letters.empty() || machine_.publisher_.state() != MachineState::disabled)
        MOTIONRACK_CHECK(machine_.conditions_.ready(what));
    MOTIONRACK_CHECK(machine_.conditions_.axes_may_move(what, letters));
    if (machine_.programs_.stream().has_work() || machine_.manual_.jogs().any() || machine_.manual_access_.any() ||
        machine_.conditions_.has_pending())
        return fail(
            ErrorKind::refused,
            fmt::format("{}: a command is still being executed. Nothing was changed; try again at once.", what));
    return {};
}

Result<void> Service::begin(const std::string& card, const StopOrigin& by, const std::string& session, Callback ready) {
    MOTIONRACK_CHECK(check_begin(card));
    card_ = card;
    by_ = by;
    session_ = session;
    begun_ = std::move(ready);
    stop_ = false;
    note_.clear();
    const LivePlace* const live = live_place(card);
    machine_.publisher_.enter(
        MachineState::service,
        fmt::format("card {} is in service by {}{}", card, by.who.empty() ? std::string("this program") : by.who,
                    live == nullptr ? "" : fmt::format("; it is a real one, at {}", live->place)));
    return {};
}

Result<void> Service::end(Callback ready) {
    if (!on()) return fail(ErrorKind::refused, "No card is in service. Nothing was changed.");
    if (ready) ended_.push_back(std::move(ready));
    break_off();
    return {};
}

Result<void> Service::call(FunctionCall call, const StopOrigin& by, const std::string& session, Answered ready) {
    MOTIONRACK_TRY(const std::span<const FunctionInfo> functions, library_of(machine_.rack_, call.card));
    MOTIONRACK_TRY(CheckedCall checked, check_call(functions, call.function, call.arguments));
    if (on() && call.card != card_)
        return fail(ErrorKind::refused,
                    fmt::format("{} was not called: the machine is in the service state for card {}, not for card {}. "
                                "End that service first.",
                                call.function, card_, call.card));
    if (!on() && !axes_of(call.card).empty())
        return fail(ErrorKind::refused,
                    fmt::format("{} was not called: card {} is driven by the controller. Begin its service first.",
                                call.function, call.card));
    if (!on()) MOTIONRACK_CHECK(begin(call.card, by, session, {}));
    if (stop_) return fail(ErrorKind::refused, fmt::format("{} was not called: the service ends.", call.function));
    if (pending_ || !working_.empty())
        return fail(ErrorKind::refused,
                    fmt::format("{} was not called: {} still runs. Wait until it ends, or end the service.",
                                call.function, pending_ ? pending_->name : working_));
    pending_.emplace(Pending{std::move(checked), std::move(call.function), std::move(ready)});
    return {};
}

void Service::end_of(const std::string& session) {
    if (!on() || session != session_) return;
    machine_.cancel({by_.who, by_.address, "Loss of control"});
}

// ---- the loop

void Service::step() {
    if (!stop_ && !library_) take();
    if (!stop_ && machine_.manual_access_.any()) machine_.manual_access_.step();  // of cards that measure only
    if (!stop_ && pending_) work();
    if (!stop_) host_of(machine_.rack_).pass(look_at_stop_every);
    if (live_) watch_live();
    if (stop_) finish();
}

/// Takes the card from the controller. The positions of the card's axes are invalid from here on, even on an error.
void Service::take() {
    rack::Card& card = *machine_.rack_.card(card_);
    std::string lost;
    for (const rack::RunningAxis& axis : machine_.rack_.axes()) {
        if (axis.card != card.motion()) continue;
        machine_.validity_.invalidate(axis.config.letter);
        lost += fmt::format("{}{}", lost.empty() ? "" : ", ", axis.config.letter);
    }
    note_ = fmt::format(" The service of card {} has ended", card_);
    note_ += lost.empty() ? "." : fmt::format("; the position of {} is not valid: home it, or set its position.", lost);
    machine_.rack_.set_stop_flag(&stop_);
    if (!lost.empty()) machine_.handover_.release();
    const Result<void> begun = machine_.handover_.hand_over([this] { return take_library(); });
    if (!begun) {
        stop_ = true;
        machine_.publisher_.status().reason = begun.error().message;
        if (lost.empty())
            note_ = fmt::format(" The service of card {} was not started. {}", card_, begun.error().message);
    }
    if (const Callback reported = std::exchange(begun_, {}))
        reported(begun ? Result<std::string>(fmt::format(
                             "Card {} is in service: it was reset, and only its functions drive it.{}", card_,
                             lost.empty() ? "" : fmt::format(" The position of {} is not valid any more.", lost)))
                       : tl::unexpected<Error>(begun.error()));
}

Result<void> Service::take_library() {
    const LivePlace* const place = live_place(card_);
    if (place == nullptr) {
        library_ = machine_.rack_.card(card_)->take_library();
        return library_->begin();
    }
    MOTIONRACK_TRY(std::unique_ptr<LiveCard> card, LiveCard::open(*place, machine_.rack_));
    library_ = card->make_library();
    live_ = std::move(card);
    MOTIONRACK_CHECK(library_->begin());
    live_->poll();
    if (live_->lost()) return tl::unexpected<Error>(*live_->lost());
    return {};
}

void Service::work() {
    const Pending one = *std::exchange(pending_, std::nullopt);
    working_ = one.name;
    Result<CallAnswer> answer = library_->call(one.call.function, one.call.values);
    working_.clear();
    if (live_) {
        if (!stop_) live_->poll();
        if (std::optional<Error> doubt = live_->doubt()) answer = tl::unexpected<Error>(std::move(*doubt));
    }
    one.ready(std::move(answer));
}

// ---- a real card

Service::~Service() {
    if (live_) library_->stop_now();
}

std::span<const LivePlace> Service::live_places() const {
    return machine_.settings_.live;
}

const LivePlace* Service::live_place(std::string_view card) const {
    for (const LivePlace& one : live_places())
        if (one.card == card) return &one;
    return nullptr;
}

void Service::watch_live() {
    live_->look_now_and_then();
    if (live_->lost()) stop_ = true;
}

/// Possible remaining motion of a real card is an alarm. It stays until its axes are seen at standstill after another
/// service.
void Service::stop_axes() {
    if (!live_) return stop_at_once(*library_, host_of(machine_.rack_));
    const LiveStop stop = live_->stop(*library_);
    const std::string source = "card " + card_;
    if (stop.is_stationary) machine_.alarms_.end_staying(source);
    if (stop.sentence.empty()) return;
    machine_.alarms_.raise(source, stop.sentence).stays = !stop.is_stationary;
}

/// Ends all motion of the card and initialises it for the controller.
void Service::finish() {
    if (library_) {
        stop_axes();
        library_.reset();
        live_.reset();
    }
    const Result<void> taken = machine_.handover_.take_back();
    const std::string sentence =
        note_.empty() ? fmt::format("The service of card {} was not started.", card_) : note_.substr(1);
    card_.clear();
    session_.clear();
    stop_ = false;
    if (pending_) std::exchange(pending_, std::nullopt)->ready(fail(ErrorKind::stopped, "Not called. " + sentence));
    if (const Callback reported = std::exchange(begun_, {})) reported(fail(ErrorKind::stopped, sentence));
    if (!taken)
        machine_.failed(taken.error());
    else if (machine_.publisher_.state() == MachineState::service && !machine_.rack_.stop_latch().latched())
        machine_.publisher_.enter(machine_.enables_.any() ? MachineState::standstill : MachineState::disabled,
                                  sentence);
    else if (machine_.publisher_.state() == MachineState::stopping)
        machine_.publisher_.status().reason += note_;
    if (!machine_.rack_.stop_latch().latched()) note_.clear();
    for (const Callback& reported : std::exchange(ended_, {}))
        reported(taken ? Result<std::string>(sentence) : tl::unexpected<Error>(taken.error()));
}

}  // namespace motionrack::operate
