// Virtual rack of the library with chips only. From a rack file it reads the cards, "card.NAME = "mcx314"", one per
// line. Inputs are inactive until set_wire forces them. With a single card, its pulses are counted in its EP; with
// several, pulses have no effect.
//
//  text ──► names ──► Chip and VirtualPort each, with the timing of a rack's card ──► one Kernel
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <motionrack/base/read_whole_file.hpp>
#include <motionrack/cards/mcx314/chip/by_name.hpp>
#include <motionrack/cards/mcx314/chip/chip.hpp>
#include <motionrack/cards/mcx314/map.hpp>
#include <motionrack/frontends/mcx314lib/virtual_rack.hpp>
#include <motionrack/sim/virtual_port.hpp>

namespace motionrack::mcx314lib {

namespace {

constexpr Duration bus_access = nanoseconds(250), host_latency = microseconds(50);
constexpr Instant latest{never.count() / 2};
constexpr std::size_t max_cards = 21, max_name = 32;
constexpr int axis_count = 4;

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(" \t\r"), end = text.find_last_not_of(" \t\r");
    return begin == std::string_view::npos ? std::string_view{} : text.substr(begin, end - begin + 1);
}

bool is_name(std::string_view name) {
    return !name.empty() && name.size() <= max_name && std::all_of(name.begin(), name.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    });
}

/// Returns the name in "card.NAME = "mcx314""; empty for any other line.
std::string_view card_in(std::string_view line) {
    constexpr std::string_view start = "card.", type = "\"mcx314\"";
    const std::size_t equals = line.find('=');
    if (!line.starts_with(start) || equals == std::string_view::npos || trimmed(line.substr(equals + 1)) != type)
        return {};
    const std::string_view name = trimmed(line.substr(start.size(), equals - start.size()));
    return is_name(name) ? name : std::string_view{};
}

tl::unexpected<Error> wrong(std::string message, std::string_view file, int line) {
    return fail(ErrorKind::invalid_input, std::move(message), TextPosition{line, 1}, std::string(file));
}

Result<std::vector<std::string>> read_cards(std::string_view text, std::string_view file) {
    std::vector<std::string> names;
    for (int number = 1; !text.empty(); ++number) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        line = trimmed(line.substr(0, line.find('#')));
        if (line.empty()) continue;
        const std::string name(card_in(line));
        if (name.empty())
            return wrong(
                fmt::format("The library for Windows accepts only cards, card.NAME = \"mcx314\", a line each, not "
                            "{}. Nothing was opened. Leave that out, or run the rack on Linux.",
                            in_quotes(line)),
                file, number);
        if (std::find(names.begin(), names.end(), name) != names.end())
            return wrong(fmt::format("Two cards have the name {}. Nothing was opened. Rename one.", name), file,
                         number);
        if (names.size() == max_cards)
            return wrong(fmt::format("The rack has more than {} cards. Nothing was opened. Remove some.", max_cards),
                         file, number);
        names.push_back(name);
    }
    if (names.empty())
        return wrong("The file has no card. Nothing was opened. Add one, such as card.c1 = \"mcx314\".", file, 1);
    return names;
}

class LoneCard final : public VirtualCard {
  public:
    LoneCard(sim::Kernel& kernel, const std::string& name, bool with_encoders)
        : kernel_(kernel),
          name_(name),
          chip_(kernel, name),
          port_(kernel, chip_, chip_.id(), chip_.interrupt_wire(), bus_access),
          with_encoders_(with_encoders) {
        port_.set_latency(host_latency);
        for (int axis = 0; with_encoders && axis < axis_count; ++axis) chip_.connect_encoder(axis, chip_.pulses(axis));
    }
    const std::string& name() const override { return name_; }
    RegisterPort& registers() override { return port_; }
    Interrupt& interrupt() override { return port_; }
    Result<std::int64_t> inspect(std::string_view name) const override;
    /// Forces an input to 0 or 1, or releases it (NaN). An encoder is disconnected while one of its two inputs is
    /// forced.
    void drive(std::string_view pin, double level);

  private:
    sim::Kernel& kernel_;
    std::string name_;
    mcx314::Chip chip_;
    sim::VirtualPort port_;
    bool with_encoders_;
    std::array<unsigned, axis_count> driven_{};  // of each encoder's inputs, bit 0: A, bit 1: B
};

void LoneCard::drive(std::string_view pin, double level) {
    const sim::WireId wire = kernel_.find_wire(fmt::format("{}.{}", name_, pin));
    const bool released = std::isnan(level);
    if (!with_encoders_ || (!pin.ends_with("eca") && !pin.ends_with("ecb")))
        return released ? kernel_.release(wire) : kernel_.force(wire, static_cast<int>(level));
    const std::size_t axis = std::string_view("xyzu").find(pin.front());
    const unsigned before = driven_[axis], track = pin.ends_with("eca") ? 1U : 2U;
    driven_[axis] = released ? before & ~track : before | track;
    if ((before == 0) != (driven_[axis] == 0)) {
        chip_.take_encoder(static_cast<int>(axis), before == 0);
        kernel_.settle();
    }
    if (!released) kernel_.force(wire, static_cast<int>(level));
}

Result<std::int64_t> LoneCard::inspect(std::string_view name) const {
    return mcx314::value_by_name(chip_, mcx314::card_map(), name_, name, in_quotes(name));
}

class ChipsAlone final : public VirtualRack {
  public:
    explicit ChipsAlone(const std::vector<std::string>& names) {
        for (const std::string& name : names)
            cards_.push_back(std::make_unique<LoneCard>(kernel_, name, names.size() == 1));
        kernel_.start();
    }
    std::vector<VirtualCard*> cards() override {
        std::vector<VirtualCard*> out;
        for (const auto& card : cards_) out.push_back(card.get());
        return out;
    }
    Result<void> advance(std::uint64_t ns) override;
    Result<void> set_wire(std::string_view name, double value) override;

  private:
    sim::Kernel kernel_;
    std::vector<std::unique_ptr<LoneCard>> cards_;
};

Result<void> ChipsAlone::advance(std::uint64_t ns) {
    const Duration time = nanoseconds(static_cast<std::int64_t>(std::min(ns, max_ns)));
    if (ns > max_ns || kernel_.now() > latest - time)
        return fail(
            ErrorKind::refused,
            fmt::format("{} ns exceed the limit of a call, or the end of time: it is {:.0f} s. Nothing was run. "
                        "Open the card again.",
                        ns, to_seconds(kernel_.now())));
    const Instant until = kernel_.now() + time;
    do {
        static_cast<void>(kernel_.run_until(until));
    } while (kernel_.now() < until);
    return {};
}

/// Inputs: "c1.xlmtp"; "estop" is the emergency stop of all cards.
Result<void> ChipsAlone::set_wire(std::string_view name, double value) {
    const std::size_t dot = std::min(name.find('.'), name.size());
    const std::string_view pin = name == "estop" ? "emgn" : name.substr(std::min(dot + 1, name.size()));
    std::vector<LoneCard*> driven;
    for (const auto& card : cards_)
        if (name == "estop" || card->name() == name.substr(0, dot)) driven.push_back(card.get());
    const sim::WireId wire =
        driven.empty() ? sim::WireId::none : kernel_.find_wire(fmt::format("{}.{}", driven.front()->name(), pin));
    if (wire == sim::WireId::none)
        return fail(ErrorKind::invalid_input,
                    fmt::format("Unknown wire {}; inputs are CARD.PIN, such as {}.xlmtp, and estop. "
                                "Nothing was done.",
                                in_quotes(name), cards_.front()->name()));
    if (kernel_.lazy(wire) || pin == "int_n" || pin.find("out") != std::string_view::npos)
        return fail(ErrorKind::refused,
                    fmt::format("{} is an output of the card; inputs can be driven. Nothing was done.", name));
    if (!std::isnan(value) && value != 0 && value != 1)
        return fail(ErrorKind::refused,
                    fmt::format("{} cannot be driven with {}: it is a digital wire, 0 or 1 (NaN releases it). "
                                "Nothing was done.",
                                name, value));
    for (LoneCard* card : driven) card->drive(pin, value);
    kernel_.settle();
    return {};
}

}  // namespace

Result<std::shared_ptr<VirtualRack>> VirtualRack::open(std::string_view path_or_text) {
    if (path_or_text.find_first_of("\n=") != std::string_view::npos) {
        MOTIONRACK_TRY(const auto names, read_cards(path_or_text, {}));
        return std::make_shared<ChipsAlone>(names);
    }
    MOTIONRACK_TRY(const std::string text, read_whole_file(std::string(path_or_text), read_limits::toml));
    MOTIONRACK_TRY(const auto names, read_cards(text, path_or_text));
    return std::make_shared<ChipsAlone>(names);
}

std::string in_quotes(std::string_view text) {
    std::string out(text.substr(0, 60));
    std::replace_if(
        out.begin(), out.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }, '?');
    return fmt::format("'{}{}'", out, out.size() < text.size() ? "..." : "");
}

}  // namespace motionrack::mcx314lib
