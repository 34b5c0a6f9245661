// Lines for standard output from threads that must not wait for its reader.
//
//   any thread ──say──► [ 200 lines ] ──► printing thread ──write(2)──► standard output
#pragma once

#include <memory>
#include <string>

namespace motionrack::cli {

class LineOutput {
  public:
    /// Lines that wait for the reader; of more than these the oldest are dropped.
    static constexpr std::size_t max_lines = 200;

    LineOutput();
    /// Waits up to a second for the lines that are left.
    ~LineOutput();
    LineOutput(const LineOutput&) = delete;
    LineOutput& operator=(const LineOutput&) = delete;

    /// Any thread; never waits for the reader, never fails.
    void say(std::string line);

  private:
    struct Queue;
    static void print(Queue& queue);
    std::shared_ptr<Queue> queue_;  ///< a reader that stands keeps the thread, and with it the queue, until the end
};

}  // namespace motionrack::cli
