// Register accesses of a real card, its waits and its stop.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/operate/live_card.hpp>
#include <utility>

namespace motionrack::operate {

namespace {

constexpr Duration live_piece = milliseconds(1);         // virtual time between two polls of the card
constexpr Duration max_live_lag = milliseconds(50);      // virtual time does not catch up beyond this
constexpr Duration registers_every = milliseconds(500);  // period of reading the registers
constexpr Duration max_stop_wait = milliseconds(100);    // limit for a function that waits for an axis to stop
constexpr int min_stop_waits = 10;                       // minimum polls within it, for a busy computer
constexpr int max_live_looks = 100;

constexpr const char* by_its_wires =
    "Its axes may still move: press the emergency stop that cuts the motors' power, the only remaining stop. ";

}  // namespace

LiveCard::LiveCard(const LivePlace& place, rack::Rack& rack, const rack::CardPlugin& plugin)
    : place_(place),
      plugin_(plugin),
      select_(rack::bus_select(*rack.config().card(place.card))),
      host_(rack.cards().front()->host()) {}

Result<std::unique_ptr<LiveCard>> LiveCard::open(const LivePlace& place, rack::Rack& rack) {
    const rack::CardPlugin* const plugin = rack::find_card_plugin(rack.config().card(place.card)->type);
    std::unique_ptr<LiveCard> card(new LiveCard(place, rack, *plugin));
    MOTIONRACK_CHECK(card->open_port());
    card->poll();
    if (card->lost_) return tl::unexpected<Error>(*card->lost_);
    return card;
}

Result<void> LiveCard::open_port() {
    last_stop_.reset();
    last_library_.reset();
    card_ = {};  // with its lock
    MOTIONRACK_TRY(card_, live::open_card(place_.spec, plugin_.map()));
    lost_.reset();
    last_library_ = plugin_.library({card_.registers, card_.bytes, card_.port.get(), select_});
    last_stop_.emplace(*last_library_);
    return {};
}

// ---- accesses

void LiveCard::write(std::uint32_t offset, std::uint16_t value) {
    if (lost_ || live::is_program_ending()) return;
    card_.registers->write(offset, value);
    lost_ = card_.port->trouble();
}

/// Returns 0, the value of an axis at standstill, once the card is lost or an axis does not stop.
std::uint16_t LiveCard::read(std::uint32_t offset) {
    if (lost_ || gives_up_) return 0;
    const std::uint16_t value = card_.registers->read(offset);
    lost_ = card_.port->trouble();
    return lost_ ? std::uint16_t{0} : value;
}

void LiveCard::out(std::uint8_t port, std::uint8_t value) {
    if (lost_ || live::is_program_ending()) return;
    card_.bytes->out(port, value);
    lost_ = card_.port->trouble();
}

/// Returns 0 once the card is lost or an axis does not stop: a STAT that is not Ready, so that waits time out.
std::uint8_t LiveCard::in(std::uint8_t port) {
    if (lost_ || gives_up_) return 0;
    const std::uint8_t value = card_.bytes->in(port);
    lost_ = card_.port->trouble();
    return lost_ ? std::uint8_t{0} : value;
}

void LiveCard::poll() {
    if (lost_ || gives_up_) return;
    Result<rack::RegisterView> view = plugin_.view(bus(), false);
    if (!view && !lost_) lost_ = view.error();
    if (lost_) return;
    polled_ = now();
    registers_ = {std::move(*view), host_.now()};
}

bool LiveCard::is_look_due() const {
    return !stop_requested() && now() - polled_ >= registers_every;
}

void LiveCard::look_now_and_then() {
    if (is_look_due()) poll();
}

void LiveCard::look_beside_function() {
    if (plugin_.view_while_waiting == nullptr) return look_now_and_then();
    if (!is_look_due()) return;
    polled_ = now();
    rack::RegisterView view = plugin_.view_while_waiting(bus());
    if (!lost_) registers_ = {std::move(view), host_.now()};
}

// ---- waits

bool LiveCard::wait(Duration timeout) {
    const Instant end = later(now(), timeout);
    for (;;) {
        const Duration left = std::clamp(end - now(), Duration{0}, live_piece);
        const bool woken = !lost_ && card_.port->wait(left);
        if (lost_) clock_.sleep(left);
        keep_up();  // even if the line stays active: commands arrive with virtual time
        heed_stop();
        if (woken) return true;
        if (stop_requested() || now() >= end) return false;
    }
}

void LiveCard::pass(Duration duration) {
    const Instant end = later(now(), duration);
    do {
        clock_.sleep(std::clamp(end - now(), Duration{0}, live_piece));
        keep_up();
        heed_stop();
    } while (now() < end);
}

/// Advances virtual time by a millisecond per millisecond of the computer. Missed waits are not made up for.
void LiveCard::keep_up() {
    const Duration behind = now() - passed_;
    if (behind < live_piece) return;
    passed_ = behind > max_live_lag ? now() : passed_ + live_piece;
    host_.pass(live_piece);
    look_beside_function();
}

void LiveCard::heed_stop() {
    if (stopping_ || !stop_requested()) return;
    if (!stopped_) stopped_ = now();
    gives_up_ = ++stop_waits_ > min_stop_waits && now() - *stopped_ > max_stop_wait;
}

// ---- stops

std::optional<Error> LiveCard::doubt() const {
    if (lost_ || !gives_up_) return lost_;
    return Error{
        ErrorKind::machine,
        fmt::format("The function had not ended {} ms after the stop and was aborted; it does not show whether the "
                    "axes of card {} are at standstill. Check the alarms and the registers of the card.",
                    max_stop_wait / milliseconds(1), place_.card)};
}

bool LiveCard::stands_after_stop(FunctionLibrary& library) {
    for (int attempt = 0; attempt < max_live_looks; ++attempt) {
        library.stop_now();
        const bool moves = library.moving();
        if (lost_) return false;
        if (!moves) return true;
        host_.pass(live_piece);
    }
    return false;
}

LiveStop LiveCard::stop(FunctionLibrary& library) {
    gives_up_ = false;
    stopping_ = true;
    const std::optional<Error> refused = lost_;
    if (!refused && stands_after_stop(library)) return {true, ""};
    const std::string why = lost_ ? lost_->message : "";
    if (why.empty())
        return {false, fmt::format("An axis of card {} at {} still moves after {} polls, although the quick stop of "
                                   "all axes was commanded before each. {}Begin the service again at standstill.",
                                   place_.card, place_.place, max_live_looks, by_its_wires)};
    const Result<void> opened = open_port();
    if (opened && stands_after_stop(library))
        return {true, fmt::format("{} The port of card {} was opened again, and the quick stop of all axes was written "
                                  "through it: they stand. Check the card before its next service.",
                                  why, place_.card)};
    const std::string again = !opened ? opened.error().message : lost_ ? lost_->message : "";
    return {
        false,
        fmt::format("{} The quick stop of all axes of card {} at {} was not written, or had no effect{}. {}Begin the "
                    "service again once the card answers.",
                    why, place_.card, place_.place,
                    again.empty() || again == why ? "" : fmt::format(", with the port opened again: {}", again),
                    by_its_wires)};
}

}  // namespace motionrack::operate
