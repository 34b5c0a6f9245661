// Opens and closes cards.
#include <fmt/format.h>

#include <cstdlib>
#include <motionrack/frontends/databoard4002lib/card_table.hpp>
#include <motionrack/live/open_card.hpp>
#include <string>
#include <vector>

namespace motionrack::databoard4002lib {

namespace {

constexpr const char* variable = "MOTIONRACK_RACK";
constexpr int max_number = 255;

std::string listed(const std::vector<std::int64_t>& numbers) {
    return numbers.empty() ? "none" : fmt::format("{}", fmt::join(numbers, ", "));
}

Result<std::shared_ptr<DataboardBus>> open_bus(std::string_view place) {
    auto bus = std::make_shared<DataboardBus>();
    if (live::names_real_card(place)) {
        MOTIONRACK_TRY(bus->port, live::open_card_at<live::ByteCardPort>(place, databoard4002::card_map()));
    } else {
        MOTIONRACK_TRY(bus->session, rack::Session::open(place));
    }
    return bus;
}

Result<std::shared_ptr<OpenDataboard>> card_on(const std::shared_ptr<DataboardBus>& bus, int number) {
    const auto select = static_cast<std::uint8_t>(number);
    if (bus->port) return std::make_shared<OpenDataboard>(bus, nullptr, *bus->port, *bus->port, select);
    rack::Rack& rack = bus->session->rack();
    std::vector<std::int64_t> known;
    for (const rack::RackCard& each : rack.config().cards) {
        if (each.type != "databoard4002") continue;
        if (rack::bus_select(each) == number) {
            rack::Card* const card = rack.card(each.name);
            sim::VirtualBytePort& port = *card->byte_port();
            return std::make_shared<OpenDataboard>(bus, card, port, port, select);
        }
        known.push_back(rack::bus_select(each));
    }
    return fail(
        ErrorKind::invalid_input,
        fmt::format("The rack has no databoard4002 with the number {}; the numbers of those it has: {}. Nothing "
                    "was opened.",
                    number, listed(known)));
}

}  // namespace

// ---- stops

void StopFlags::add(int handle, std::shared_ptr<std::atomic<bool>> flag) {
    const std::lock_guard<std::mutex> alone(lock_);
    flags_[handle] = std::move(flag);
}

void StopFlags::remove(int handle) {
    const std::lock_guard<std::mutex> alone(lock_);
    flags_.erase(handle);
}

void StopFlags::set(int handle) {
    const std::lock_guard<std::mutex> alone(lock_);
    if (const auto found = flags_.find(handle); found != flags_.end()) found->second->store(true);
}

StopFlags& stop_flags() {
    static StopFlags one;
    return one;
}

// ---- accesses

void TurnLock::lock() {
    std::unique_lock<std::mutex> alone(lock_);
    const std::uint64_t ticket = last_ticket_++;
    next_.wait(alone, [&] { return turn_ == ticket; });
}

void TurnLock::unlock() {
    {
        const std::lock_guard<std::mutex> alone(lock_);
        ++turn_;
    }
    next_.notify_all();
}

void StoppableTime::pass(Duration duration) {
    bus_.accesses.unlock();
    if (bus_.port) inner_.pass(duration);
    bus_.accesses.lock();
    if (!bus_.port) inner_.pass(duration);  // it runs the rack
}

// ---- the table

Result<std::shared_ptr<DataboardBus>> DataboardTable::bus_at(const char* place) const {
    if (place != nullptr) return open_bus(place);
    if (!cards_.empty()) return cards_.rbegin()->second->shared_bus();
    const char* const named = std::getenv(variable);
    if (named != nullptr && *named != '\0') return open_bus(named);
    return fail(
        ErrorKind::invalid_input,
        fmt::format("No card is open, and the environment variable {0} is not set. Nothing was opened. Give the "
                    "place, or set {0} to the path of a rack file with a databoard4002 card, or to a real card "
                    "({1}).",
                    variable, live::port_spec_form()));
}

Result<int> DataboardTable::open(const char* place, int number) {
    if (number < 0 || number > max_number)
        return fail(
            ErrorKind::invalid_input,
            fmt::format("The card's number is {}; it must be 0 to {}. Nothing was opened.", number, max_number));
    MOTIONRACK_TRY(const std::shared_ptr<DataboardBus> bus, bus_at(place));
    for (const auto& [handle, card] : cards_)
        if (card->shared_bus() == bus && card->number() == number)
            return fail(ErrorKind::refused,
                        fmt::format("Card {} of this bus is open already; its handle is {}. Nothing "
                                    "was opened.",
                                    number, handle));
    MOTIONRACK_TRY(std::shared_ptr<OpenDataboard> card, card_on(bus, number));
    {
        const std::lock_guard<TurnLock> alone(bus->accesses);
        MOTIONRACK_CHECK(card->connect());
    }
    stop_flags().add(++last_, card->stop_flag());
    cards_.emplace(last_, std::move(card));
    return last_;
}

Result<std::shared_ptr<OpenDataboard>> DataboardTable::find(int handle) const {
    if (const auto found = cards_.find(handle); found != cards_.end()) return found->second;
    std::vector<std::int64_t> known;
    for (const auto& [each, card] : cards_) known.push_back(each);
    return fail(ErrorKind::invalid_input,
                fmt::format("Unknown card handle {}; the handles of the open cards are: {}. Nothing was done.", handle,
                            listed(known)));
}

void DataboardTable::close(int handle) {
    stop_flags().remove(handle);
    cards_.erase(handle);
}

}  // namespace motionrack::databoard4002lib
