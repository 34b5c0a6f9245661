// Ownership of a rack, and Ctrl-C.
#include <fmt/format.h>

#include <cmath>
#include <motionrack/rack/bus_access.hpp>
#include <python/src/rack_lock.hpp>

namespace motionrack::python {

namespace {

/// Python exceptions raised while racks ran without the GIL; accessed with the GIL only.
std::vector<std::pair<const Host*, py::error_already_set>>& raised_meanwhile() {
    // Outlives the interpreter.
    // NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): stores raised exceptions
    static auto* const all = new std::vector<std::pair<const Host*, py::error_already_set>>();
    return *all;
}

}  // namespace

RackLock::RackLock(Host& host, Access what) : host_(host) {
    const std::thread::id me = std::this_thread::get_id();
    std::thread::id now{};
    if (host_.owner.compare_exchange_strong(now, me)) {
        mine_ = true;
        return;
    }
    if (what == Access::stop) {
        wait(me);
        return;
    }
    if (now != me) refuse("Another thread is using this rack or card. Nothing was done. One thread at a time.");
    if (what == Access::run)
        refuse("The rack or card is in the middle of a run. Nothing was done. A progress call may read, not move.");
}

void RackLock::wait(std::thread::id me) {
    const py::gil_scoped_release free;
    for (std::thread::id none{}; !host_.owner.compare_exchange_weak(none, me); none = {})
        std::this_thread::sleep_for(std::chrono::microseconds(100));
    mine_ = true;
}

RackLock::~RackLock() {
    if (mine_) host_.owner = std::thread::id{};
}

Duration timeout_of(std::int64_t count) {
    if (count < 0)
        refuse(fmt::format("The time-out is {:.9g} s; it must be 0 to 9e8 s. Nothing was done.",
                           to_seconds(Duration{count})));
    return Duration{count};
}

Duration duration(double seconds) {
    if (std::isinf(seconds) && seconds > 0) return never;
    if (!(seconds >= 0 && seconds <= 9e8))
        refuse(fmt::format("A time is {} s; it must be 0 to 9e8 s, or infinite. Nothing was done.", seconds));
    return from_seconds(seconds);
}

rack::Card& card_of_type(RackHandle& world, const std::string& name, std::string_view type) {
    rack::Card& card = *value_of(rack::card_named(world.running(), name));
    for (const rack::RackCard& config : world.config().cards)
        if (config.name == name && config.type != type)
            refuse(
                fmt::format("Card {} is of type {}, not {}; this function library does not drive it. Nothing was done.",
                            name, config.type, type));
    return card;
}

void SignalPoll::poll(Host& host) {
    const auto present = std::chrono::steady_clock::now();  // limits the checks in a run of many short slices
    if (present - last_ < std::chrono::milliseconds(20)) return;
    last_ = present;
    const py::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) abort_run(host, py::error_already_set());
}

void poll_python(RackHandle& world) {
    world.on_poll([&world, signals = SignalPoll()]() mutable { signals.poll(world); });
}

void abort_run(Host& host, py::error_already_set error) {
    host.stop();
    for (const auto& [which, raised] : raised_meanwhile())
        if (which == &host) return;  // keeps the first, which ended the run
    raised_meanwhile().emplace_back(&host, std::move(error));
}

void end_call(Host& host) {
    auto& all = raised_meanwhile();
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].first != &host) continue;
        py::error_already_set error = all[i].second;
        all.erase(all.begin() + static_cast<std::ptrdiff_t>(i));
        try {
            host.end_call();
        } catch (const PythonError&) {  // the next call throws it again
        }
        throw error;
    }
    host.end_call();
}

}  // namespace motionrack::python
