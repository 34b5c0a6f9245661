// Doing the points of a sweep that have no row yet, on threads of this process.
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
    std::int64_t done = 0;    ///< points that have a row
    std::int64_t points = 0;  ///< of all
    double seconds_left = 0;  ///< as far as it can be told from what was done so far
};
/// "12 of 200 points, 1 min 5 s left".
std::string progress_text(const WorkProgress& progress);

/// Tells how long what is left will take.
class WorkClock {
  public:
    explicit WorkClock(const Results& results);
    /// After each row.
    WorkProgress now(const Results& results) const;

  private:
    std::int64_t before_, began_ms_;
};

/// Every point runs on a rack of its own, in the order of the points, `jobs` (1 .. max_jobs) of them at the same time.
/// `stop` ends them between two instants of their racks; `progress` is called by any of the threads, one at a time.
/// Errors: stopped; io, as Results::add; those of run_point. Rows that were added before stay.
Result<void> run_here(const Sweep& sweep, Results& results, int jobs, const std::atomic<bool>& stop,
                      const std::function<void(const WorkProgress&)>& progress);

}  // namespace motionrack::sweep
