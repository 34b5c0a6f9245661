// Opens, selects and closes chips; advances time for all chips of a rack.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/cards/mcx314/map.hpp>
#include <motionrack/frontends/mcx314lib/chip_table.hpp>
#include <motionrack/frontends/mcx314lib/environment.hpp>
#include <motionrack/live/open_card.hpp>

namespace motionrack::mcx314lib {

namespace {

constexpr const char* variable = "MOTIONRACK_RACK";
constexpr Duration poll_period = milliseconds(1);
constexpr Duration max_at_once = nanoseconds(static_cast<std::int64_t>(VirtualRack::max_ns));

}  // namespace

bool OpenChip::step() {
    bool going_on = false;
    for (mcx314::Manual& manual : manuals) {
        manual.step(now());
        going_on = going_on || manual.state() != mcx314::ManualState::standing;
    }
    return going_on;
}

Result<void> OpenChip::check_live() const {
    if (live && live->trouble()) return tl::unexpected<Error>(*live->trouble());
    return {};
}

Result<VirtualCard*> OpenChip::virtual_card(const char* what) const {
    if (card != nullptr) return card;
    return fail(ErrorKind::refused,
                fmt::format("The selected chip is a real card, which has no {} here. Nothing was done.", what));
}

// ---- chips

int ChipTable::keep(std::unique_ptr<OpenChip> chip) {
    chips_.emplace(++last_, std::move(chip));
    return selected_ = last_;
}

Result<int> ChipTable::open_live(const char* text, const char* card) {
    if (card != nullptr)
        return fail(ErrorKind::invalid_input,
                    fmt::format("A real card has no name, but the name {} was given. Nothing was opened. Give NULL.",
                                in_quotes(card)));
    MOTIONRACK_TRY(auto port, live::open_card_at<live::CardPort>(text, mcx314::card_map()));
    MOTIONRACK_CHECK(port->check_answers());
    return keep(std::make_unique<OpenChip>(std::move(port)));
}

bool ChipTable::is_open(const VirtualCard& card) const {
    return std::any_of(chips_.begin(), chips_.end(), [&](const auto& chip) { return chip.second->card == &card; });
}

Result<int> ChipTable::open(const char* rack, const char* card) {
    std::shared_ptr<VirtualRack> found;
    if (rack != nullptr) {
        if (live::names_real_card(rack)) return open_live(rack, card);
        MOTIONRACK_TRY(found, VirtualRack::open(rack));
    } else if (chips_.empty()) {
        const std::string path = environment_variable(variable);
        if (path.empty())
            return fail(
                ErrorKind::invalid_input,
                fmt::format(
                    "No chip is open, and the environment variable {0} is not set. Nothing was done. Set {0} to "
                    "the path of a rack file with an mcx314 card, or to a real card ({1}), or call mcx314_open "
                    "first.",
                    variable, live::port_spec_form()));
        if (live::names_real_card(path)) return open_live(path.c_str(), card);
        MOTIONRACK_TRY(found, VirtualRack::open(path));
    } else {
        MOTIONRACK_TRY(OpenChip * chip, selected());
        if (!chip->rack)
            return fail(ErrorKind::invalid_input,
                        "The selected chip is a real card outside a rack. Nothing was opened. Name a rack.");
        found = chip->rack;
    }
    std::string known;
    for (VirtualCard* const each : found->cards()) {
        known += (known.empty() ? "" : ", ") + each->name() + (is_open(*each) ? " (open already)" : "");
        if (is_open(*each) || (card != nullptr && each->name() != card)) continue;
        return keep(std::make_unique<OpenChip>(found, *each));
    }
    return fail(ErrorKind::invalid_input,
                fmt::format("{}; its mcx314 cards are: {}. Nothing was opened.",
                            card != nullptr ? fmt::format("The rack has no mcx314 card {} to open", in_quotes(card))
                                            : std::string("The rack has no mcx314 card to open"),
                            known.empty() ? "none" : known));
}

std::string ChipTable::handles() const {
    std::string out;
    for (const auto& [handle, chip] : chips_) out += (out.empty() ? "" : ", ") + std::to_string(handle);
    return out.empty() ? "none" : out;
}

Result<void> ChipTable::check_open(int handle) const {
    if (chips_.count(handle) != 0) return {};
    return fail(ErrorKind::invalid_input,
                fmt::format("Unknown chip handle {}; the handles of the open chips are: {}. Nothing was done.", handle,
                            handles()));
}

Result<void> ChipTable::select(int handle) {
    MOTIONRACK_CHECK(check_open(handle));
    selected_ = handle;
    return {};
}

Result<void> ChipTable::close(int handle) {
    MOTIONRACK_CHECK(check_open(handle));
    chips_.erase(handle);
    if (selected_ == handle) selected_ = 0;
    return {};
}

Result<OpenChip*> ChipTable::selected() {
    if (chips_.empty()) {
        const Result<int> opened = open(nullptr, nullptr);
        if (!opened) return tl::unexpected<Error>(opened.error());
    }
    if (selected_ == 0)
        return fail(
            ErrorKind::invalid_input,
            fmt::format("No chip is selected: the last selected one was closed. Nothing was done. Call mcx314_select "
                        "with one of these handles: {}.",
                        handles()));
    return chips_.at(selected_).get();
}

// ---- time

bool ChipTable::step_all_beside(OpenChip& chip) {
    bool going_on = false;
    for (auto& [handle, other] : chips_)
        if (other->rack == chip.rack) going_on = other->step() || going_on;
    return going_on;
}

Result<void> ChipTable::pass(OpenChip& chip, Duration duration) {
    MOTIONRACK_CHECK(chip.check_live());
    const auto advance = [&](Duration time) -> Result<void> {
        if (chip.rack) return chip.rack->advance(static_cast<std::uint64_t>(time / nanoseconds(1)));
        chip.live->pass(time);
        return {};
    };
    const Instant end = later(chip.now(), duration);
    while (step_all_beside(chip) && chip.now() < end)
        MOTIONRACK_CHECK(advance(std::min(poll_period, end - chip.now())));
    while (end - chip.now() >= nanoseconds(1)) MOTIONRACK_CHECK(advance(std::min(max_at_once, end - chip.now())));
    return {};
}

}  // namespace motionrack::mcx314lib
