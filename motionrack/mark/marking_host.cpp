// Loads the lists of a card, starts them and loads the next texts while it marks.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/mark/marking_host.hpp>

namespace motionrack::mark {

namespace {

using rtc5::Engine;
using rtc5::StartFate;

constexpr std::int64_t slice = 50'000;    // ticks between checks of progress and stop
constexpr std::int64_t host_ticks = 100;  // polling interval of the host: 1 ms in ticks
constexpr auto max_ticks = static_cast<std::int64_t>(max_seconds * 1e5);

bool takes_turns(const MarkingJob& job, const Prepared& prepared) {
    return job.parts && job.parts->size() > 1 &&
           (!prepared.further.empty() || job.parts->start == PartStart::equidistant);
}

rtc5::Settings settings_of(const MarkingJob& job, const Prepared& prepared) {
    rtc5::Settings out;
    out.list1 = takes_turns(job, prepared) ? out.list_memory / 2 : out.list_memory;
    out.list2 = out.list_memory - out.list1;
    return out;
}

}  // namespace

Result<InputModel> InputModel::make(const MarkingJob& job, const ConveyorTracking& following) {
    const parts::ConveyorSettings& settings = following.track;
    MOTIONRACK_TRY(parts::Conveyor track, parts::Conveyor::make(settings));
    InputModel out(std::move(track));
    if (following.mode == FlyMode::mcbsp) {
        parts::SerialPositionSettings sender = job.sender;
        const double quarter = settings.direction_deg / 90;
        sender.two_axes = !settings.rotary && quarter != std::floor(quarter);
        out.sender_ = sender;
    }
    return out;
}

Result<void> InputModel::begin(std::int64_t tick) {
    begin_ = tick;
    if (!sender_) return {};
    MOTIONRACK_TRY(source_, parts::SerialPositionSource::make(track_, *sender_));
    return {};
}

void InputModel::counts(int, std::int64_t first, std::span<std::int32_t> out) {
    track_.counts(first - begin_, out);
}

bool InputModel::words(std::int64_t first, std::span<std::uint32_t> out) {
    if (source_) source_->words(first - begin_, out);
    return source_.has_value();
}

MarkingHost::MarkingHost(const MarkingJob& job, const Prepared& prepared, const ConveyorTracking& following,
                         InputModel senses, const rtc5::Settings& settings)
    : job_(job),
      prepared_(prepared),
      following_(following),
      senses_(std::move(senses)),
      card_(settings),
      alternates_(takes_turns(job, prepared)) {}

Result<std::unique_ptr<MarkingHost>> MarkingHost::make(const MarkingJob& job, const Prepared& prepared,
                                                       const ConveyorTracking& following) {
    MOTIONRACK_TRY(InputModel senses, InputModel::make(job, following));
    std::unique_ptr<MarkingHost> out(
        new MarkingHost(job, prepared, following, std::move(senses), settings_of(job, prepared)));
    MOTIONRACK_CHECK(out->set_up());
    return out;
}

Result<void> put_all(Engine& card, int list, const std::vector<rtc5::Command>& commands) {
    const std::int64_t capacity = list == 1 ? card.settings().list1 : card.settings().list2;
    std::int64_t positions = 0;
    for (const rtc5::Command& command : commands) positions += rtc5::info(command.op).positions;
    if (positions > capacity)
        return fail(ErrorKind::refused,
                    fmt::format("The drawing needs {} places of a list; the card's list {} has {}. "
                                "Nothing was marked; mark a smaller drawing, or use a larger tolerance.",
                                positions, list, capacity));
    MOTIONRACK_CHECK(card.set_start_list(static_cast<std::uint32_t>(list)));
    for (const rtc5::Command& command : commands) MOTIONRACK_CHECK(card.put(command));
    return {};
}

Result<void> MarkingHost::load(int list, std::size_t marked) {
    MOTIONRACK_TRY(const std::vector<rtc5::Command> commands, list_of(job_, prepared_, following_, marked));
    loaded_[static_cast<std::size_t>(list - 1)] = marked;
    return put_all(card_, list, commands);
}

/// Loads the settings of external starts. An external start resets an encoder only if a list has requested it before,
/// so this runs a list with that request before the belt time starts.
Result<void> MarkingHost::arm() {
    const bool chain = job_.parts->start == PartStart::equidistant;
    card_.set_control_mode(rtc5::control_ext_start | rtc5::control_reset_at_start |
                           (chain ? rtc5::control_equidistant : 0));
    MOTIONRACK_TRY(const std::vector<rtc5::Command> commands, arming_list_of(job_, prepared_, following_));
    MOTIONRACK_CHECK(put_all(card_, 1, commands));
    MOTIONRACK_CHECK(card_.execute_list(1));
    if (!card_.run_to_rest(max_ticks))
        return fail(
            ErrorKind::refused,
            "The card is not at standstill before the first part. Nothing was marked; shorten the delays in [pace].");
    card_.parts().pipeline.clear_extent();
    const double delay = counts_of(job_, following_, job_.parts->track_delay);
    const rtc5::KindInfo range = rtc5::kind_info(rtc5::Kind::count);
    if (delay < range.min || delay > range.max)
        return fail(
            ErrorKind::refused,
            fmt::format("A track delay of {:g} is {:g} counts; the card takes {:g} to {:g}. Nothing was marked.",
                        job_.parts->track_delay, delay, range.min, range.max));
    if (chain && job_.parts->size() > 1 && counts_of(job_, following_, job_.parts->spacing) == 0)
        return fail(ErrorKind::refused, fmt::format("A spacing of {:g} is less than a count of the encoder, the "
                                                    "minimum between two starts. Nothing was marked.",
                                                    job_.parts->spacing));
    MOTIONRACK_CHECK(card_.set_ext_start_delay(static_cast<std::int32_t>(delay), 0));
    card_.parts().starts.set_position(0);
    return {};
}

/// Finds the ticks at which the sensor detects a part: each part, or only the first with equidistant starts.
Result<void> MarkingHost::find_edges() {
    const PartsSettings& parts = *job_.parts;
    const auto gone = [&](std::int64_t tick) {
        return std::fabs(senses_.track().travel(static_cast<double>(tick) * 1e-5));
    };
    std::int64_t low = 0;
    for (std::size_t i = 0; i < (parts.start == PartStart::equidistant ? 1 : parts.size()); ++i) {
        const double travel = parts.travel(i) - parts.track_delay;
        std::int64_t high = max_ticks;
        if (gone(high) < travel)
            return fail(
                ErrorKind::refused,
                fmt::format("Part {} does not reach the sensor within {:g} s: the belt moves {:.6g} until then, the "
                            "part is {:.6g} away. Nothing was marked; use fewer parts or a faster belt.",
                            i + 1, max_seconds, gone(high), travel));
        std::int64_t min_tick = low;
        while (min_tick < high) {
            const std::int64_t middle = min_tick + (high - min_tick) / 2;
            gone(middle) >= travel ? high = middle : min_tick = middle + 1;
        }
        edges_.push_back(low = high);
    }
    return {};
}

Result<void> MarkingHost::set_up() {
    if (prepared_.table) {
        MOTIONRACK_CHECK(card_.parts().heads.load_table(prepared_.table, 1));
        MOTIONRACK_CHECK(card_.parts().heads.select_tables(1, 0));
    }
    const auto error = static_cast<std::uint16_t>(job_.fly.tracking_error_us / 10);
    if (following_.mode != FlyMode::off) card_.parts().encoders.set_tracking_error(error, error);
    if (job_.parts) {
        MOTIONRACK_CHECK(arm());
        MOTIONRACK_CHECK(find_edges());
    }
    begin_ = card_.tick();
    MOTIONRACK_CHECK(senses_.begin(begin_));
    card_.set_inputs(&senses_);
    if (following_.mode == FlyMode::simulated) MOTIONRACK_CHECK(card_.parts().encoders.simulate(3));
    card_.set_listener(this);
    MOTIONRACK_CHECK(load(1, 0));
    if (alternates_) MOTIONRACK_CHECK(load(2, 1));
    if (job_.parts) return {};
    runs_.push_back({});
    return card_.execute_list(1);
}

void MarkingHost::started(std::int64_t tick, StartFate fate) {
    PartRun run;
    run.fate = fate;
    run.begin = run.end = tick - begin_;
    run.part = runs_.size();
    if (job_.parts->start == PartStart::sensor) {
        run.part = fate == StartFate::too_many ? waiting_.back() : waiting_.front();
        fate == StartFate::too_many ? waiting_.pop_back() : waiting_.pop_front();
    }
    if (fate == StartFate::begun) {
        run.marked = alternates_ ? loaded_[card_.state().starts.position == 0 ? 0 : 1] : begun_;
        ++begun_;
    }
    runs_.push_back(run);
}

void MarkingHost::ended(std::int64_t tick) {
    ++over_;
    for (auto run = runs_.rbegin(); run != runs_.rend(); ++run) {
        if (run->fate != StartFate::begun) continue;
        run->end = tick - begin_;
        return;
    }
}

/// Executes one poll of the host: selects the list that the next start begins, and loads the texts of coming parts into
/// finished lists.
Result<void> MarkingHost::serve() {
    if (!alternates_) return {};
    card_.parts().starts.set_position(begun_ % 2 == 0 ? 0 : card_.settings().list1);
    for (; next_load_ < job_.parts->size() && over_ + 1 >= next_load_; ++next_load_)
        MOTIONRACK_CHECK(load(static_cast<int>(next_load_ % 2) + 1, next_load_));
    return {};
}

bool MarkingHost::some_lost() const {
    return std::any_of(runs_.begin(), runs_.end(), [](const PartRun& run) { return run.fate == StartFate::busy; });
}

Result<void> MarkingHost::run(rtc5::Sink* sink, const std::function<void(std::int64_t)>& done,
                              const RunObserver& watch) {
    for (std::int64_t looked = card_.tick();;) {
        const auto edge = [&] { return next_edge_ < edges_.size() ? begin_ + edges_[next_edge_] : std::int64_t{-1}; };
        while (edge() == card_.tick()) waiting_.push_back(next_edge_++), card_.parts().starts.trigger();
        MOTIONRACK_CHECK(serve());
        const bool rests = card_.at_rest();
        if (rests && edge() < 0) return {};
        std::int64_t until = card_.tick() + (alternates_ && !rests ? host_ticks : slice);
        if (edge() >= 0) until = std::min(until, edge());
        if (rests)
            card_.run_until(until, sink);
        else
            card_.run_to_rest(until - card_.tick(), sink);
        if (card_.tick() - looked < slice) continue;
        looked = card_.tick();
        if (watch.stop && watch.stop()) return fail(ErrorKind::stopped, "Stopped; nothing was written.");
        if (looked - begin_ > max_ticks)
            return fail(ErrorKind::refused, fmt::format("The job needs more than {:g} s of marking. It was aborted; "
                                                        "mark faster, or mark a smaller drawing.",
                                                        max_seconds));
        if (done) done(looked - begin_);
    }
}

}  // namespace motionrack::mark
