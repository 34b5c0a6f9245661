// Threads that run the points.
#include <fmt/format.h>

#include <chrono>
#include <motionrack/sweep/worker.hpp>
#include <mutex>
#include <thread>

namespace motionrack::sweep {

namespace {

std::int64_t now_ms() {
    return std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

class Crew {
  public:
    Crew(const Sweep& sweep, Results& results, const std::atomic<bool>& stop,
         const std::function<void(const WorkProgress&)>& progress)
        : sweep_(sweep),
          results_(results),
          stop_(stop),
          progress_(progress),
          clock_(results),
          todo_(results.missing()) {}

    Result<void> run(int jobs) {
        const auto threads = std::min<std::size_t>(static_cast<std::size_t>(jobs), todo_.size());
        std::vector<std::thread> crew;
        for (std::size_t i = 0; i < threads; ++i) crew.emplace_back([this] { take_points(); });
        for (std::thread& one : crew) one.join();
        if (ended_ && results_.done() < sweep_.points()) return fail(ErrorKind::stopped, "Stopped on request.");
        return ended_;
    }

  private:
    void take_points() {
        for (std::size_t at = next_++; at < todo_.size() && !stop_ && !halt_; at = next_++) {
            const Result<void> done = one(todo_[at]);
            if (done) continue;
            const std::lock_guard lock(mutex_);
            if (ended_) ended_ = done;
            halt_ = true;
        }
    }

    Result<void> one(std::int64_t point) {
        try {
            MOTIONRACK_TRY(Row row, run_point(text_of(sweep_.point(point)), &stop_));
            const std::lock_guard lock(mutex_);
            MOTIONRACK_CHECK(results_.add(point, std::move(row)));
            if (progress_) progress_(clock_.now(results_));
            return {};
        } catch (const std::exception& e) {
            return fail(
                ErrorKind::io,
                fmt::format(
                    "Point {} could not be run: {}. Rows that were done are kept; take fewer jobs if memory is short.",
                    point, e.what()));
        }
    }

    const Sweep& sweep_;
    Results& results_;
    const std::atomic<bool>& stop_;
    const std::function<void(const WorkProgress&)>& progress_;
    WorkClock clock_;
    std::vector<std::int64_t> todo_;
    std::atomic<std::size_t> next_{0};
    std::atomic<bool> halt_{false};
    std::mutex mutex_;
    Result<void> ended_;  // first error
};

}  // namespace

std::string progress_text(const WorkProgress& progress) {
    std::string out = fmt::format("{} of {} points", progress.done, progress.points);
    const auto seconds = static_cast<std::int64_t>(progress.seconds_left + 0.5);
    if (progress.done >= progress.points) return out;
    if (seconds >= 3600) return out + fmt::format(", {} h {} min left", seconds / 3600, seconds / 60 % 60);
    if (seconds >= 60) return out + fmt::format(", {} min {} s left", seconds / 60, seconds % 60);
    return out + fmt::format(", {} s left", seconds);
}

WorkClock::WorkClock(const Results& results) : before_(results.done()), began_ms_(now_ms()) {}

WorkProgress WorkClock::now(const Results& results) const {
    WorkProgress out{results.done(), results.points(), 0};
    const std::int64_t since = out.done - before_;
    if (since > 0)
        out.seconds_left = static_cast<double>(now_ms() - began_ms_) * 1e-3 *
                           static_cast<double>(out.points - out.done) / static_cast<double>(since);
    return out;
}

Result<void> run_here(const Sweep& sweep, Results& results, int jobs, const std::atomic<bool>& stop,
                      const std::function<void(const WorkProgress&)>& progress) {
    return Crew(sweep, results, stop, progress).run(jobs);
}

}  // namespace motionrack::sweep
