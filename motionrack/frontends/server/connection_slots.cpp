// Assigns slots to connections and closes callers above the limit.
#include <algorithm>
#include <iterator>
#include <motionrack/frontends/server/connection_slots.hpp>
#include <vector>

namespace motionrack::server {

void ConnectionSlots::take_one(Counts& counts, const std::string& network) {
    const auto found = counts.find(network);
    if (found != counts.end() && --found->second == 0) counts.erase(found);
}

void ConnectionSlots::arrive(OpenConnection* open, const std::string& network) {
    if (callers_.size() >= limits_.callers) end_a_caller();
    callers_.push_back({open, network});
    caller_of_[open] = std::prev(callers_.end());
    ++callers_of_[network];
}

bool ConnectionSlots::take_slot(OpenConnection* open, const std::string& network) {
    if (slots_.count(open) != 0) return true;
    const auto there = slots_of_.find(network);
    if (slots_.size() >= limits_.connections || (there != slots_of_.end() && there->second >= limits_.of_a_network))
        return false;
    leave(open);
    slots_[open] = network;
    ++slots_of_[network];
    return true;
}

void ConnectionSlots::replace(OpenConnection* before, OpenConnection* open) {
    const auto slot = slots_.find(before);
    if (slot == slots_.end()) return;
    const std::string network = slot->second;
    slots_.erase(slot);
    slots_[open] = network;
}

void ConnectionSlots::leave(OpenConnection* open) {
    if (const auto caller = caller_of_.find(open); caller != caller_of_.end()) {
        take_one(callers_of_, caller->second->network);
        callers_.erase(caller->second);
        caller_of_.erase(caller);
    }
    if (const auto slot = slots_.find(open); slot != slots_.end()) {
        take_one(slots_of_, slot->second);
        slots_.erase(slot);
    }
}

bool ConnectionSlots::end_a_caller() {
    if (callers_.empty()) return false;
    const auto young = std::next(callers_.begin(), static_cast<std::ptrdiff_t>((callers_.size() + 3) / 4));
    const auto of_its_network = [&](const WaitingCaller& caller) { return callers_of_.find(caller.network)->second; };
    const auto ended = std::max_element(callers_.begin(), young, [&](const WaitingCaller& a, const WaitingCaller& b) {
        return of_its_network(a) < of_its_network(b);
    });
    OpenConnection* const open = ended->open;
    open->end("Connection limit reached. This connection was closed in favour of a newer one.");
    leave(open);
    return true;
}

void ConnectionSlots::end_all(std::string_view why) {
    std::vector<OpenConnection*> all;  // copied, because each connection removes itself when it ends
    for (const auto& [open, network] : slots_) all.push_back(open);
    for (const WaitingCaller& caller : callers_) all.push_back(caller.open);
    for (OpenConnection* open : all) open->end(why);
}

}  // namespace motionrack::server
