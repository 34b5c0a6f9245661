// A sweep over several machines: one gathers, any number work.
//
//   motionrack sweep --nats ──points──► server ──► motionrack sweep-worker (any machine, as many as wanted)
//            ▲                                          │
//            └────────────────rows──────────────────────┘
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <motionrack/nats/queue.hpp>
#include <motionrack/sweep/worker.hpp>
#include <string>

namespace motionrack::nats {

/// As sweep::run_here, by workers. What was queued stays so when it is stopped; rows that come meanwhile are fetched by
/// the next one. `fresh`: forgets what the server still has of this sweep. `waits` is called when no row came for 10 s,
/// 20 s, 40 s, with the seconds. Errors: stopped; io, the server cannot be reached at the start; refused, a point is
/// too long, or killed every worker that had it.
Result<void> gather(const sweep::Sweep& sweep, sweep::Results& results, const std::string& url, bool fresh,
                    const std::atomic<bool>& stop, const std::function<void(const sweep::WorkProgress&)>& progress,
                    const std::function<void(std::int64_t seconds)>& waits);

struct WorkerSettings {
    std::string url;
    int jobs = 1;       ///< points at the same time, 1 .. sweep::max_jobs
    double idle_s = 0;  ///< ends when there was nothing to do for so long; 0: never
};

/// Takes points and answers them until it is stopped; a point that it has then goes to another worker at once. `done`
/// is called after each point with how many there were, by any thread, one at a time. Errors: stopped; io, the server
/// cannot be reached at the start.
Result<void> work(const WorkerSettings& settings, const std::atomic<bool>& stop,
                  const std::function<void(std::int64_t done)>& done);

/// A worker answers a point that was given to so many workers before, and run by none to its end, with a trouble
/// instead of trying it.
inline constexpr std::uint64_t max_times = 5;

/// A row, or a sentence about why there is none, as a message; and back. Errors: invalid_input, it is no such message;
/// refused, it is a sentence.
std::string text_of(const sweep::Row& row);
std::string text_of(const Error& error);
Result<sweep::Row> read_answer(std::string_view text);

/// What the rows of a sweep are found by: a hash of all its keys.
std::string name_of(const sweep::Sweep& sweep);

}  // namespace motionrack::nats
