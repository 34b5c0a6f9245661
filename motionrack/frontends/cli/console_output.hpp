// Lines for standard output from threads that must not block on its reader.
//
//   any thread ──say──► [ 200 lines ] ──► printing thread ──write(2)──► standard output
#pragma once

#include <memory>
#include <string>

namespace motionrack::cli {

class ConsoleOutput {
  public:
    /// Maximum number of buffered lines; drops the oldest beyond it.
    static constexpr std::size_t max_lines = 200;

    ConsoleOutput();
    /// Waits up to a second for the remaining lines.
    ~ConsoleOutput();
    ConsoleOutput(const ConsoleOutput&) = delete;
    ConsoleOutput& operator=(const ConsoleOutput&) = delete;

    /// Queues a line, from any thread. Never blocks on the reader and never fails.
    void write_line(std::string line);

  private:
    struct Queue;
    static void print(Queue& queue);
    std::shared_ptr<Queue>
        queue_;  ///< the thread owns it too: a blocked reader keeps both alive until the process ends
};

}  // namespace motionrack::cli
