// Takes points, runs them and answers them.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <motionrack/nats/distributed_sweep.hpp>
#include <motionrack/nats/queue.hpp>
#include <mutex>
#include <thread>

namespace motionrack::nats {

namespace {

using WorkClock = std::chrono::steady_clock;

/// Renews the leases of running points on a separate thread.
class Signs {
  public:
    Signs() : thread_([this] { run(); }) {}
    ~Signs() {
        {
            const std::lock_guard lock(mutex_);
            over_ = true;
        }
        wake_.notify_all();
        thread_.join();
    }
    void add(LeasedPoint& point) {
        const std::lock_guard lock(mutex_);
        points_.push_back(&point);
    }
    void remove(LeasedPoint& point) {
        const std::lock_guard lock(mutex_);
        points_.erase(std::find(points_.begin(), points_.end(), &point));
    }

  private:
    void run() {
        std::unique_lock lock(mutex_);
        while (!wake_.wait_for(lock, std::chrono::milliseconds(silence_ms / 3), [this] { return over_; }))
            for (LeasedPoint* point : points_) point->renew();
    }
    std::mutex mutex_;
    std::condition_variable wake_;
    std::vector<LeasedPoint*> points_;
    bool over_ = false;
    std::thread thread_;
};

class Worker {
  public:
    Worker(const WorkerSettings& settings, const std::atomic<bool>& stop, const std::function<void(std::int64_t)>& done)
        : settings_(settings), stop_(stop), done_(done) {}

    Result<void> run() {
        std::vector<std::unique_ptr<Queue>> queues;
        for (int i = 0; i < settings_.jobs; ++i) {
            MOTIONRACK_TRY(std::unique_ptr<Queue> queue, Queue::open(settings_.url));
            queues.push_back(std::move(queue));
        }
        std::vector<std::thread> crew;
        for (const auto& queue : queues) crew.emplace_back([this, &queue] { take_points(*queue); });
        for (std::thread& one : crew) one.join();
        if (stop_) return fail(ErrorKind::stopped, "Stopped on request.");
        return ended_;
    }

  private:
    void take_points(Queue& queue) {
        while (!stop_ && !over_) {
            const Result<bool> some = one(queue);
            const std::lock_guard lock(mutex_);
            if (!some) {
                if (ended_) ended_ = tl::unexpected<Error>(some.error());
                over_ = true;
            } else if (*some) {
                last_ = WorkClock::now();
                ++count_;
                if (done_) done_(count_);
            } else if (settings_.idle_s > 0 &&
                       std::chrono::duration<double>(WorkClock::now() - last_).count() > settings_.idle_s) {
                return;
            }
        }
    }

    Result<bool> one(Queue& queue) {
        MOTIONRACK_TRY(const std::unique_ptr<LeasedPoint> point, queue.take(500));
        if (!point) return false;
        const std::string key = sweep::key_of(point->text());
        signs_.add(*point);
        const Result<sweep::Row> row = run_point(*point);
        signs_.remove(*point);
        if (!row && row.error().kind == ErrorKind::stopped) {
            point->give_back();
            return false;
        }
        const Result<void> answered = queue.answer(point->sweep(), key, row ? text_of(*row) : text_of(row.error()));
        // Without a confirmed answer another worker runs the point again; its answer is the same.
        if (answered) (void)point->done();
        return answered.has_value();
    }

    Result<sweep::Row> run_point(const LeasedPoint& point) {
        if (point.times() > max_times)
            return fail(ErrorKind::refused, fmt::format("{} workers died or were killed while running it. It was "
                                                        "removed from the queue; run it alone to find the cause.",
                                                        max_times));
        try {
            return sweep::run_point(point.text(), &stop_);
        } catch (const std::exception& e) {
            return fail(ErrorKind::io, fmt::format("a worker could not run it: {}.", e.what()));
        }
    }

    const WorkerSettings& settings_;
    const std::atomic<bool>& stop_;
    const std::function<void(std::int64_t)>& done_;
    Signs signs_;
    std::mutex mutex_;
    std::atomic<bool> over_{false};
    std::int64_t count_ = 0;
    WorkClock::time_point last_ = WorkClock::now();
    Result<void> ended_;
};

}  // namespace

Result<void> work(const WorkerSettings& settings, const std::atomic<bool>& stop,
                  const std::function<void(std::int64_t done)>& done) {
    return Worker(settings, stop, done).run();
}

}  // namespace motionrack::nats
