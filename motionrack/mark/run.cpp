// Connects the card's output to the station's mirrors and its inputs to the belt.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/mark/parts_marked.hpp>
#include <motionrack/mark/run.hpp>

namespace motionrack::mark {

namespace {

using rtc5::Engine;

class StationSink final : public rtc5::Sink {
  public:
    /// `begin`: tick of the card at which the belt time is 0. `step`: ticks between samples of the spot path.
    StationSink(parts::MarkingStation& station, OverflowLog& overflows, std::int64_t begin, std::int64_t step)
        : station_(station), overflows_(overflows), begin_(begin), step_(step) {}
    void samples(const rtc5::Samples& block) override {
        rtc5::Samples b = block;
        b.first -= begin_;
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
    void laser(std::int64_t half_us, bool on) override {
        station_.laser(half_us - begin_ * rtc5::half_us_per_tick, on);
    }
    std::vector<FieldSample> take_course() { return std::move(course_); }

  private:
    parts::MarkingStation& station_;
    OverflowLog& overflows_;
    std::vector<FieldSample> course_;
    std::int64_t begin_, step_, open_ = 0;
};

/// Result of a fast run without observers.
struct Quick {
    double ticks = 0;
    double beyond_mm = 0;    ///< maximum distance beyond the field; 0 or less: inside
    bool some_lost = false;  ///< lost starts, except those beyond a queue of eight, which are lost at any velocity
    bool fits() const { return beyond_mm <= 0 && !some_lost; }
};

Result<Quick> run_quick(const MarkingJob& job, const Prepared& prepared, double factor, const RunObserver& watch) {
    MOTIONRACK_TRY(const std::unique_ptr<MarkingHost> line,
                   MarkingHost::make(job, prepared, following_of(job, factor)));
    MOTIONRACK_CHECK(line->run(nullptr, {}, watch));
    Quick out{static_cast<double>(line->card().tick() - line->begin()), 0, line->some_lost()};
    const rtc5::PlanExtent& e = line->card().parts().pipeline.extent();
    if (!e.empty())
        out.beyond_mm = std::max({rtc5::min_field - e.min_x, rtc5::min_field - e.min_y, e.max_x - rtc5::max_field,
                                  e.max_y - rtc5::max_field}) /
                        prepared.bits_per_mm;
    return out;
}

/// Fraction of the progress when the runs with and without correction are finished; the rest is the search for the
/// limit.
constexpr double marked_at = 0.9;

/// Searches for the maximum velocity factor at which the corrected position stays in the field and no start is lost.
class FitSearch {
  public:
    FitSearch(const MarkingJob& job, const Prepared& prepared, const RunObserver& watch)
        : job_(job), prepared_(prepared), watch_(watch) {}

    Result<void> find(const Quick& now, MarkingOutcome& out) {
        const double max_factor = std::min(1000.0, parts::max_track_velocity / peak_velocity());
        const double min_factor = std::max(1e-3, now.ticks * 1e-5 / max_seconds);
        double low = 1, high = 1;
        out.starts_limit = now.beyond_mm <= 0;
        if (!now.fits() && !out.drawing_in_field) return out.fits_factor = 0, Result<void>{};
        if (now.fits()) {
            for (bool good = true; good && high <= max_factor;) {
                low = high, high *= 2;
                if (high > max_factor) break;
                MOTIONRACK_TRY(good, fits(high, out));
            }
            if (high > max_factor) return out.fits_factor = low, out.fits_any = true, Result<void>{};
        } else {
            for (bool good = false; !good;) {
                high = low, low /= 2;
                if (low < min_factor) return out.fits_factor = 0, Result<void>{};
                MOTIONRACK_TRY(good, fits(low, out));
            }
        }
        while (high - low > 1e-4 * high) {
            const double middle = (low + high) / 2;
            MOTIONRACK_TRY(const bool good, fits(middle, out));
            (good ? low : high) = middle;
        }
        out.fits_factor = low;
        return {};
    }

  private:
    double peak_velocity() const {
        double top = 0;
        for (const parts::VelocityPoint& point : following_of(job_).track.profile)
            top = std::max(top, std::fabs(point.velocity));
        return top;
    }
    Result<bool> fits(double factor, MarkingOutcome& out) {
        MOTIONRACK_TRY(const Quick quick, run_quick(job_, prepared_, factor, watch_));
        if (!quick.fits()) out.starts_limit = quick.beyond_mm <= 0;
        // The search takes about twenty runs, fewer if the limit is near a factor of 1.
        ++tried_;
        if (watch_.progress) watch_.progress(marked_at + (1 - marked_at) * tried_ / (tried_ + 10));
        return quick.fits();
    }

    const MarkingJob& job_;
    const Prepared& prepared_;
    const RunObserver& watch_;
    double tried_ = 0;
};

Result<Marked> mark_once(const MarkingJob& job, const Prepared& prepared, const ConveyorTracking& following,
                         double expected_ticks, const std::function<void(double)>& progress, const RunObserver& watch) {
    parts::StationSettings settings;
    settings.galvo = job.galvo;
    settings.lens = prepared.lens;
    settings.bits_per_mm = prepared.bits_per_mm;
    settings.laser = job.laser;
    settings.track = following.track;
    MOTIONRACK_TRY(parts::MarkingStation station, parts::MarkingStation::make(settings));
    MOTIONRACK_TRY(const std::unique_ptr<MarkingHost> line, MarkingHost::make(job, prepared, following));
    Engine& card = line->card();
    OverflowLog overflows(prepared.bits_per_mm, station.track());
    StationSink sink(station, overflows, line->begin(),
                     static_cast<std::int64_t>(expected_ticks) / max_field_samples + 1);
    MOTIONRACK_CHECK(line->run(
        &sink,
        [&](std::int64_t tick) {
            if (progress) progress(static_cast<double>(tick) / expected_ticks);
        },
        watch));
    const std::int64_t end = card.tick() - line->begin();
    // Runs a little longer, until the mirrors and the laser have settled.
    card.run_until(card.tick() +
                       static_cast<std::int64_t>((job.galvo.ideal_mirrors ? 0 : job.galvo.dead_time_us / 10 + 200) +
                                                 job.laser.off_delay_us / 10) +
                       2,
                   &sink);
    station.workpiece().finish();
    overflows.finish(card.tick() - line->begin());
    Marked out;
    out.lost_points = station.workpiece().lost_points();
    out.seconds = static_cast<double>(end) * 1e-5;
    out.duty =
        end > 0 ? static_cast<double>(card.state().laser.on_time) / (static_cast<double>(end) * rtc5::half_us_per_tick)
                : 0;
    out.marked_mm = station.workpiece().length_mm();
    out.energy_j = station.workpiece().energy_j();
    const rtc5::PlanExtent& e = card.parts().pipeline.extent();
    const double k = prepared.bits_per_mm;
    out.reach = e.empty() ? box_of(prepared.drawing) : Box{{e.min_x / k, e.min_y / k}, {e.max_x / k, e.max_y / k}};
    out.course = sink.take_course();
    out.overflows = overflows.all();
    out.lost_overflows = overflows.lost();
    share_out(job, prepared, line->runs(), station.track(), station.workpiece().points(), out);
    return out;
}

bool moves(const parts::ConveyorSettings& track) {
    return std::any_of(track.profile.begin(), track.profile.end(),
                       [](const parts::VelocityPoint& p) { return p.velocity != 0; });
}

/// Returns the error of a job with waits whose belt is so fast that marks leave the field before they are finished.
Result<void> refuse_too_fast(const MarkingJob& job, const Quick& now, const MarkingOutcome& out) {
    const std::string fast = job.belt.profile.empty() ? fmt::format("{:g} mm/s", std::fabs(job.belt.velocity))
                                                      : "the velocities of the profile";
    const std::string slow = job.belt.profile.empty()
                                 ? fmt::format("{:.5g} mm/s", *out.fits_factor * std::fabs(job.belt.velocity))
                                 : fmt::format("{:.4g} times them", *out.fits_factor);
    return fail(ErrorKind::refused,
                fmt::format("The belt is too fast: at {} marks leave the field by up to {:.3f} mm before they are "
                            "finished, even with waits. The limit is {}. Nothing was marked. Slow the belt down, raise "
                            "the mark and jump speeds, or set wait_mode = \"none\" in [fly] to run the job anyway.",
                            fast, now.beyond_mm, slow));
}

}  // namespace

Result<MarkingOutcome> run_job(const MarkingJob& job, const Prepared& prepared, const RunObserver& watch) {
    MarkingOutcome out;
    out.notes = prepared.notes;
    out.drawing_mm = length_of(prepared.drawing);
    out.strokes = prepared.drawing.strokes.size();
    out.elements = element_count(prepared.drawing);
    out.field = prepared.field();
    const Box box = box_of(prepared.drawing);
    const bool waits = out.waits = job.fly.wait_mode != WaitMode::none;
    out.drawing_in_field = waits || (box.low.x >= out.field.low.x && box.low.y >= out.field.low.y &&
                                     box.high.x <= out.field.high.x && box.high.y <= out.field.high.y);
    const ConveyorTracking with = following_of(job);
    ConveyorTracking without = with;
    without.corrects = false;
    const bool follows = with.mode != FlyMode::off && moves(with.track);
    MOTIONRACK_TRY(const Quick quick, run_quick(job, prepared, 1, watch));
    FitSearch search(job, prepared, watch);
    if (waits && quick.beyond_mm > 0) {
        MOTIONRACK_CHECK(search.find(quick, out));
        MOTIONRACK_CHECK(refuse_too_fast(job, quick, out));
    }
    const auto progress = [&](double begin, double share) -> std::function<void(double)> {
        if (!watch.progress) return {};
        return [&watch, begin, share](double part) { watch.progress(begin + share * std::min(part, 1.0)); };
    };
    const double ticks = quick.ticks + 1;
    MOTIONRACK_TRY(out.on, mark_once(job, prepared, with, ticks, progress(0, follows ? marked_at / 2 : 1), watch));
    if (!follows) return out;
    MOTIONRACK_TRY(out.off, mark_once(job, prepared, without, ticks, progress(marked_at / 2, marked_at / 2), watch));
    MOTIONRACK_CHECK(search.find(quick, out));
    return out;
}

}  // namespace motionrack::mark
