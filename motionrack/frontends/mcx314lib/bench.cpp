// Opening, selecting and closing chips; time for all chips of a rack.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <motionrack/frontends/mcx314lib/bench.hpp>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::mcx314lib {

namespace {

constexpr const char* variable = "MOTIONRACK_RACK";
constexpr Duration look_every = milliseconds(1);
constexpr Duration most_at_once = nanoseconds(static_cast<std::int64_t>(rack::Session::most_ns));

bool is_mcx314(const rack::RackCard& card) {
    return card.type == "mcx314";
}

}  // namespace

bool Chip::step() {
    bool going_on = false;
    for (mcx314::Manual& manual : manuals) {
        manual.step(now());
        going_on = going_on || manual.state() != mcx314::ManualState::standing;
    }
    return going_on;
}

// ---- chips

bool Bench::is_open(const rack::Card& card) const {
    return std::any_of(chips_.begin(), chips_.end(), [&](const auto& chip) { return &chip.second->card == &card; });
}

Result<int> Bench::open(const char* rack, const char* card) {
    std::shared_ptr<rack::Session> world;
    if (rack != nullptr) {
        MOTIONRACK_TRY(world, rack::Session::open(rack));
    } else if (chips_.empty()) {
        const char* path = std::getenv(variable);
        if (path == nullptr || *path == '\0')
            return fail(
                Trouble::bad_input,
                fmt::format(
                    "No chip is open, and the environment variable {0} is not set. Nothing was done. Set {0} to "
                    "the path of a rack file with an mcx314 card, or call mcx314_open first.",
                    variable));
        MOTIONRACK_TRY(world, rack::Session::open(path));
    } else {
        MOTIONRACK_TRY(Chip * chip, selected());
        world = chip->session;
    }
    std::string known;
    for (const rack::RackCard& each : world->rack().config().cards) {
        if (!is_mcx314(each)) continue;
        rack::Card& found = *world->rack().card(each.name);
        known += (known.empty() ? "" : ", ") + each.name + (is_open(found) ? " (open already)" : "");
        if (is_open(found) || (card != nullptr && each.name != card)) continue;
        chips_.emplace(++last_, std::make_unique<Chip>(world, found));
        return selected_ = last_;
    }
    return fail(Trouble::bad_input, fmt::format("{}; its mcx314 cards are: {}. Nothing was opened.",
                                                card != nullptr ? fmt::format("The rack has no mcx314 card {} to open",
                                                                              rack::in_quotes(card))
                                                                : std::string("The rack has no mcx314 card to open"),
                                                known.empty() ? "none" : known));
}

std::string Bench::handles() const {
    std::string out;
    for (const auto& [handle, chip] : chips_) out += (out.empty() ? "" : ", ") + std::to_string(handle);
    return out.empty() ? "none" : out;
}

Result<void> Bench::check_open(int handle) const {
    if (chips_.count(handle) != 0) return {};
    return fail(
        Trouble::bad_input,
        fmt::format("There is no chip {}; the handles of the open ones are: {}. Nothing was done.", handle, handles()));
}

Result<void> Bench::select(int handle) {
    MOTIONRACK_CHECK(check_open(handle));
    selected_ = handle;
    return {};
}

Result<void> Bench::close(int handle) {
    MOTIONRACK_CHECK(check_open(handle));
    chips_.erase(handle);
    if (selected_ == handle) selected_ = 0;
    return {};
}

Result<Chip*> Bench::selected() {
    if (chips_.empty()) {
        const Result<int> opened = open(nullptr, nullptr);
        if (!opened) return tl::unexpected<Error>(opened.error());
    }
    if (selected_ == 0)
        return fail(
            Trouble::bad_input,
            fmt::format("No chip is selected: the last selected one was closed. Nothing was done. Call mcx314_select "
                        "with one of these handles: {}.",
                        handles()));
    return chips_.at(selected_).get();
}

// ---- time

bool Bench::step(const rack::Session& world) {
    bool going_on = false;
    for (auto& [handle, chip] : chips_)
        if (chip->session.get() == &world) going_on = chip->step() || going_on;
    return going_on;
}

Result<void> Bench::pass(Chip& chip, Duration duration) {
    rack::Session& world = *chip.session;
    const auto advance = [&](Duration time) {
        return world.advance(static_cast<std::uint64_t>(time / nanoseconds(1)));
    };
    const Instant end = later(chip.now(), duration);
    while (step(world) && chip.now() < end) MOTIONRACK_CHECK(advance(std::min(look_every, end - chip.now())));
    while (end - chip.now() >= nanoseconds(1)) MOTIONRACK_CHECK(advance(std::min(most_at_once, end - chip.now())));
    return {};
}

}  // namespace motionrack::mcx314lib
