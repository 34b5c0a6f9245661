// Who has a rack, and Ctrl-C.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <motionrack/rack/bus_access.hpp>
#include <python/src/turn.hpp>

namespace motionrack::python {

namespace {

/// What Python raised while worlds ran without its lock; touched with the lock only.
std::vector<std::pair<const World*, py::error_already_set>>& raised_meanwhile() {
    // It outlives the interpreter.
    // NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): what is raised is put there
    static auto* const all = new std::vector<std::pair<const World*, py::error_already_set>>();
    return *all;
}

}  // namespace

Turn::Turn(World& world, For what) : world_(world) {
    const std::thread::id me = std::this_thread::get_id();
    std::thread::id nobody{};
    if (world_.owner.compare_exchange_strong(nobody, me)) {
        mine_ = true;
        return;
    }
    if (nobody != me) refuse("Another thread is running this rack; nothing was done. One thread at a time.");
    if (what == For::moving)
        refuse("The rack is in the middle of a run; nothing was done. A progress call may look, not move.");
}

Turn::~Turn() {
    if (mine_) world_.owner = std::thread::id{};
}

Duration duration(double seconds) {
    if (std::isinf(seconds) && seconds > 0) return never;
    if (!(seconds >= 0 && seconds <= 9e8))
        refuse(fmt::format("A time is {} s; it is 0 to 9e8 s, or infinite. Nothing was done.", seconds));
    return from_seconds(seconds);
}

rack::Card& card_of_type(World& world, const std::string& name, std::string_view type) {
    rack::Card& card = *value_of(rack::card_named(world.running(), name));
    for (const rack::RackCard& config : world.config().cards)
        if (config.name == name && config.type != type)
            refuse(
                fmt::format("Card {} is of type {}, not {}; this function library does not drive it. Nothing was done.",
                            name, config.type, type));
    return card;
}

void attend(World& world) {
    using Clock = std::chrono::steady_clock;
    world.on_look([&world, last = Clock::time_point{}]() mutable {
        const auto present = Clock::now();  // a run of many short slices does not ask every time
        if (present - last < std::chrono::milliseconds(20)) return;
        last = present;
        const py::gil_scoped_acquire lock;
        if (PyErr_CheckSignals() != 0) stop_because(world, py::error_already_set());
    });
}

void stop_because(World& world, py::error_already_set error) {
    if (!world.stopped()) raised_meanwhile().emplace_back(&world, std::move(error));
    world.stop();
}

void raise_what_python_raised(World& world) {
    world.go_on();
    auto& all = raised_meanwhile();
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].first != &world) continue;
        py::error_already_set error = all[i].second;
        all.erase(all.begin() + static_cast<std::ptrdiff_t>(i));
        throw error;
    }
}

}  // namespace motionrack::python
