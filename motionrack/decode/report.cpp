// An analysis as text and as JSON.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/decode/report.hpp>
#include <nlohmann/json.hpp>

namespace motionrack::decode {

namespace {

constexpr const char* tab = "  ";

/// The last part of a signal's name.
std::string short_name(const std::string& signal) {
    const std::size_t dot = signal.rfind('.');
    return dot == std::string::npos || dot + 1 == signal.size() ? signal : signal.substr(dot + 1);
}

std::string lines_of(const ChannelResult& channel) {
    std::string out = short_name(channel.a) + "," + short_name(channel.b);
    return channel.z.empty() ? out : out + "," + short_name(channel.z);
}

std::string duration(double seconds) {
    for (const auto& [unit, size] :
         {std::pair{"s", 1.0}, std::pair{"ms", 1e-3}, std::pair{"us", 1e-6}, std::pair{"ns", 1e-9}})
        if (seconds >= size * 0.999) return fmt::format("{:.6g} {}", seconds / size, unit);
    return fmt::format("{:.6g} ps", seconds * 1e12);
}

/// CSV times are decimals with an unknown number of significant places.
bool has_tick(const Analysis& analysis) {
    return !(analysis.format == Format::csv && analysis.timed);
}

/// Decimal places that the capture's time resolves.
int places_of(const Analysis& analysis) {
    if (!has_tick(analysis)) return 9;
    return std::clamp(static_cast<int>(std::ceil(-std::log10(std::max(analysis.tick_s, 1e-12)) - 1e-6)), 3, 12);
}

std::string illegal_text(const ChannelResult& channel, int places, std::size_t shown) {
    if (channel.illegal == 0 || shown == 0) return "";
    std::string out = fmt::format("\nillegal transitions of {}: {}\n{}{:>16}  {:>14}\n", channel.name, channel.illegal,
                                  tab, "at s", "sample");
    std::size_t reported = 0;
    for (const IllegalAt& at : channel.first_illegal)
        if (reported < shown)
            out += fmt::format("{}{:>16.{}f}  {:>14}\n", tab, at.time_s, places, at.sample), ++reported;
    if (channel.illegal > reported)
        out += fmt::format("{}{:>16}\n", tab, fmt::format("and {} more", channel.illegal - reported));
    return out;
}

std::string index_text(const ChannelResult& channel, int places, std::size_t shown) {
    if (channel.indexes == 0 || shown == 0) return "";
    std::string out = fmt::format("\nindexes of {}: {}\n{}{:>16}  {:>14}  {:>14}  {:>14}\n", channel.name,
                                  channel.indexes, tab, "at s", "sample", "count", "since the last");
    std::size_t reported = 0;
    for (std::size_t i = 0; i < channel.first_indexes.size() && reported < shown; ++i, ++reported) {
        const IndexAt& at = channel.first_indexes[i];
        const std::string since = i == 0 ? "-" : fmt::format("{}", at.count - channel.first_indexes[i - 1].count);
        out +=
            fmt::format("{}{:>16.{}f}  {:>14}  {:>14}  {:>14}\n", tab, at.time_s, places, at.sample, at.count, since);
    }
    if (channel.indexes > reported)
        out += fmt::format("{}{:>16}\n", tab, fmt::format("and {} more", channel.indexes - reported));
    return out;
}

nlohmann::json json_of(const ChannelResult& channel) {
    nlohmann::json out = {{"name", channel.name},
                          {"a", channel.a},
                          {"b", channel.b},
                          {"counts", channel.count},
                          {"up", channel.up},
                          {"down", channel.down},
                          {"duration_s", channel.seconds},
                          {"mean_counts_per_s", channel.mean_per_s},
                          {"illegal", channel.illegal},
                          {"indexes", channel.indexes}};
    out["z"] = channel.z.empty() ? nlohmann::json() : nlohmann::json(channel.z);
    out["peak"] = nullptr;
    if (channel.peak) out["peak"] = {{"counts_per_s", channel.peak->counts_per_s}, {"time_s", channel.peak->time_s}};
    out["first_illegal"] = out["first_indexes"] = out["lines_without_level"] = nlohmann::json::array();
    for (const IllegalAt& at : channel.first_illegal)
        out["first_illegal"].push_back({{"sample", at.sample}, {"time_s", at.time_s}});
    for (const IndexAt& at : channel.first_indexes)
        out["first_indexes"].push_back({{"sample", at.sample}, {"time_s", at.time_s}, {"count", at.count}});
    for (const LineNote& note : channel.notes) {
        nlohmann::json one = {
            {"signal", note.signal}, {"unknown", note.unknown}, {"first_unknown", note.first_unknown}};
        if (note.from_s)
            one["first_level_s"] = std::isnan(*note.from_s) ? nlohmann::json() : nlohmann::json(*note.from_s);
        out["lines_without_level"].push_back(std::move(one));
    }
    return out;
}

}  // namespace

std::string analysis_text(const Analysis& analysis, const std::string& name, std::size_t shown) {
    const int places = places_of(analysis);
    std::string out = fmt::format("{}: {}, {} samples, {}", name, name_of(analysis.format), analysis.samples,
                                  duration(analysis.last_s - analysis.first_s));
    if (has_tick(analysis))
        out += fmt::format(", {} a {}", duration(analysis.tick_s), analysis.timed ? "tick" : "sample");
    out += '\n';
    std::size_t wide = 5;
    for (const ChannelResult& channel : analysis.channels) wide = std::max(wide, lines_of(channel).size());
    out += fmt::format("\n{:<10} {:<{}} {:>12} {:>12} {:>12} {:>14} {:>14} {:>8} {:>8}\n", "channel", "lines", wide,
                       "counts", "up", "down", "mean /s", "peak /s", "illegal", "indexes");
    for (const ChannelResult& channel : analysis.channels)
        out += fmt::format("{:<10} {:<{}} {:>12} {:>12} {:>12} {:>14.1f} {:>14} {:>8} {:>8}\n", channel.name,
                           lines_of(channel), wide, channel.count, channel.up, channel.down, channel.mean_per_s,
                           channel.peak ? fmt::format("{:.1f}", channel.peak->counts_per_s) : "-", channel.illegal,
                           channel.z.empty() ? "-" : fmt::format("{}", channel.indexes));
    out += fmt::format("peak: the maximum counts in a window of {}\n", duration(analysis.window_s));
    for (const ChannelResult& channel : analysis.channels)
        out += illegal_text(channel, places, shown) + index_text(channel, places, shown);
    return out;
}

std::string analysis_json(const Analysis& analysis, const std::string& name) {
    nlohmann::json out = {{"file", name},
                          {"format", name_of(analysis.format)},
                          {"samples", analysis.samples},
                          {"first_s", analysis.first_s},
                          {"last_s", analysis.last_s},
                          {"tick_s", analysis.tick_s},
                          {"window_s", analysis.window_s},
                          {"stopped", analysis.stopped},
                          {"channels", nlohmann::json::array()}};
    out["cut"] = analysis.cut ? nlohmann::json(analysis.cut->text()) : nlohmann::json();
    for (const ChannelResult& channel : analysis.channels) out["channels"].push_back(json_of(channel));
    return out.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::vector<std::string> analysis_warnings(const Analysis& analysis) {
    std::vector<std::string> out;
    for (const ChannelResult& channel : analysis.channels)
        for (const LineNote& note : channel.notes) {
            if (note.from_s && std::isnan(*note.from_s))
                out.push_back(fmt::format("{} has no level in the whole capture: channel {} was not decoded.",
                                          note.signal, channel.name));
            else if (note.from_s)
                out.push_back(fmt::format("{} has no level before {:.9g} s: channel {} begins there.", note.signal,
                                          *note.from_s, channel.name));
            if (note.unknown > 0)
                out.push_back(fmt::format("{} was X or Z {} {}, first in {}: it was held at its last level.",
                                          note.signal, note.unknown, note.unknown == 1 ? "time" : "times",
                                          note.first_unknown));
        }
    return out;
}

}  // namespace motionrack::decode
