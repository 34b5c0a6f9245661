// Special views of single card types: the slope table of a DataBoard 4002, the frames of the grating bus.
#include <fmt/format.h>

#include <motionrack/panel/card_view.hpp>
#include <motionrack/rack/bus_access.hpp>
#include <motionrack/rack/databoard4002_card.hpp>
#include <motionrack/rack/frame_monitor.hpp>

namespace motionrack::panel {

using nlohmann::json;

namespace {

namespace db = databoard4002;

/// Returns one half of the slope table as a staircase: pulse rate in Hz over the distance in counts.
json half_of(const char* name, const db::SlopeTable& table, int first) {
    json points = json::array();
    std::int64_t from = 0;
    for (int i = first; i < first + db::SlopeTable::half; ++i) {
        const db::SlopeEntry entry = table.entry(i);
        if (entry.position <= from) continue;
        const double hz = db::hz_of(entry.rate);
        points.push_back({from, hz});
        points.push_back({entry.position, hz});
        from = entry.position;
    }
    return {{"name", name}, {"unit", "Hz"}, {"over", "counts"}, {"points", std::move(points)}};
}

constexpr std::size_t shown_scales = 32;

/// Returns the stages that have a control loop, with their state. After a stop, a stage waits for a start command.
json looped_stages(rack::Rack& rack) {
    const Instant now = rack.kernel().now();
    json out = json::array();
    for (const rack::RunningStage& stage : rack.stages())
        if (stage.processor != nullptr)
            out.push_back({{"name", stage.config.name},
                           {"unit", "mm"},
                           {"position", stage.motor->position_nm(now) * 1e-6},
                           {"velocity", stage.motor->velocity(now) * 1e3},
                           {"stopped", stage.processor->stopped()}});
    return out;
}

}  // namespace

Result<json> slopes_now(rack::Rack& rack, const std::string& name) {
    MOTIONRACK_CHECK(rack::card_named(rack, name));
    const db::Card* card = rack::databoard4002_card_of(rack, name);
    if (card == nullptr)
        return fail(ErrorKind::invalid_input,
                    fmt::format("Card {} has no slope table: it is not a DataBoard 4002.", name));
    return json{{"name", name},
                {"slopes",
                 {half_of("acceleration over the distance from the start", card->table(), db::SlopeTable::half),
                  half_of("deceleration over the distance to the target", card->table(), 0)}},
                {"moving", card->moving()},
                {"rate", card->output_rate()},
                {"hz", card->fout_hz()},
                {"position", card->position()}};
}

Result<json> frames_now(operate::Machine& machine) {
    const rack::FrameMonitor* watch = machine.instruments().frames();
    if (watch == nullptr) return fail(ErrorKind::refused, "The rack has no grating bus, so it has no frames.");
    json cards = json::array();
    const std::vector<rack::FrameRow> rows = watch->rows();
    const grating_bus::Frame* first = rows.empty() ? nullptr : rows.front().frame;
    std::string why;
    for (const rack::FrameRow& row : rows) {
        json card = {{"name", row.card},     {"role", row.role},     {"stale", row.stale},   {"off", row.off},
                     {"age_us", row.age_us}, {"frames", row.frames}, {"broken", row.broken}, {"untrue", row.untrue},
                     {"unlike", row.unlike}, {"agrees", row.agrees}};
        if (!row.agrees)
            why +=
                fmt::format("{}{} holds another frame than {}", why.empty() ? "" : "; ", row.card, rows.front().card);
        if (row.stale) why += fmt::format("{}{}'s frame is stale", why.empty() ? "" : "; ", row.card);
        if (row.frame != nullptr) {
            const auto positions = row.frame->positions();
            card["frame"] = row.frame->sequence;
            card["time_s"] = to_seconds(row.frame->instant());
            card["skew_ns"] = first != nullptr ? to_seconds(row.frame->instant() - first->instant()) * 1e9 : 0;
            card["scales"] = positions.size();
            card["positions"] = json::array();
            card["addresses"] = json::array();
            for (std::size_t k = 0; k < positions.size() && k < shown_scales; ++k) {
                card["positions"].push_back(static_cast<std::int32_t>(positions[k]));
                card["addresses"].push_back(row.frame->addresses[k]);
            }
        }
        cards.push_back(std::move(card));
    }
    json bus = {{"name", "bus"},
                {"frame", first != nullptr ? json(first->sequence) : json()},
                {"published", watch->published()},
                {"cards", std::move(cards)},
                {"agree", why.empty()},
                {"reason", why}};
    return json{
        {"at", to_seconds(machine.now())}, {"buses", {std::move(bus)}}, {"stages", looped_stages(machine.rack())}};
}

}  // namespace motionrack::panel
