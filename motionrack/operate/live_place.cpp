// Checks whether a real card may replace a card of the rack.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/operate/live_card.hpp>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::operate {

Result<LivePlace> read_live_place(std::string_view text) {
    const std::size_t equals = text.find('=');
    if (equals == 0 || equals >= text.find(':'))
        return fail(
            ErrorKind::invalid_input,
            fmt::format("'{}' does not name a card and its address. Nothing was opened. Write the name of a card of "
                        "the rack file, '=' and its address, such as bench=port:/dev/port,offset=0x300,width=8.",
                        text));
    LivePlace out{std::string(text.substr(0, equals)), std::string(text.substr(equals + 1)), {}};
    MOTIONRACK_TRY(out.spec, live::read_port_spec(out.place));
    return out;
}

Result<void> check_live_places(const rack::RackConfig& config, std::span<const LivePlace> places) {
    for (std::size_t i = 0; i < places.size(); ++i) {
        const std::string& name = places[i].card;
        const rack::RackCard* const card = config.card(name);
        if (card == nullptr) {
            std::string known;
            for (const rack::RackCard& one : config.cards) known += (known.empty() ? "" : ", ") + one.name;
            return fail(ErrorKind::invalid_input, fmt::format("Unknown card {}; the cards of this rack are: {}. "
                                                              "Nothing was opened. A real card replaces one of them.",
                                                              rack::in_quotes(name), known));
        }
        const Result<const rack::CardPlugin*> plugin = rack::find_live_plugin(card->type);
        if (!plugin)
            return fail(ErrorKind::refused,
                        fmt::format("Card {} is of type {}. {}", name, card->type, plugin.error().message));
        MOTIONRACK_CHECK(live::check_card(places[i].spec, (*plugin)->map()));
        std::string letters;
        for (const rack::RackAxis& axis : config.axes)
            if (axis.card == name) letters += fmt::format("{}{}", letters.empty() ? "" : ", ", axis.letter);
        if (!letters.empty())
            return fail(
                ErrorKind::refused,
                fmt::format("Card {} moves {} of the machine, and the controller supports virtual cards only. "
                            "Nothing was opened. Give the rack file a card of this type without axes for the real one.",
                            name, letters));
        for (std::size_t j = 0; j < i; ++j)
            if (places[j].card == name)
                return fail(ErrorKind::invalid_input,
                            fmt::format("Card {} has two addresses, {} and {}. Nothing was opened. Give one.", name,
                                        places[j].place, places[i].place));
    }
    return {};
}

}  // namespace motionrack::operate
