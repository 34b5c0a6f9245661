#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <motionrack/frontends/cli/console_output.hpp>
#include <mutex>
#include <thread>

namespace motionrack::cli {

struct ConsoleOutput::Queue {
    std::mutex lock;
    std::condition_variable changed;
    std::deque<std::string> lines;
    bool quit = false, ended = false;
};

ConsoleOutput::ConsoleOutput() : queue_(std::make_shared<Queue>()) {
    std::thread([queue = queue_] { print(*queue); }).detach();
}

ConsoleOutput::~ConsoleOutput() {
    std::unique_lock<std::mutex> guard(queue_->lock);
    queue_->quit = true;
    queue_->changed.notify_all();
    queue_->changed.wait_for(guard, std::chrono::seconds(1), [this] { return queue_->ended; });
}

void ConsoleOutput::write_line(std::string line) {
    {
        const std::lock_guard<std::mutex> guard(queue_->lock);
        if (queue_->lines.size() >= max_lines) queue_->lines.pop_front();
        queue_->lines.push_back(std::move(line) + "\n");
    }
    queue_->changed.notify_all();
}

/// Prints queued lines with write(2): stdio would hold its lock while a reader blocks.
void ConsoleOutput::print(Queue& queue) {
    std::unique_lock<std::mutex> guard(queue.lock);
    for (;;) {
        queue.changed.wait(guard, [&queue] { return queue.quit || !queue.lines.empty(); });
        if (queue.lines.empty()) break;
        const std::string line = std::move(queue.lines.front());
        queue.lines.pop_front();
        guard.unlock();
        for (std::size_t done = 0; done < line.size();) {
            const ssize_t some = ::write(STDOUT_FILENO, line.data() + done, line.size() - done);
            if (some < 0 && errno == EINTR) continue;
            if (some <= 0) break;
            done += static_cast<std::size_t>(some);
        }
        guard.lock();
    }
    queue.ended = true;
    queue.changed.notify_all();
}

}  // namespace motionrack::cli
