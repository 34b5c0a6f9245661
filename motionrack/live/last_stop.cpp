// The list of cards that drive on when this program ends.
#include <atomic>
#include <cstdlib>
#include <motionrack/live/last_stop.hpp>
#include <mutex>
#include <utility>

namespace motionrack::live {

namespace {

constexpr int stop_writes = 2;

// A terminate handler can only reach globals.
// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables)
std::mutex listed_cards_lock;
LastStop* listed_cards = nullptr;
std::terminate_handler after_last_stop = nullptr;
std::atomic<bool> program_ends = false;
thread_local bool stops_cards = false;  // a stop that ends the program itself must not wait for its own lock
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)

void stop_listed(FunctionLibrary& library) {
    try {
        library.stop_now();
    } catch (...) {
        return;  // the computer refused the access, and the sentence needs memory
    }
}

[[noreturn]] void stop_and_end() {
    program_ends = true;
    if (!std::exchange(stops_cards, true)) stop_live_cards();
    after_last_stop();
    std::abort();
}

}  // namespace

LastStop::LastStop(FunctionLibrary& library) : library_(library), next_(nullptr) {
    const std::lock_guard<std::mutex> alone(listed_cards_lock);
    next_ = listed_cards;
    listed_cards = this;
}

LastStop::~LastStop() {
    const std::lock_guard<std::mutex> alone(listed_cards_lock);
    LastStop** at = &listed_cards;
    while (*at != this) at = &(*at)->next_;
    *at = next_;
}

bool is_program_ending() {
    return program_ends;
}

void stop_live_cards() noexcept {
    const std::lock_guard<std::mutex> alone(listed_cards_lock);
    for (LastStop* card = listed_cards; card != nullptr; card = card->next_)
        for (int i = 0; i < stop_writes; ++i) stop_listed(card->library_);
}

void stop_live_cards_at_terminate(std::terminate_handler then) {
    after_last_stop = then;
    std::set_terminate(stop_and_end);
}

}  // namespace motionrack::live
