// Points and rows of sweeps on a NATS server.
//
//   stream MOTIONRACK_POINTS (work queue)                         stream MOTIONRACK_ROWS
//   motionrack.points.VERSION.SWEEP.KEY                           motionrack.rows.VERSION.SWEEP.KEY
//
//  coordinator ──offer──► point ──take──► worker ──answer──► row ──rows──► coordinator
//                           ▲               │ renew, while it runs
//                           └── after 5 s ──┘ without renewal: the worker died; another one takes the point
//
// Each subject holds one message and rejects further ones. A point is therefore queued once however often it is
// offered, and each key has one row however many workers computed it. (Message ids would do so only for some minutes,
// and would reject a point that is offered again on purpose.) A worker answers before it acknowledges the point. If it
// fails in between, the point runs again and the duplicate row is rejected.
#pragma once

#include <cstdint>
#include <memory>
#include <motionrack/base/result.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::nats {

/// Time without renewal after which a point goes to another worker. Workers renew three times as often.
inline constexpr std::int64_t silence_ms = 5000;
/// Days after which unfetched points and rows are dropped.
inline constexpr std::int64_t kept_days = 7;

/// Message with the result of a point.
struct PointResult {
    std::string key, text;
};

/// A point leased to a worker, until it is done or returned. Any thread may renew it.
class LeasedPoint {
  public:
    virtual ~LeasedPoint() = default;
    virtual std::string_view text() const = 0;
    virtual std::string sweep() const = 0;
    /// Number of deliveries to workers, including this one.
    virtual std::uint64_t times() const = 0;
    /// Renews the lease.
    virtual void renew() = 0;
    /// Removes the point from the queue. Errors: io.
    virtual Result<void> done() = 0;
    /// Returns the point to the queue; another worker can take it at once.
    virtual void give_back() = 0;
};

/// Connection with both streams. While the server is unreachable, calls wait some seconds and fail with io; the
/// connection is re-established automatically.
class Queue {
  public:
    /// `url`: nats://HOST:4222, nats://USER:PASSWORD@HOST:4222. Errors: io if the server is unreachable or lacks
    /// JetStream.
    static Result<std::unique_ptr<Queue>> open(const std::string& url);
    virtual ~Queue() = default;

    // ---- coordinator; one thread
    /// Queues a point unless it is queued already. Errors: io; refused if it exceeds the server's maximum message size.
    virtual Result<void> offer(const std::string& sweep, const std::string& key, std::string_view text) = 0;
    /// Returns the next answers of this sweep, starting with the oldest on the server; waits at most `wait_ms` for one.
    /// Errors: io.
    virtual Result<std::vector<PointResult>> answers(const std::string& sweep, std::int64_t wait_ms) = 0;
    /// Removes the remaining data of a sweep, or of one of its points. Errors: io.
    virtual Result<void> forget(const std::string& sweep, const std::string& key = "*") = 0;
    /// Returns true if the server was unreachable since the last call. Data may be lost then, and answers() starts
    /// again.
    virtual bool came_back() = 0;

    // ---- worker; one thread
    /// Takes the next point of any sweep; waits at most `wait_ms` for one. Errors: io.
    virtual Result<std::unique_ptr<LeasedPoint>> take(std::int64_t wait_ms) = 0;
    /// Publishes the answer for a point; a second one with this key is ignored. Errors: io.
    virtual Result<void> answer(const std::string& sweep, const std::string& key, std::string_view text) = 0;
};

/// Returns a server address without its password.
std::string without_password(const std::string& url);

}  // namespace motionrack::nats
