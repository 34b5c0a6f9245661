// The card's output moves the station's mirrors; its inputs see the belt.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/cards/rtc5/model/engine.hpp>
#include <motionrack/mark/run.hpp>

namespace motionrack::mark {

namespace {

using rtc5::Engine;

constexpr std::int64_t slice = 50'000;  // ticks between two looks at progress and stop
constexpr auto greatest_ticks = static_cast<std::int64_t>(greatest_seconds * 1e5);

/// The part's movement as the card's inputs see it.
class Senses final : public rtc5::Inputs {
  public:
    static Result<Senses> make(const Job& job, const parts::TrackSettings& settings, FlyMode mode) {
        MOTIONRACK_TRY(parts::Track track, parts::Track::make(settings));
        Senses out(std::move(track));
        if (mode == FlyMode::mcbsp) {
            parts::SenderSettings sender = job.sender;
            const double quarter = settings.direction_deg / 90;
            sender.two_axes = !settings.rotary && quarter != std::floor(quarter);
            out.sender_ = sender;
        }
        return out;
    }
    /// After it has come to its place.
    Result<void> begin() {
        if (!sender_) return {};
        MOTIONRACK_TRY(source_, parts::PositionSender::make(track_, *sender_));
        return {};
    }
    void counts(int, std::int64_t first, std::span<std::int32_t> out) override { track_.counts(first, out); }
    bool words(std::int64_t first, std::span<std::uint32_t> out) override {
        if (source_) source_->words(first, out);
        return source_.has_value();
    }

  private:
    explicit Senses(parts::Track track) : track_(std::move(track)) {}
    parts::Track track_;
    std::optional<parts::SenderSettings> sender_;
    std::optional<parts::PositionSender> source_;
};

class StationSink final : public rtc5::Sink {
  public:
    /// `step`: ticks from one sample of the course to the next.
    StationSink(parts::MarkingStation& station, OverflowLog& overflows, std::int64_t step) : station_(station), overflows_(overflows), step_(step) {}
    void samples(const rtc5::Samples& b) override {
        station_.block(b.first, b.x, b.y);
        overflows_.block(b);
        for (std::size_t i = 0; i < b.x.size(); ++i) {
            open_ += b.laser[i];
            if ((b.first + static_cast<std::int64_t>(i)) % step_ != 0) continue;
            course_.push_back({static_cast<double>(b.first + static_cast<std::int64_t>(i)) * 1e-5,
                              station_.spot({static_cast<double>(b.x[i]), static_cast<double>(b.y[i])}),
                              static_cast<double>(open_) / static_cast<double>(rtc5::half_us_per_tick * step_)});
            open_ = 0;
        }
    }
    void laser(std::int64_t half_us, bool on) override { station_.laser(half_us, on); }
    std::vector<FieldSample> take_course() { return std::move(course_); }

  private:
    parts::MarkingStation& station_;
    OverflowLog& overflows_;
    std::vector<FieldSample> course_;
    std::int64_t step_, open_ = 0;
};

/// A card with the job's list, begun.
Result<Engine> card_of(const Job& job, const Prepared& prepared, const Following& following) {
    MOTIONRACK_TRY(const std::vector<rtc5::Command> list, list_of(job, prepared, following));
    rtc5::Settings settings;
    settings.list1 = settings.list_memory;
    settings.list2 = 0;
    if (static_cast<std::int64_t>(list.size()) > settings.list1)
        return fail(Trouble::refused, fmt::format("The drawing needs {} list commands; the card's memory has {}. Nothing was marked; draw less at once or with a "
                                                  "greater tolerance.", list.size(), settings.list1));
    Engine card(settings);
    MOTIONRACK_CHECK(card.set_start_list(1));
    for (const rtc5::Command& command : list) MOTIONRACK_CHECK(card.put(command));
    if (prepared.table) {
        MOTIONRACK_CHECK(card.load_correction(prepared.table, 1));
        MOTIONRACK_CHECK(card.select_cor_table(1, 0));
    }
    const bool follows = following.mode != FlyMode::off;
    if (following.mode == FlyMode::simulated) MOTIONRACK_CHECK(card.simulate_encoder(3));
    const auto error = static_cast<std::uint16_t>(job.fly.tracking_error_us / 10);
    if (follows) card.set_tracking_error(error, error);
    MOTIONRACK_CHECK(card.execute_list(1));
    return card;
}

Result<void> run_to_end(Engine& card, rtc5::Sink* sink, const std::function<void(std::int64_t)>& done, const Watch& watch) {
    while (!card.run_to_rest(slice, sink)) {
        if (watch.stop && watch.stop()) return fail(Trouble::stopped, "Stopped; nothing was written.");
        if (card.tick() > greatest_ticks)
            return fail(Trouble::refused, fmt::format("The job takes more than {:g} s of marking. It was given up; mark faster or draw less.", greatest_seconds));
        if (done) done(card.tick());
    }
    return {};
}

/// How far the correction went; whether the run came to its end in time.
Result<bool> fits(const Job& job, const Prepared& prepared, double factor, const Watch& watch) {
    const Following following = following_of(job, factor);
    MOTIONRACK_TRY(Senses senses, Senses::make(job, following.track, following.mode));
    MOTIONRACK_CHECK(senses.begin());
    MOTIONRACK_TRY(Engine card, card_of(job, prepared, following));
    card.set_inputs(&senses);
    MOTIONRACK_CHECK(run_to_end(card, nullptr, {}, watch));
    const rtc5::Extent& e = card.extent();
    if (e.empty()) return true;
    return e.least_x >= rtc5::field_least && e.least_y >= rtc5::field_least && e.greatest_x <= rtc5::field_greatest && e.greatest_y <= rtc5::field_greatest;
}

/// The greatest factor of the speed that fits, seen from one that does.
Result<void> find_fit(const Job& job, const Prepared& prepared, bool fits_now, const Watch& watch, Outcome& out) {
    double low = fits_now ? 1 : 0, high = fits_now ? 2 : 1;
    if (!fits_now && !out.drawing_in_field) return out.fits_factor = 0, Result<void>{};
    if (fits_now) {
        for (; high <= 1000; high *= 2) {
            MOTIONRACK_TRY(const bool good, fits(job, prepared, high, watch));
            if (!good) break;
            low = high;
        }
        if (high > 1000) return out.fits_factor = low, out.fits_any = true, Result<void>{};
    }
    while (high - low > 1e-4 * high) {
        const double middle = (low + high) / 2;
        MOTIONRACK_TRY(const bool good, fits(job, prepared, middle, watch));
        (good ? low : high) = middle;
    }
    out.fits_factor = low;
    return {};
}

Result<Marked> mark_once(const Job& job, const Prepared& prepared, const Following& following, double expected_ticks, const std::function<void(double)>& progress,
                         const Watch& watch) {
    parts::StationSettings settings;
    settings.galvo = job.galvo;
    settings.lens = prepared.lens;
    settings.bits_per_mm = prepared.bits_per_mm;
    settings.laser = job.laser;
    settings.track = following.track;
    MOTIONRACK_TRY(parts::MarkingStation station, parts::MarkingStation::make(settings));
    MOTIONRACK_TRY(Senses senses, Senses::make(job, following.track, following.mode));
    MOTIONRACK_CHECK(senses.begin());
    MOTIONRACK_TRY(Engine card, card_of(job, prepared, following));
    card.set_inputs(&senses);
    OverflowLog overflows(prepared.bits_per_mm, station.track());
    StationSink sink(station, overflows, static_cast<std::int64_t>(expected_ticks) / most_field_samples + 1);
    MOTIONRACK_CHECK(run_to_end(card, &sink, [&](std::int64_t tick) { if (progress) progress(static_cast<double>(tick) / expected_ticks); }, watch));
    const std::int64_t end = card.tick();
    // The mirrors and the laser come to their rest a little later.
    card.run_until(end + static_cast<std::int64_t>((job.galvo.ideal ? 0 : job.galvo.dead_us / 10 + 200) + job.laser.off_delay_us / 10) + 2, &sink);
    station.workpiece().finish();
    overflows.finish(card.tick());
    Marked out;
    out.deviation = station.workpiece().compare(prepared.segments);
    out.points.assign(station.workpiece().points().begin(), station.workpiece().points().end());
    out.lost_points = station.workpiece().lost_points();
    out.seconds = static_cast<double>(end) * 1e-5;
    out.duty = end > 0 ? static_cast<double>(card.state().laser.on_time) / (static_cast<double>(end) * rtc5::half_us_per_tick) : 0;
    out.marked_mm = station.workpiece().length_mm();
    out.energy_j = station.workpiece().energy_j();
    const rtc5::Extent& e = card.extent();
    const double k = prepared.bits_per_mm;
    out.reach = e.empty() ? box_of(prepared.drawing) : Box{{e.least_x / k, e.least_y / k}, {e.greatest_x / k, e.greatest_y / k}};
    out.course = sink.take_course();
    out.overflows = overflows.all();
    out.lost_overflows = overflows.lost();
    return out;
}

bool moves(const parts::TrackSettings& track) {
    return std::any_of(track.profile.begin(), track.profile.end(), [](const parts::SpeedPoint& p) { return p.speed != 0; });
}

}  // namespace

Result<Outcome> run_job(const Job& job, const Prepared& prepared, const Watch& watch) {
    Outcome out;
    out.notes = prepared.notes;
    out.drawing_mm = length_of(prepared.drawing);
    out.strokes = prepared.drawing.strokes.size();
    out.elements = element_count(prepared.drawing);
    const Box box = box_of(prepared.drawing);
    const double k = prepared.bits_per_mm;
    out.field = {{rtc5::field_least / k, rtc5::field_least / k}, {rtc5::field_greatest / k, rtc5::field_greatest / k}};
    out.drawing_in_field = box.low.x * k >= rtc5::field_least && box.low.y * k >= rtc5::field_least && box.high.x * k <= rtc5::field_greatest &&
                           box.high.y * k <= rtc5::field_greatest;
    const Following with = following_of(job);
    const Following without{with.track, FlyMode::off};
    const bool follows = with.mode != FlyMode::off && moves(with.track);
    // A run that nobody looks at is quick and says how long the job takes.
    MOTIONRACK_TRY(Engine dry, card_of(job, prepared, without));
    MOTIONRACK_CHECK(run_to_end(dry, nullptr, {}, watch));
    const auto ticks = static_cast<double>(dry.tick()) + 1;
    const auto progress = [&](double begin, double share) -> std::function<void(double)> {
        if (!watch.progress) return {};
        return [&watch, begin, share](double part) { watch.progress(begin + share * std::min(part, 1.0)); };
    };
    MOTIONRACK_TRY(out.on, mark_once(job, prepared, with, ticks, progress(0, follows ? 0.45 : 1), watch));
    if (!follows) return out;
    MOTIONRACK_TRY(out.off, mark_once(job, prepared, without, ticks, progress(0.45, 0.45), watch));
    MOTIONRACK_TRY(const bool fits_now, fits(job, prepared, 1, watch));
    MOTIONRACK_CHECK(find_fit(job, prepared, fits_now, watch, out));
    return out;
}

}  // namespace motionrack::mark
