// Queues points and collects rows until all are complete.
#include <fmt/format.h>

#include <chrono>
#include <motionrack/nats/distributed_sweep.hpp>
#include <motionrack/nats/queue.hpp>
#include <unordered_map>

namespace motionrack::nats {

namespace {

using GatherClock = std::chrono::steady_clock;
constexpr auto min_wait = std::chrono::seconds(10);

class Gatherer {
  public:
    Gatherer(const sweep::Sweep& sweep, sweep::Results& results, Queue& queue, const std::atomic<bool>& stop,
             const std::function<void(const sweep::WorkProgress&)>& progress,
             const std::function<void(std::int64_t)>& waits)
        : sweep_(sweep),
          results_(results),
          queue_(queue),
          stop_(stop),
          progress_(progress),
          waits_(waits),
          name_(name_of(sweep)),
          clock_(results) {
        for (std::int64_t i = 0; i < sweep.points(); ++i) points_.emplace(sweep.key(i), i);
    }

    Result<void> run(bool fresh) {
        if (fresh) MOTIONRACK_CHECK(queue_.forget(name_));
        // First, rows that arrived while no coordinator was running.
        while (!done() && !stop_) {
            MOTIONRACK_TRY(const bool some, take(300));
            if (!some) break;
        }
        MOTIONRACK_CHECK(offer());
        GatherClock::time_point last_reply = GatherClock::now();
        auto max_wait = min_wait;
        while (!done() && !stop_) {
            // Short waits, so that Ctrl-C takes effect.
            MOTIONRACK_TRY(const bool some, take(300));
            if (queue_.came_back()) MOTIONRACK_CHECK(offer());
            if (some) last_reply = GatherClock::now(), max_wait = min_wait;
            if (!some && GatherClock::now() - last_reply > max_wait) {
                if (waits_) waits_(max_wait.count());
                max_wait *= 2;
                // If another program removed rows, their points run again. All other points are queued and stay there
                // once.
                MOTIONRACK_CHECK(offer());
            }
        }
        if (!done()) return fail(ErrorKind::stopped, "Stopped on request.");
        return queue_.forget(name_);
    }

  private:
    bool done() const { return results_.done() == results_.points(); }

    /// Queues the missing points; a point already in the queue stays there once.
    Result<void> offer() {
        for (const std::int64_t point : results_.missing()) {
            if (stop_) return {};
            MOTIONRACK_CHECK(queue_.offer(name_, sweep_.key(point), sweep::text_of(sweep_.point(point))));
        }
        return {};
    }

    Result<bool> take(std::int64_t wait_ms) {
        MOTIONRACK_TRY(const std::vector<PointResult> answers, queue_.answers(name_, wait_ms));
        for (const PointResult& answer : answers) {
            const auto point = points_.find(answer.key);
            if (point == points_.end() || results_.has(point->second)) continue;
            Result<sweep::Row> row = read_answer(answer.text);
            if (!row && row.error().kind == ErrorKind::invalid_input) continue;
            if (!row) {
                // A later run of the command may retry it.
                (void)queue_.forget(name_, answer.key);
                return fail(ErrorKind::refused, fmt::format("Point {}: {}", point->second, row.error().message));
            }
            MOTIONRACK_CHECK(results_.add(point->second, std::move(*row)));
            if (progress_) progress_(clock_.now(results_));
        }
        return !answers.empty();
    }

    const sweep::Sweep& sweep_;
    sweep::Results& results_;
    Queue& queue_;
    const std::atomic<bool>& stop_;
    const std::function<void(const sweep::WorkProgress&)>& progress_;
    const std::function<void(std::int64_t)>& waits_;
    std::string name_;
    sweep::WorkClock clock_;
    std::unordered_map<std::string, std::int64_t> points_;
};

}  // namespace

Result<void> gather(const sweep::Sweep& sweep, sweep::Results& results, const std::string& url, bool fresh,
                    const std::atomic<bool>& stop, const std::function<void(const sweep::WorkProgress&)>& progress,
                    const std::function<void(std::int64_t)>& waits) {
    if (results.done() == results.points()) return {};
    MOTIONRACK_TRY(const std::unique_ptr<Queue> queue, Queue::open(url));
    return Gatherer(sweep, results, *queue, stop, progress, waits).run(fresh);
}

}  // namespace motionrack::nats
