// Runs the points of a sweep without a row, on threads of this process.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <motionrack/base/result.hpp>
#include <motionrack/sweep/results.hpp>
#include <string>

namespace motionrack::sweep {

inline constexpr int max_jobs = 256;

struct WorkProgress {
    std::int64_t done = 0;    ///< points with a row
    std::int64_t points = 0;  ///< total
    double seconds_left = 0;  ///< estimated from the points done so far
};
/// Returns "12 of 200 points, 1 min 5 s left".
std::string progress_text(const WorkProgress& progress);

/// Estimates the remaining time.
class WorkClock {
  public:
    explicit WorkClock(const Results& results);
    /// Returns the progress with the remaining time. Call after each row.
    WorkProgress now(const Results& results) const;

  private:
    std::int64_t before_, began_ms_;
};

/// Runs every point on its own rack, in point order, `jobs` (1 .. max_jobs) at a time. `stop` ends them between two
/// simulated instants; `progress` is called from any thread but never concurrently. Errors: stopped; io as
/// Results::add; those of run_point. Rows added before an error are kept.
Result<void> run_here(const Sweep& sweep, Results& results, int jobs, const std::atomic<bool>& stop,
                      const std::function<void(const WorkProgress&)>& progress);

}  // namespace motionrack::sweep
