// A sweep over several machines: one coordinator, any number of workers.
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

/// As sweep::run_here, with remote workers. On a stop, queued points stay queued and the next call fetches their rows.
/// `fresh`: first removes the server's data of this sweep. `waits` is called with the seconds when no row has arrived
/// for 10 s, 20 s, 40 s. Errors: stopped; io if the server cannot be reached at the start; refused if a point is too
/// long or killed every worker that ran it.
Result<void> gather(const sweep::Sweep& sweep, sweep::Results& results, const std::string& url, bool fresh,
                    const std::atomic<bool>& stop, const std::function<void(const sweep::WorkProgress&)>& progress,
                    const std::function<void(std::int64_t seconds)>& waits);

struct WorkerSettings {
    std::string url;
    int jobs = 1;       ///< concurrent points, 1 .. sweep::max_jobs
    double idle_s = 0;  ///< ends after this idle time; 0: never
};

/// Takes points and answers them until stopped; unfinished points go to another worker at once. `done` is called after
/// each point with the number of points, from any thread but never concurrently. Errors: stopped; io if the server
/// cannot be reached at the start.
Result<void> work(const WorkerSettings& settings, const std::atomic<bool>& stop,
                  const std::function<void(std::int64_t done)>& done);

/// Maximum deliveries of a point that no worker completed. A worker then answers with an error instead of running it.
inline constexpr std::uint64_t max_times = 5;

/// Converts a row, or the sentence of an error, to a message and back. Errors: invalid_input if the message is invalid;
/// refused if it is a sentence.
std::string text_of(const sweep::Row& row);
std::string text_of(const Error& error);
Result<sweep::Row> read_answer(std::string_view text);

/// Key of a sweep's rows: a hash of all its keys.
std::string name_of(const sweep::Sweep& sweep);

}  // namespace motionrack::nats
