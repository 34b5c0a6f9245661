// Marks with a laser card of the rack while the rack runs: makes a command list from a marking job, loads it into the
// card, and starts it at once or lets the start signal of each part start it.
//
//   job (TOML) ──► command list ──► list 1 of the card ──► marking, at once or at each edge of the start input
//           in the worker    between runs
#include <fmt/format.h>

#include <array>
#include <motionrack/mark/marking_host.hpp>
#include <motionrack/panel/panel_context.hpp>
#include <motionrack/rack/bus_access.hpp>
#include <motionrack/rack/rtc5_card.hpp>

namespace motionrack::panel {

using nlohmann::json;

namespace {

using Commands = std::vector<rtc5::Command>;

/// Command lists made from a marking job, for the card.
struct Lists {
    std::shared_ptr<const rtc5::Table> table;
    Commands main;
    Commands arming;  ///< before the first part; empty: the list starts immediately
    double tracking_us = 0;
    bool follows = false;
    std::vector<std::string> notes;
};

/// Replaces the job's optics, lens and belt by those of the rack file, which describe the machine.
void as_the_rack_has_it(mark::MarkingJob& job, const rack::RackConfig& config, const std::string& card) {
    for (const rack::RackScanner& scanner : config.scanners) {
        if (scanner.card != card) continue;
        job.optics.bits_per_mm = scanner.bits_per_mm;
        job.lens = scanner.lens;
        const rack::RackConveyor* track = scanner.conveyor ? config.track(*scanner.conveyor) : nullptr;
        if (track == nullptr) return;
        job.belt.velocity = track->velocity;
        job.belt.profile = track->profile;
        job.belt.rotary = track->rotary;
        job.belt.direction_deg = track->direction_deg;
        job.belt.centre_x_mm = track->centre_x_mm;
        job.belt.centre_y_mm = track->centre_y_mm;
        job.belt.counts_per_unit = track->counts_per_unit;
        return;
    }
}

/// Makes the card's lists from the text of a job; runs in the worker.
Result<Lists> lists_of(const rack::RackConfig& config, const std::string& card, const std::string& text,
                       const std::string& drawing, bool on_parts) {
    mark::JobRead read = mark::read_job(text, "job");
    if (!read.job) return tl::unexpected<Error>(read.errors.front());
    mark::MarkingJob& job = *read.job;
    if (job.parts)
        return fail(ErrorKind::refused,
                    "The job has a section [parts]: the parts come on the rack's belt. Leave it out and give start = "
                    "parts. Nothing was marked.");
    as_the_rack_has_it(job, config, card);
    const auto load = [&drawing](const std::string& path) -> Result<std::string> {
        if (!drawing.empty()) return drawing;
        return fail(ErrorKind::refused, fmt::format("The job names the file {}, and files of this computer are not "
                                                    "read: send the text of the drawing. Nothing was marked.",
                                                    path));
    };
    MOTIONRACK_TRY(const mark::Prepared prepared, mark::prepare(job, load));
    const mark::ConveyorTracking following = mark::following_of(job);
    Lists out;
    out.table = prepared.table;
    out.notes = prepared.notes;
    out.follows = following.mode != mark::FlyMode::off;
    out.tracking_us = job.fly.tracking_error_us;
    MOTIONRACK_TRY(out.main, mark::list_of(job, prepared, following));
    if (on_parts) {
        MOTIONRACK_TRY(out.arming, mark::arming_list_of(job, prepared, following));
    }
    return out;
}

/// A mark command while its list is made in the worker.
struct MarkCommand {
    std::string card, session;
    std::uint64_t stops = 0;       ///< StopLatch::trips() at the command
    std::uint64_t mark_stops = 0;  ///< PanelContext::mark_stops at the command
    Instant door_opened{};         ///< SafetyContacts::door_opened() at the command
};

/// Refuses a mark command if a stop, an opening of the door, a mark_stop or a loss of control came after it.
Result<void> check_still_wanted(PanelContext& context, const MarkCommand& command) {
    MOTIONRACK_CHECK(context.machine.conditions().may_begin("Not marked"));
    const auto refuse = [](const char* why) {
        return fail(ErrorKind::refused,
                    fmt::format("Not marked: {} while the list was made. Nothing was marked; mark again.", why));
    };
    rack::StopLatch& latch = context.machine.rack().stop_latch();
    if (latch.trips() != command.stops) return refuse("the machine was stopped");
    if (latch.contacts().door_opened() != command.door_opened) return refuse("the door was opened");
    if (context.mark_stops != command.mark_stops) return refuse("the marking was stopped");
    const auto holder = context.lease.holder();
    if (!holder || holder->session != command.session) return refuse("control was lost");
    return {};
}

/// Loads the lists into the card and starts or arms them. Call on the motion thread, between runs.
Result<json> begin_marking(PanelContext& context, const MarkCommand& command, const Lists& lists) {
    MOTIONRACK_CHECK(check_still_wanted(context, command));
    const std::string& card = command.card;
    rtc5::Engine& engine = rack::rtc5_card_of(context.machine.rack(), card)->engine();
    if (!engine.at_rest())
        return fail(
            ErrorKind::refused,
            fmt::format(
                "Card {} is executing a list. Nothing was marked. Wait until it ends, or stop it with mark_stop.",
                card));
    if (lists.table) {
        MOTIONRACK_CHECK(engine.parts().heads.load_table(lists.table, 1));
        MOTIONRACK_CHECK(engine.parts().heads.select_tables(1, 0));
    }
    const auto error = static_cast<std::uint16_t>(lists.tracking_us / 10);
    if (lists.follows) engine.parts().encoders.set_tracking_error(error, error);
    MOTIONRACK_CHECK(mark::put_all(engine, 1, lists.main));
    if (lists.arming.empty()) {
        engine.set_control_mode(0);
        MOTIONRACK_CHECK(engine.execute_list(1));
    } else {
        // Each part's edge starts list 1; starts reset the encoders only after a correction has requested it.
        MOTIONRACK_CHECK(mark::put_all(engine, 2, lists.arming));
        engine.parts().starts.set_position(0);
        engine.set_control_mode(rtc5::control_ext_start | rtc5::control_reset_at_start);
        MOTIONRACK_CHECK(engine.execute_list(2));
    }
    return json{{"commands", lists.main.size()}, {"notes", lists.notes}};
}

Result<void> check_card(PanelContext& context, const std::string& card) {
    MOTIONRACK_CHECK(rack::card_named(context.machine.rack(), card));
    if (rack::rtc5_card_of(context.machine.rack(), card) != nullptr) return {};
    return fail(ErrorKind::invalid_input,
                fmt::format("Card {} marks nothing: it is not an RTC5. Nothing was done.", card));
}

void mark(PanelContext& context, const Caller& caller, const json& fields, Ready ready) {
    const std::string card = fields.at("card").get<std::string>();
    if (const Result<void> good = check_card(context, card); !good) return ready(tl::unexpected<Error>(good.error()));
    if (const Result<void> may = context.machine.conditions().may_begin("Not marked"); !may)
        return ready(tl::unexpected<Error>(may.error()));
    rack::StopLatch& latch = context.machine.rack().stop_latch();
    const MarkCommand command{card, caller.session, latch.trips(), context.mark_stops, latch.contacts().door_opened()};
    const auto work = [card, config = context.machine.rack().config(), text = fields.at("job").get<std::string>(),
                       drawing = fields.value("drawing", ""), on_parts = fields.value("start", "now") == "parts"] {
        return lists_of(config, card, text, drawing, on_parts);
    };
    context.run_async<Lists>(work, [&context, ready, command](const Result<Lists>& lists) {
        ready(lists ? begin_marking(context, command, *lists) : tl::unexpected<Error>(lists.error()));
    });
}

/// Executes mark_stop: blocks further list starts and ends the running list.
Result<json> stop(PanelContext& context, const json& fields) {
    const auto& card = fields.at("card").get_ref<const std::string&>();
    MOTIONRACK_CHECK(check_card(context, card));
    rtc5::Engine& engine = rack::rtc5_card_of(context.machine.rack(), card)->engine();
    ++context.mark_stops;
    engine.set_control_mode(0);
    engine.stop_execution();
    return json::object();
}

constexpr std::array mark_rows = {
    OperationHandler{"mark", nullptr,
                     [](PanelContext& context, const Caller& caller, const json& fields, Ready ready) {
                         mark(context, caller, fields, std::move(ready));
                     }},
    OperationHandler{"mark_stop",
                     [](PanelContext& context, const Caller&, const json& fields) { return stop(context, fields); }},
};

}  // namespace

std::span<const OperationHandler> mark_doers() {
    return mark_rows;
}

}  // namespace motionrack::panel
