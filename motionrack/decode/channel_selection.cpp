// Lookup of lines by the end of their names.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <motionrack/decode/channel_selection.hpp>

namespace motionrack::decode {

namespace {

constexpr std::size_t max_named = 24;
constexpr std::size_t max_channels = 64;

/// "X.Enc A" and "x_enc_a" are one name.
std::string plain(std::string_view name) {
    std::string out;
    for (const char c : name)
        out += c >= 'A' && c <= 'Z'                           ? static_cast<char>(c - 'A' + 'a')
               : c == '.' || c == ' ' || c == '/' || c == '-' ? '_'
                                                              : c;
    return out;
}

bool ends_with_name(const std::string& name, const std::string& end) {
    if (name.size() < end.size() || name.compare(name.size() - end.size(), end.size(), end) != 0) return false;
    return name.size() == end.size() || name[name.size() - end.size() - 1] == '_';
}

std::string listed(const std::vector<std::string>& signals) {
    std::string out;
    for (std::size_t i = 0; i < signals.size() && i < max_named; ++i) out += (i == 0 ? "" : ", ") + signals[i];
    if (signals.size() > max_named) out += fmt::format(" and {} more", signals.size() - max_named);
    return out;
}

/// Finds a line by its full name, the end of it, or its number.
Result<std::size_t> find_signal(const std::vector<std::string>& signals, std::string_view text) {
    const auto exact = std::find(signals.begin(), signals.end(), text);
    if (exact != signals.end()) return static_cast<std::size_t>(exact - signals.begin());
    std::vector<std::string> fitting;
    std::size_t last = 0;
    const std::string wanted = plain(text);
    for (std::size_t i = 0; i < signals.size(); ++i)
        if (ends_with_name(plain(signals[i]), wanted)) fitting.push_back(signals[i]), last = i;
    if (fitting.size() == 1) return last;
    if (fitting.size() > 1)
        return fail(
            ErrorKind::invalid_input,
            fmt::format("'{}' matches {}. Nothing was decoded; write more of the name.", text, listed(fitting)));
    std::size_t number = 0;
    const auto [end, bad] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (bad == std::errc() && end == text.data() + text.size() && number < signals.size()) return number;
    return fail(
        ErrorKind::invalid_input,
        fmt::format("The capture has no line '{}'. Nothing was decoded; its lines are: {}.", text, listed(signals)));
}

Result<ChannelSelection> read_choice(const std::vector<std::string>& signals, const std::string& text) {
    const std::size_t equal = text.find('=');
    std::vector<std::string> lines;
    for (std::size_t at = equal + 1; equal != std::string::npos && at <= text.size();) {
        const std::size_t comma = std::min(text.find(',', at), text.size());
        lines.push_back(text.substr(at, comma - at));
        at = comma + 1;
    }
    if (equal == 0 || lines.size() < 2 || lines.size() > 3 || std::count(lines.begin(), lines.end(), "") > 0)
        return fail(
            ErrorKind::invalid_input,
            fmt::format(
                "'{}' names no channel: write X=A,B or X=A,B,Z with the lines' names or numbers. Nothing was decoded.",
                text));
    ChannelSelection choice;
    choice.name = text.substr(0, equal);
    MOTIONRACK_TRY(choice.a, find_signal(signals, lines[0]));
    MOTIONRACK_TRY(choice.b, find_signal(signals, lines[1]));
    if (lines.size() == 3) {
        MOTIONRACK_TRY(choice.z, find_signal(signals, lines[2]));
    }
    if (choice.a == choice.b || choice.z == choice.a || choice.z == choice.b)
        return fail(ErrorKind::invalid_input, fmt::format("'{}' names a line twice. Nothing was decoded.", text));
    return choice;
}

struct Found {
    std::optional<std::size_t> a, b, z;
    std::string name;
};

/// The channels whose lines end in a, b, z after `before` ("enc_" or "").
std::vector<ChannelSelection> named_like(const std::vector<std::string>& signals, const std::string& before) {
    std::map<std::string, Found> found;
    std::vector<std::string> order;
    for (std::size_t i = 0; i < signals.size(); ++i) {
        const std::string name = plain(signals[i]);
        for (const char line : {'a', 'b', 'z'}) {
            const std::string end = before + line;
            if (!ends_with_name(name, end)) continue;
            const std::size_t rest = name.size() - end.size();
            Found& channel = found[name.substr(0, rest)];
            if (channel.name.empty()) {
                // The last part of the prefix: "X" of "top.X.X_enc_a".
                const std::string full = signals[i].substr(0, rest > 0 ? rest - 1 : 0);
                const std::size_t cut = full.find_last_of("._ /-");
                channel.name = full.empty() ? "encoder" : full.substr(cut == std::string::npos ? 0 : cut + 1);
                order.push_back(name.substr(0, rest));
            }
            auto& slot = line == 'a' ? channel.a : line == 'b' ? channel.b : channel.z;
            if (!slot) slot = i;
        }
    }
    std::vector<ChannelSelection> out;
    for (const std::string& key : order)
        if (const Found& channel = found[key]; channel.a && channel.b)
            out.push_back({channel.name, *channel.a, *channel.b, channel.z});
    return out;
}

}  // namespace

Result<std::vector<ChannelSelection>> choose_channels(const std::vector<std::string>& signals,
                                                      const std::vector<std::string>& texts) {
    std::vector<ChannelSelection> out;
    for (const std::string& text : texts) {
        MOTIONRACK_TRY(ChannelSelection choice, read_choice(signals, text));
        for (const ChannelSelection& other : out)
            if (other.name == choice.name)
                return fail(ErrorKind::invalid_input,
                            fmt::format("Two channels have the name '{}'. Nothing was decoded; give each its own name.",
                                        choice.name));
        out.push_back(std::move(choice));
    }
    for (const char* before : {"enc_", ""})
        if (out.empty() && texts.empty()) out = named_like(signals, before);
    if (out.empty())
        return fail(ErrorKind::invalid_input,
                    fmt::format("No lines have the names of an encoder (X.enc_a, X.enc_b, X.enc_z). Nothing was "
                                "decoded; name them with --channel X=A,B,Z. The lines are: {}.",
                                listed(signals)));
    if (out.size() > max_channels)
        return fail(
            ErrorKind::refused,
            fmt::format(
                "{} channels: up to {} can be decoded at once. Nothing was decoded; choose some with --channel.",
                out.size(), max_channels));
    return out;
}

}  // namespace motionrack::decode
