// The frames of a rack as text and JSON.
#include <fmt/format.h>

#include <bit>
#include <iterator>
#include <motionrack/frontends/cli/frames.hpp>
#include <nlohmann/json.hpp>

namespace motionrack::cli {

namespace {

namespace gb = grating_bus;

constexpr std::size_t max_scales_shown = 6;

std::string state_of(const rack::FrameRow& row) {
    if (row.off) return "off";
    if (!row.frame) return "no frame";
    if (row.stale) return "stale";
    return row.agrees ? "agrees" : "DIFFERS";
}

/// Returns "c1, c2" for the bits of the drivers.
std::string drivers_of(const gb::Bus& bus, std::uint64_t bits) {
    std::string out;
    for (; bits != 0; bits &= bits - 1) out += (out.empty() ? "" : ", ") + bus.driver_name(std::countr_zero(bits));
    return out;
}

/// Returns the header of a column: the scale, if all cards use the same one.
std::string column_text(const std::vector<rack::FrameRow>& rows, std::size_t k) {
    int address = -1;
    for (const rack::FrameRow& row : rows) {
        if (!row.frame || k >= row.frame->words) continue;
        if (address >= 0 && address != row.frame->addresses[k]) return fmt::format("word {}", k);
        address = row.frame->addresses[k];
    }
    return fmt::format("scale {}", address);
}

}  // namespace

std::string frames_table(const rack::FrameMonitor& watch, Instant now) {
    const auto rows = watch.rows();
    std::size_t scales = 0, width = 4;
    for (const rack::FrameRow& row : rows) {
        width = std::max(width, row.card.size());
        if (row.frame) scales = std::max<std::size_t>(scales, row.frame->words);
    }
    std::string out = fmt::format(
        "{:.4f} s, {} frames published, {} conflicts\n{:<{}} {:<6} {:>9} {:>10} {:>9} {:>7} {:>7} {:>7}  {:<8}",
        to_seconds(now), watch.published(), watch.bus().lines().all_conflicts(), "card", width, "role", "sequence",
        "age us", "frames", "bad", "unlike", "untrue", "state");
    auto end = std::back_inserter(out);
    const std::size_t shown = std::min(scales, max_scales_shown);
    for (std::size_t k = 0; k < shown; ++k) fmt::format_to(end, " {:>12}", column_text(rows, k));
    out += scales > shown ? fmt::format(" .. {} more\n", scales - shown) : "\n";
    for (const rack::FrameRow& row : rows) {
        fmt::format_to(end, "{:<{}} {:<6} {:>9} {:>10.1f} {:>9} {:>7} {:>7} {:>7}  {:<8}", row.card, width, row.role,
                       row.frame ? std::to_string(row.frame->sequence) : "-", row.age_us, row.frames, row.broken,
                       row.unlike, row.untrue, state_of(row));
        for (std::size_t k = 0; row.frame && k < std::min<std::size_t>(shown, row.frame->words); ++k)
            fmt::format_to(end, " {:>12}", static_cast<std::int32_t>(row.frame->counts[k]));
        out += '\n';
    }
    return out;
}

std::string conflicts_text(const gb::Bus& bus, std::size_t max_conflicts) {
    const gb::Lines& lines = bus.lines();
    const std::uint64_t count = lines.all_conflicts();
    if (count == 0) return {};
    const std::uint64_t first = count > gb::Lines::kept ? count - gb::Lines::kept : 0;
    std::string out = fmt::format("\nconflicts on the bus, {} in all:\n{:>14} {:>10}  {:<7} {:<20} {}\n", count,
                                  "from s", "for ns", "line", "driven high by", "low by");
    for (std::uint64_t n = first; n < count && n < first + max_conflicts; ++n) {
        const gb::Conflict& c = lines.conflict(n);
        const std::string lasts = c.end == never ? "still" : fmt::format("{:.1f}", to_seconds(c.end - c.begin) * 1e9);
        out += fmt::format("{:>14.7f} {:>10}  {:<7} {:<20} {}\n", to_seconds(c.begin), lasts,
                           gb::line_types[c.line].name, drivers_of(bus, c.high), drivers_of(bus, c.low));
    }
    return out + '\n';
}

std::string frames_json(const rack::FrameMonitor& watch, Instant now) {
    nlohmann::ordered_json cards = nlohmann::ordered_json::array();
    for (const rack::FrameRow& row : watch.rows()) {
        nlohmann::ordered_json card = {{"card", row.card},     {"role", row.role},  {"state", state_of(row)},
                                       {"frames", row.frames}, {"bad", row.broken}, {"unlike", row.unlike},
                                       {"untrue", row.untrue}};
        if (row.frame) {
            card["sequence"] = row.frame->sequence;
            card["time_s"] = to_seconds(row.frame->instant());
            card["age_us"] = row.age_us;
            nlohmann::ordered_json counts = nlohmann::ordered_json::array();
            for (const std::uint32_t count : row.frame->positions()) counts.push_back(static_cast<std::int32_t>(count));
            card["counts"] = std::move(counts);
            card["addresses"] =
                std::vector<int>(row.frame->addresses.begin(), row.frame->addresses.begin() + row.frame->words);
        }
        cards.push_back(std::move(card));
    }
    return nlohmann::ordered_json{{"time_s", to_seconds(now)},
                                  {"conflicts", watch.bus().lines().all_conflicts()},
                                  {"agree", frames_agree(watch)},
                                  {"cards", cards}}
        .dump();
}

bool frames_agree(const rack::FrameMonitor& watch) {
    if (watch.bus().lines().all_conflicts() != 0) return false;
    for (const rack::FrameRow& row : watch.rows())
        if (row.stale || row.untrue != 0 || row.unlike != 0 || row.broken != 0) return false;
    return true;
}

}  // namespace motionrack::cli
