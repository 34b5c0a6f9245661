// A thread for long work that does not access the rack: planning, encoding, reading the journal.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace motionrack::panel {

class BackgroundWorker {
  public:
    static constexpr std::size_t max_waiting = 32;

    BackgroundWorker() : thread_([this] { work(); }) {}
    /// Drops pending work.
    ~BackgroundWorker() {
        {
            const std::lock_guard<std::mutex> alone(lock_);
            quit_ = true;
        }
        wake_up_.notify_one();
        thread_.join();
    }
    BackgroundWorker(const BackgroundWorker&) = delete;
    BackgroundWorker& operator=(const BackgroundWorker&) = delete;

    /// Queues `work`; any thread, never waits. Returns false, without accepting `work`, if max_waiting are queued.
    bool post(std::function<void()> work) {
        {
            const std::lock_guard<std::mutex> alone(lock_);
            if (waiting_.size() >= max_waiting) return false;
            waiting_.push_back(std::move(work));
        }
        wake_up_.notify_one();
        return true;
    }

  private:
    void work() {
        for (;;) {
            std::function<void()> one;
            {
                std::unique_lock<std::mutex> alone(lock_);
                wake_up_.wait(alone, [this] { return quit_ || !waiting_.empty(); });
                if (quit_) return;
                one = std::move(waiting_.front());
                waiting_.pop_front();
            }
            one();
        }
    }

    std::mutex lock_;
    std::condition_variable wake_up_;
    std::deque<std::function<void()>> waiting_;
    bool quit_ = false;
    std::thread thread_;
};

}  // namespace motionrack::panel
