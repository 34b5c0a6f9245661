// Opens, stops and closes real cards; manual register access.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/rack/catalogue.hpp>
#include <motionrack/rack/register_view.hpp>
#include <python/src/live_card.hpp>

namespace motionrack::python {

namespace {

/// Maximum interval at which a wait checks for signals and stops.
constexpr Duration listen_every = milliseconds(10);

/// Map of a card type of known layout, for registers behind a live port.
const CardMap& map_of(const std::string& type) {
    const rack::CardKind* const kind = rack::find_card_kind(type);
    if (kind != nullptr && kind->view != nullptr) return kind->map();
    std::string known;
    for (const rack::CardKind& each : rack::card_kinds())
        if (each.view != nullptr) known += fmt::format("{}{}", known.empty() ? "" : ", ", each.type);
    raise({ErrorKind::invalid_input,
           kind == nullptr
               ? fmt::format("Unknown card type {}; a real card is one of: {}. Nothing was opened.", type, known)
               : fmt::format("A real {} cannot be opened: its registers are not known as its maker has them, or live "
                             "ports do not reach them. Nothing was opened. Real cards can be: {}.",
                             type, known)});
}

std::unique_ptr<live::CardPort> port_at(const std::string& place, const CardMap& map) {
    std::unique_ptr<live::CardPort> port = value_of(live::CardPort::open(value_of(live::read_port_spec(place)), map));
    value_of(port->check_answers());
    return port;
}

}  // namespace

LiveCard::LiveCard(const std::string& place, const std::string& type)
    : place_(place), map_(map_of(type)), port_(port_at(place, map_)) {}

LiveCard::~LiveCard() {
    if (!closed()) stops_.stop();
}

live::CardPort& LiveCard::open_port() const {
    if (closed()) refuse(fmt::format("The card at {} was closed. Nothing was done. Open it again.", place_));
    return *port_;
}

void LiveCard::check_call() const {
    open_port();
    check_trouble();
    if (stopped())
        raise({ErrorKind::stopped, fmt::format("The card at {} was stopped, and the stop holds. Nothing was done. Call "
                                               "reset_stop() once it may move again.",
                                               place_)});
}

void LiveCard::check_trouble() const {
    if (port_->trouble()) raise(*port_->trouble());
}

// ---- stops

void LiveCard::end_call() {
    if (stopped()) stops_.stop();
    check_trouble();
}

void LiveCard::quick_stop() {
    if (closed()) return;
    stop();
    if (owner.load() == std::this_thread::get_id()) return;  // in a signal handler: the stop ends the call
    const RackLock turn(*this, RackLock::Access::stop);
    if (closed()) return;
    stops_.stop();
    check_trouble();
}

void LiveCard::close() {
    if (closed()) return;
    if (owner.load() == std::this_thread::get_id())
        refuse(fmt::format("The card at {} is in the middle of a call. Nothing was closed. Stop it by quick_stop().",
                           place_));
    stop();
    const RackLock turn(*this, RackLock::Access::stop);
    if (closed()) return;
    stops_.stop();
    const std::optional<Error> trouble = port_->trouble();
    port_.reset();
    if (trouble) raise(*trouble);
}

// ---- drivers

void LiveCard::claim(const std::string& driver) {
    open_port();
    if (!driver_.empty())
        refuse(
            fmt::format("The card at {} is driven by its {}, and a second driver would not know what that has set. "
                        "Nothing was done. Use the first, or close the card and open it again.",
                        place_, driver_));
    driver_ = driver;
}

bool LiveCard::Ears::wait(Duration timeout) {
    const Instant end = later(now(), timeout);
    while (true) {
        signals_.look(card_);
        const Duration left = end - now();
        if (card_.port_->wait(std::clamp(left, Duration{0}, listen_every))) return true;
        if (left <= listen_every || stop_requested()) return false;
    }
}

void LiveCard::Ears::pass(Duration duration) {
    const Instant end = later(now(), duration);
    do {
        signals_.look(card_);
        card_.port_->pass(std::clamp(end - now(), Duration{0}, listen_every));
    } while (now() < end);
}

// ---- manual access

void LiveCard::check_offset(std::uint32_t offset, bool written) const {
    std::string known;
    for (const RegisterInfo& reg : map_.registers) {
        if ((reg.access == Access::write) != written || !reg.bank.empty()) continue;
        if (reg.offset == offset) return;
        known += fmt::format("{}{} {:02X}h", known.empty() ? "" : ", ", reg.name, reg.offset);
    }
    raise({ErrorKind::invalid_input,
           fmt::format("The {} has no register that is {} at {:02X}h; it has {}. Nothing was done.", map_.name,
                       written ? "written" : "read", offset, known)});
}

std::uint16_t LiveCard::read(std::uint32_t offset) {
    const RackLock turn(*this, RackLock::Access::run);
    live::CardPort& port = open_port();
    check_offset(offset, false);
    const std::uint16_t word = port.read(offset);
    check_trouble();
    return word;
}

void LiveCard::write(std::uint32_t offset, std::int64_t value) {
    run_exclusive(*this, [&] {
        check_offset(offset, true);
        if (value < 0 || value > 0xFFFF)
            raise({ErrorKind::refused,
                   fmt::format("{} does not fit into 16 bits: 0 to 65535. Nothing was written.", value)});
        guarded_.write(offset, static_cast<std::uint16_t>(value));
    });
}

std::string LiveCard::view(bool clearing) {
    const RackLock turn(*this, RackLock::Access::run);
    const rack::RegisterView seen = rack::find_card_kind(map_.name)->view(open_port(), clearing);
    check_trouble();
    return rack::view_text(seen, false);
}

bool LiveCard::wait_interrupt(Duration timeout) {
    if (!open_port().has_interrupt())
        refuse(
            fmt::format("The card at {} has no interrupt here. Nothing was done. Open it with interrupt=PATH, or "
                        "look at its registers.",
                        place_));
    return run_exclusive(*this, [&] { return ears_.wait(timeout); });
}

}  // namespace motionrack::python
