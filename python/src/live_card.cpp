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

const rack::CardPlugin& plugin_of(const std::string& type) {
    return *value_of(rack::find_live_plugin(type));
}

std::unique_ptr<LiveDevice> device_at(const std::string& place, const rack::CardPlugin& plugin, Interrupt& host,
                                      int select) {
    const live::PortSpec spec = value_of(live::read_port_spec(place));
    if (plugin.type.name == "mcx314") return value_of(LiveMcx314::open(spec, host));
    if (select < 0 || select > 255)
        raise({ErrorKind::invalid_input,
               fmt::format("The card's number is {}; it must be 0 to 255. Nothing was opened.", select)});
    return value_of(LiveDataboard4002::open(spec, host, static_cast<std::uint8_t>(select)));
}

}  // namespace

LiveCard::LiveCard(const std::string& place, const std::string& type, int select)
    : place_(place), map_(plugin_of(type).map()), device_(device_at(place, plugin_of(type), host_, select)) {}

LiveCard::~LiveCard() {
    if (!closed()) static_cast<void>(device_->stop());
}

LiveDevice& LiveCard::open_device() const {
    if (closed()) refuse(fmt::format("The card at {} was closed. Nothing was done. Open it again.", place_));
    return *device_;
}

void LiveCard::refuse_device(const char* who) const {
    refuse(fmt::format("The card at {} is a {}, which has no {}. Nothing was done.", place_, map_.name, who));
}

void LiveCard::check_call() const {
    open_device();
    check_trouble();
    if (stopped())
        raise({ErrorKind::stopped, fmt::format("The card at {} was stopped, and the stop holds. Nothing was done. Call "
                                               "reset_stop() once it may move again.",
                                               place_)});
}

void LiveCard::check_trouble() const {
    if (device_->port().trouble()) raise(*device_->port().trouble());
}

// ---- stops

void LiveCard::end_call() {
    const Result<void> done = stopped() ? device_->stop() : Result<void>{};
    check_trouble();
    if (!done) raise(done.error());
}

void LiveCard::quick_stop() {
    if (closed()) return;
    stop();
    if (owner.load() == std::this_thread::get_id()) return;  // in a signal handler: the stop ends the call
    const RackLock turn(*this, RackLock::Access::stop);
    if (closed()) return;
    const Result<void> done = device_->stop();
    check_trouble();
    if (!done) raise(done.error());
}

void LiveCard::close() {
    if (closed()) return;
    if (owner.load() == std::this_thread::get_id())
        refuse(fmt::format("The card at {} is in the middle of a call. Nothing was closed. Stop it by quick_stop().",
                           place_));
    stop();
    const RackLock turn(*this, RackLock::Access::stop);
    if (closed()) return;
    const Result<void> done = device_->stop();
    const std::optional<Error> trouble = device_->port().trouble();
    device_.reset();
    if (trouble) raise(*trouble);
    if (!done) raise(done.error());
}

// ---- drivers

void LiveCard::claim(const std::string& driver) {
    open_device();
    if (!driver_.empty())
        refuse(
            fmt::format("The card at {} is driven by its {}, and a second driver would not know what that has set. "
                        "Nothing was done. Use the first, or close the card and open it again.",
                        place_, driver_));
    driver_ = driver;
}

bool LiveCard::RealTimeHost::wait(Duration timeout) {
    const Instant end = later(now(), timeout);
    while (true) {
        signals_.poll(card_);
        const Duration left = end - now();
        if (card_.device_->port().wait(std::clamp(left, Duration{0}, listen_every))) return true;
        if (left <= listen_every || stop_requested()) return false;
    }
}

void LiveCard::RealTimeHost::pass(Duration duration) {
    const Instant end = later(now(), duration);
    do {
        signals_.poll(card_);
        card_.device_->port().pass(std::clamp(end - now(), Duration{0}, listen_every));
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
    LiveDevice& device = open_device();
    check_offset(offset, false);
    const std::uint16_t word = device.read(offset);
    check_trouble();
    return word;
}

void LiveCard::write(std::uint32_t offset, std::int64_t value) {
    run_exclusive(*this, [&] {
        check_offset(offset, true);
        const int bits = device_->width();
        if (value < 0 || value >> bits != 0)
            raise({ErrorKind::refused, fmt::format("{} does not fit into {} bits: 0 to {}. Nothing was written.", value,
                                                   bits, (1 << bits) - 1)});
        device_->write(offset, static_cast<std::uint16_t>(value));
    });
}

std::string LiveCard::view(bool clearing) {
    const RackLock turn(*this, RackLock::Access::run);
    const Result<rack::RegisterView> seen = open_device().view(clearing);
    check_trouble();
    return rack::view_text(value_of(seen), false);
}

bool LiveCard::wait_interrupt(Duration timeout) {
    if (!open_device().port().has_interrupt())
        refuse(
            fmt::format("The card at {} has no interrupt here. Nothing was done. Open it with interrupt=PATH, or "
                        "look at its registers.",
                        place_));
    return run_exclusive(*this, [&] { return host_.wait(timeout); });
}

}  // namespace motionrack::python
