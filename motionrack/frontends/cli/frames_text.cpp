// Frames and counts as text and JSON.
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <motionrack/frontends/cli/frames.hpp>
#include <motionrack/frontends/cli/terminal.hpp>
#include <nlohmann/json.hpp>

namespace motionrack::cli {

namespace {

using nlohmann::ordered_json;

struct CountName {
    const char* key;
    const char* words;
    std::uint64_t dds::Counts::*count;
};
constexpr CountName count_names[] = {
    {"received", "samples received", &dds::Counts::received},
    {"used", "frames used", &dds::Counts::used},
    {"lost", "lost", &dds::Counts::lost},
    {"late", "out of order", &dds::Counts::late},
    {"duplicates", "twice", &dds::Counts::duplicates},
    {"jumps", "sequence against time", &dds::Counts::jumps},
    {"wrong_crc", "wrong CRC", &dds::Counts::wrong_crc},
    {"foreign", "of another format", &dds::Counts::foreign},
    {"malformed", "malformed", &dds::Counts::malformed},
    {"wrong_words", "another N", &dds::Counts::wrong_words},
    {"other_source", "of another publisher", &dds::Counts::other_source},
    {"conflicts", "conflicts", &dds::Counts::conflicts},
    {"restarts", "publisher restarted", &dds::Counts::restarts},
    {"takeovers", "another computer followed", &dds::Counts::takeovers},
    {"anew", "sequence restarted", &dds::Counts::anew},
    {"stale", "times stale", &dds::Counts::stale},
};

ordered_json source_json(const dds::PublisherIdentity& source) {
    return {{"host", source.host_name()}, {"process", source.process}, {"id", source.id_text()}};
}

double milliseconds_of(Duration d) {
    return static_cast<double>(d.count()) * 1e-7;
}

/// Returns JSON as text. Replaces invalid UTF-8, because the sources of events are untrusted.
std::string text_of(const ordered_json& json) {
    return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace

void add_bus_options(CLI::App& command, BusOptions& options) {
    command.add_option("--bus", options.name, "name of the bus: letters, digits, '_' and '-'")->capture_default_str();
    command.add_option("--domain", options.domain, "DDS domain, 0 to 232")->capture_default_str();
    command.add_option("--config", options.config,
                       "Cyclone DDS configuration file (default: what CYCLONEDDS_URI names)");
}

Result<void> use_config(const BusOptions& options) {
    if (options.config.empty()) return {};
    MOTIONRACK_TRY([[maybe_unused]] const std::string readable, read_text(options.config, read_limits::toml));
    const std::string path = std::filesystem::absolute(options.config).string();
    ::setenv("CYCLONEDDS_URI", ("file://" + path).c_str(), 1);
    return {};
}

std::string status_json(const dds::Subscriber& subscriber, const std::string& bus, Instant now) {
    const dds::FrameValidator& judge = subscriber.judge();
    ordered_json out = {
        {"bus", bus}, {"joined", judge.joined()}, {"stale", judge.stale()}, {"in_conflict", judge.in_conflict()}};
    if (judge.joined()) {
        const dds::Frame& frame = judge.frame();
        out["source"] = source_json(judge.source());
        out["period_us"] = to_seconds(judge.period()) * 1e6;
        out["pace_us"] = to_seconds(judge.pace()) * 1e6;
        out["sequence"] = frame.sequence;
        out["time_s"] = to_seconds(frame.instant());
        out["age_ms"] = milliseconds_of(judge.age(now));
        out["positions"] = frame.positions();
    }
    ordered_json counts, others = ordered_json::array();
    for (const CountName& each : count_names) counts[each.key] = judge.counts().*each.count;
    counts["overruns"] = subscriber.overruns();
    for (const dds::OtherSource& other : judge.others()) {
        others.push_back(source_json(other.source));
        others.back()["frames"] = other.frames;
        others.back()["in_conflict"] = other.in_conflict;
    }
    out["counts"] = std::move(counts);
    out["others"] = std::move(others);
    return text_of(out);
}

std::string event_json(const dds::BusEvent& event, Instant start) {
    ordered_json out = {
        {"event", dds::name_of(event.kind)}, {"at_s", to_seconds(event.when - start)}, {"text", dds::sentence(event)}};
    out["source"] = source_json(event.source);
    if (event.other.process != 0) out["other"] = source_json(event.other);
    return text_of(out);
}

std::string status_table(const dds::Subscriber& subscriber, const std::string& bus, Instant now) {
    const dds::FrameValidator& judge = subscriber.judge();
    if (!judge.joined())
        return fmt::format("bus {}: no frame yet; {} samples received\n", bus, judge.counts().received);
    const dds::Frame& frame = judge.frame();
    std::string out = fmt::format("bus {}: {}\n", bus, judge.source().text());
    auto end = std::back_inserter(out);
    fmt::format_to(end, "frame {}, bus time {:.6f} s, age {:.2f} ms, every {:g} ms: {}\n", frame.sequence,
                   to_seconds(frame.instant()), milliseconds_of(judge.age(now)), milliseconds_of(judge.pace()),
                   judge.stale() ? "STALE" : "fresh");
    static constexpr std::uint32_t a_row = 8;
    for (std::uint32_t i = 0; i < frame.words; ++i) {
        if (i % a_row == 0) fmt::format_to(end, "{}{:>4}:", i == 0 ? "" : "\n", i);
        fmt::format_to(end, " {:>12}", static_cast<std::int32_t>(frame.counts[i]));
    }
    out += '\n';
    for (const CountName& each : count_names)
        if (const std::uint64_t count = judge.counts().*each.count; count != 0)
            fmt::format_to(end, "{:>12} {}\n", count, each.words);
    if (subscriber.overruns() != 0)
        fmt::format_to(end, "{:>12} dropped here, this program was too slow\n", subscriber.overruns());
    for (const dds::OtherSource& other : judge.others())
        fmt::format_to(end, "{} {}: {} frames, not used\n", other.in_conflict ? "CONFLICT" : "also",
                       other.source.text(), other.frames);
    return out;
}

std::string status_line(const dds::Subscriber& subscriber, Instant now) {
    const dds::FrameValidator& judge = subscriber.judge();
    const dds::Counts& c = judge.counts();
    if (!judge.joined()) return fmt::format("no frame yet; {} samples received", c.received);
    const dds::Frame& frame = judge.frame();
    std::string out =
        fmt::format("frame {} age {:.2f} ms {}, used {} lost {} order {} crc {} bad {} others {}{} |", frame.sequence,
                    milliseconds_of(judge.age(now)), judge.stale() ? "STALE" : "fresh", c.used, c.lost, c.late,
                    c.wrong_crc, c.duplicates + c.jumps + c.foreign + c.malformed + c.wrong_words, c.other_source,
                    judge.in_conflict() ? " CONFLICT" : "");
    for (const std::uint32_t count : frame.positions())
        fmt::format_to(std::back_inserter(out), " {}", static_cast<std::int32_t>(count));
    return out;
}

}  // namespace motionrack::cli
