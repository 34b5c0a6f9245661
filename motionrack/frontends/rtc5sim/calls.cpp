// The cards of the process, their common time, and errors.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <motionrack/frontends/rtc5sim/calls.hpp>
#include <motionrack/live/port_spec.hpp>
#include <motionrack/rack/catalogue.hpp>
#include <motionrack/rack/rtc5_card.hpp>

namespace motionrack::rtc5sim {

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): C functions keep it for each thread
thread_local bool inside_handler = false;

namespace {

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): C functions keep it for each thread
thread_local std::string last_sentence;
constexpr UINT max_cards = 16;
constexpr std::uint64_t ns_per_tick = 1'000 * us_per_tick;
constexpr auto max_rack_ticks = static_cast<std::int64_t>(rack::Session::max_ns / ns_per_tick);  ///< limit of a call
constexpr std::int64_t end_of_time =
    std::numeric_limits<std::int64_t>::max() / 1000;  ///< ticks; leaves room for laser instants

/// Marks this thread as inside a samples handler.
class Inside {
  public:
    explicit Inside(bool handed) { inside_handler = handed; }
    ~Inside() { inside_handler = false; }
    Inside(const Inside&) = delete;
    Inside& operator=(const Inside&) = delete;
};

/// Passes the samples of one card to the handler.
class Handed final : public rtc5::Sink {
  public:
    Handed(rtc5sim_samples_handler handler, void* user, UINT number)
        : handler_(handler), user_(user), number_(number) {}
    void samples(const rtc5::Samples& block) override {
        handler_(user_, number_, block.first, block.x.data(), block.y.data(), block.laser.data(), block.x.size());
    }

  private:
    rtc5sim_samples_handler handler_;
    void* user_;
    UINT number_;
};

Result<UINT> cards_wanted() {
    const char* const text = std::getenv("RTC5SIM_CARDS");
    if (text == nullptr || *text == '\0') return 1u;
    const std::string_view all = text;
    UINT number = 0;
    const auto [end, error] = std::from_chars(all.data(), all.data() + all.size(), number);
    if (error != std::errc() || end != all.data() + all.size() || number < 1 || number > max_cards)
        return fail(ErrorKind::invalid_input,
                    fmt::format("the environment variable RTC5SIM_CARDS is \"{}\", but the number of cards "
                                "must be 1 to {}. Nothing was done.",
                                all, max_cards));
    return number;
}

}  // namespace

calls::Process<CardTable>& process() {
    static calls::Process<CardTable> one;
    return one;
}

// ---- the belt

std::int64_t Belt::count(std::size_t encoder, std::int64_t tick) const {
    const SpeedLine& line = lines_[encoder];
    return line.count +
           static_cast<std::int64_t>(std::floor(line.counts_per_s * static_cast<double>(tick - line.tick) / 100'000));
}

void Belt::counts(int encoder, std::int64_t first, std::span<std::int32_t> out) {
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = static_cast<std::int32_t>(
            static_cast<std::uint32_t>(count(static_cast<std::size_t>(encoder), first + static_cast<std::int64_t>(i))));
}

// ---- the bench

Result<void> CardTable::open() {
    if (!cards_.empty()) return {};
    MOTIONRACK_TRY(const UINT wanted, cards_wanted());
    for (UINT i = 1; i <= wanted; ++i) {
        cards_.push_back(std::make_unique<Card>(i));
    }
    return {};
}

Result<UINT> CardTable::count() {
    MOTIONRACK_CHECK(open());
    return static_cast<UINT>(cards_.size());
}

Result<Card*> CardTable::card(UINT number) {
    MOTIONRACK_CHECK(open());
    if (number >= 1 && number <= cards_.size()) {
        Card& card = *cards_[number - 1];
        if (card.wired != nullptr)
            card.wired->engine();  // advances the card to the present and applies its pending input
        return &card;
    }
    if (rack_)
        return fail(
            ErrorKind::invalid_input,
            fmt::format("unknown card {}; the rack has {} of type rtc5. Nothing was done.", number, cards_.size()));
    return fail(ErrorKind::invalid_input,
                fmt::format("unknown card {}; the environment variable RTC5SIM_CARDS makes it {}. "
                            "Nothing was done.",
                            number,
                            cards_.size() == 1 ? std::string("one, the card 1")
                                               : fmt::format("{}, 1 to {}", cards_.size(), cards_.size())));
}

Result<void> CardTable::select(UINT number) {
    MOTIONRACK_CHECK(card(number));
    selected = number;
    return {};
}

Result<std::int64_t> CardTable::tick() {
    MOTIONRACK_CHECK(open());
    if (rack_) return static_cast<std::int64_t>(rack_->now_ns() / ns_per_tick);
    return cards_.front()->engine.tick();
}

Result<void> CardTable::pass(std::int64_t ticks) {
    MOTIONRACK_TRY(const std::int64_t present, tick());
    if (rack_ && ticks > max_rack_ticks)
        return fail(
            ErrorKind::refused,
            fmt::format("the time is {} us; on the cards of a rack it must be 0 to {} us. Nothing was run; call "
                        "several times.",
                        ticks * us_per_tick, max_rack_ticks * us_per_tick));
    if (ticks > end_of_time - present)
        return fail(ErrorKind::refused,
                    fmt::format("the time is {} us; until the end of time it must be 0 to {} us. Nothing was run.",
                                ticks * us_per_tick, (end_of_time - present) * us_per_tick));
    const Inside inside(samples != nullptr);
    if (rack_) return pass_rack(ticks);
    for (const auto& card : cards_) {
        Handed sink(samples, samples_user, card->number);
        card->engine.run_until(present + ticks, samples == nullptr ? nullptr : &sink);
    }
    return {};
}

Result<void> CardTable::pass_rack(std::int64_t ticks) {
    std::vector<Handed> sinks;
    for (const auto& card : cards_) sinks.emplace_back(samples, samples_user, card->number);
    for (std::size_t i = 0; samples != nullptr && i < sinks.size(); ++i) cards_[i]->wired->watch(&sinks[i]);
    const Result<void> done = rack_->advance(static_cast<std::uint64_t>(ticks) * ns_per_tick);
    for (const auto& card : cards_) card->wired->watch(nullptr);
    return done;
}

Result<void> CardTable::open_rack(std::string_view path_or_text) {
    if (live::names_real_card(path_or_text)) MOTIONRACK_CHECK(rack::find_live_plugin("rtc5"));
    MOTIONRACK_TRY(std::unique_ptr<rack::Session> opened, rack::Session::open(path_or_text));
    std::vector<std::unique_ptr<Card>> found;
    for (const rack::RackCard& each : opened->rack().config().cards)
        if (rtc5::Card* card = rack::rtc5_card_of(opened->rack(), each.name))
            found.push_back(std::make_unique<Card>(static_cast<UINT>(found.size() + 1), *card));
    if (found.empty())
        return fail(ErrorKind::invalid_input,
                    "the rack has no card of type rtc5. Nothing was done; the cards are as before.");
    close();
    cards_ = std::move(found);
    rack_ = std::move(opened);
    return {};
}

Result<rack::Session*> CardTable::rack() {
    if (rack_) return rack_.get();
    return fail(ErrorKind::refused, "the cards are not those of a rack. Nothing was done; call rtc5sim_open first.");
}

void CardTable::close() {
    cards_.clear();
    rack_.reset();
    selected = 1;
}

Result<bool> CardTable::run_to_rest(std::int64_t ticks) {
    MOTIONRACK_TRY(const std::int64_t present, tick());
    ticks = std::min(ticks, end_of_time - present);
    if (cards_.size() == 1 && !rack_) {
        Handed sink(samples, samples_user, 1);
        const Inside inside(samples != nullptr);
        return cards_.front()->engine.run_to_rest(ticks, samples == nullptr ? nullptr : &sink);
    }
    // Several cards advance together tick by tick, so that all stop at the same instant.
    const auto rests = [](const auto& card) { return card->engine.at_rest(); };
    while (!std::all_of(cards_.begin(), cards_.end(), rests)) {
        if (ticks-- <= 0) return false;
        MOTIONRACK_CHECK(pass(1));
    }
    return true;
}

// ---- errors

void failed(std::string_view who, std::string_view sentence) noexcept {
    if (who.substr(0, 2) == "n_") who.remove_prefix(2);
    process().failed(last_sentence, who, sentence, !inside_handler);
}

static_assert(RTC5_NO_CARD == rtc5::error_bit("NO_CARD") && RTC5_ACCESS_DENIED == rtc5::error_bit("ACCESS_DENIED") &&
              RTC5_PARAM_ERROR == rtc5::error_bit("PARAM_ERROR") && RTC5_BUSY == rtc5::error_bit("BUSY") &&
              RTC5_REJECTED == rtc5::error_bit("REJECTED"));

UINT selected() noexcept {
    if (inside_handler) return 1;  // every library function is rejected there
    return process().alone([](CardTable& bench) { return bench.selected; });
}

Result<void> checked(rtc5::Op op, double parameter) {
    const auto made = rtc5::list_command(op, {parameter});
    if (made) return {};
    const rtc5::ListCommandInfo& command = rtc5::info(op);
    std::string sentence = made.error().message;
    // Removes the command name and the list command's consequence.
    sentence.erase(0, std::min(sentence.size(), command.name.size() + 2));
    return fail(ErrorKind::refused, sentence.substr(0, sentence.rfind(';')) + "; nothing was changed");
}

Result<std::int32_t> whole32(std::string_view what, long value) {
    if (value >= std::numeric_limits<std::int32_t>::min() && value <= std::numeric_limits<std::int32_t>::max())
        return static_cast<std::int32_t>(value);
    return fail(ErrorKind::refused,
                fmt::format("{} is {}; it must be -2147483648 to 2147483647; nothing was changed", what, value));
}

int small(UINT value) {
    return static_cast<int>(std::min<UINT>(value, 1'000'000));
}

void put_list(UINT number, rtc5::Op op, std::span<const double> parameters) noexcept {
    command(rtc5::info(op).name, number, [&](Card& card) -> Result<void> {
        MOTIONRACK_TRY(const rtc5::Command made, rtc5::list_command(op, parameters));
        return as(ErrorKind::stopped, card.engine.put(made));
    });
}

}  // namespace motionrack::rtc5sim

const char* rtc5sim_last_error(void) {
    return motionrack::rtc5sim::last_sentence.c_str();
}
void rtc5sim_clear_error(void) {
    motionrack::rtc5sim::last_sentence.clear();
}

void rtc5sim_on_error(rtc5sim_error_handler handler, void* user) {
    motionrack::rtc5sim::process().on_error(handler, user);
}
