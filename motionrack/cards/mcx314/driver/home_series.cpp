// Loops around Home that advance the port's time.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/cards/mcx314/driver/home_series.hpp>

namespace motionrack::mcx314 {

namespace {

bool any_running(std::span<Home* const> homes) {
    return std::any_of(homes.begin(), homes.end(), [](const Home* home) { return home->running(); });
}

std::int64_t spread_of(const std::vector<std::int64_t>& values) {
    const auto [min, max] = std::minmax_element(values.begin(), values.end());
    return *max - *min;
}

Result<std::vector<HomeReport>> home_axes(Driver& driver, int type, unsigned axes, unsigned wr1, std::int64_t sv,
                                          std::int64_t v, std::int64_t a) {
    if (axes == 0 || axes > xyzu)
        return fail(ErrorKind::refused,
                    fmt::format("HomeType{}: the axis mask {} names no axes; X is 1, Y 2, Z 4, U 8 and sums of these. "
                                "Nothing was moved.",
                                type, axes));
    MOTIONRACK_TRY(const HomeSettings settings, home_settings(type, wr1, sv, v, a));
    std::vector<Home> homes;
    for (const int i : channels_of(axes)) homes.emplace_back(driver, i);
    std::vector<Home*> started;
    Result<void> refused;
    for (Home& home : homes) {
        refused = home.start(settings, driver.interrupt().now());
        if (!refused) break;
        started.push_back(&home);
    }
    if (!refused)
        for (Home* home : started) home->stop();
    const Result<void> ended = started.empty() ? Result<void>{} : finish_homes(started, whole_seconds(3600));
    MOTIONRACK_CHECK(refused);
    MOTIONRACK_CHECK(ended);
    std::vector<HomeReport> out;
    out.reserve(homes.size());
    for (const Home& home : homes) out.push_back(home.report());
    return out;
}

}  // namespace

Result<void> finish_homes(std::span<Home* const> homes, Duration timeout, const std::function<void()>& seen) {
    Driver& driver = homes.front()->driver();
    Interrupt& host = driver.interrupt();
    const Instant end = later(host.now(), timeout);
    bool stopped = false;
    const Home* first_failed = nullptr;
    while (any_running(homes)) {
        for (Home* home : homes) {
            const bool ran = home->running();
            home->step(host.now());
            if (ran && !home->running() && !home->homed() && first_failed == nullptr) first_failed = home;
        }
        if (seen) seen();
        if (!stopped && (first_failed != nullptr || host.stop_requested() || host.now() >= end)) {
            stopped = true;
            for (Home* home : homes) home->stop();
        }
        if (!any_running(homes)) break;
        // The interrupt of a drive's end wakes at once. It is read so that the line becomes inactive.
        const Instant before = host.now();
        const bool woken = host.wait(home_look_every);
        bool ours = false;
        if (woken)
            for (const Home* home : homes) ours = driver.read_interrupts(home->axis()) != 0 || ours;
        if (!ours && host.now() == before) host.pass(home_look_every);
    }
    return first_failed == nullptr ? Result<void>{} : first_failed->report().result();
}

Result<HomeReport> home(Driver& driver, int axis, const HomeSettings& settings, Duration timeout) {
    Home one(driver, axis);
    MOTIONRACK_CHECK(one.start(settings, driver.interrupt().now()));
    Home* const homes[] = {&one};
    MOTIONRACK_CHECK(finish_homes(homes, timeout));
    return one.report();
}

Result<HomeSpread> repeat_home(Driver& driver, int axis, const HomeSettings& settings, int repeats,
                               std::span<const std::int64_t> away, Duration timeout) {
    MOTIONRACK_CHECK(Driver::check_channel(axis, "repeat_home"));
    const unsigned mask = 1u << axis;
    const bool fine =
        repeats >= 1 && !away.empty() && std::all_of(away.begin(), away.end(), [](std::int64_t p) { return p > 0; });
    if (!fine)
        return fail(ErrorKind::refused,
                    "repeat_home: it needs at least one repeat, and distances from home above 0. Nothing was moved.");
    MOTIONRACK_TRY(const HomeReport first, home(driver, axis, settings, timeout));
    HomeSpread out;
    out.pulses.push_back(0);
    out.counts.push_back(0);
    out.last = first;
    for (int i = 0; i < repeats; ++i) {
        MOTIONRACK_CHECK(driver.SetV(mask, settings.v));
        MOTIONRACK_CHECK(driver.Pulse(mask, away[static_cast<std::size_t>(i) % away.size()]));
        driver.Drive(mask, !settings.negative);
        MOTIONRACK_CHECK(driver.wait_until_done(mask, timeout));
        MOTIONRACK_TRY(HomeReport again, home(driver, axis, settings, timeout));
        out.last = std::move(again);
        out.pulses.push_back(out.last.zero_lp - settings.home_position);
        out.counts.push_back(out.last.zero_ep - settings.home_counts);
    }
    out.spread = spread_of(out.pulses);
    out.counts_spread = spread_of(out.counts);
    return out;
}

Result<std::vector<HomeReport>> HomeType1(Driver& driver, unsigned axes, unsigned WR1Reg, std::int64_t SV,
                                          std::int64_t V, std::int64_t A) {
    return home_axes(driver, 1, axes, WR1Reg, SV, V, A);
}
Result<std::vector<HomeReport>> HomeType2(Driver& driver, unsigned axes, unsigned WR1Reg, std::int64_t SV,
                                          std::int64_t V, std::int64_t A) {
    return home_axes(driver, 2, axes, WR1Reg, SV, V, A);
}
Result<std::vector<HomeReport>> HomeType3(Driver& driver, unsigned axes, unsigned WR1Reg, std::int64_t SV,
                                          std::int64_t V, std::int64_t A) {
    return home_axes(driver, 3, axes, WR1Reg, SV, V, A);
}
Result<std::vector<HomeReport>> HomeType4(Driver& driver, unsigned axes, unsigned WR1Reg, std::int64_t SV,
                                          std::int64_t V, std::int64_t A) {
    return home_axes(driver, 4, axes, WR1Reg, SV, V, A);
}

}  // namespace motionrack::mcx314
