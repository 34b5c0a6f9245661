// The points of sweeps on a NATS server, and their rows.
//
//   stream MOTIONRACK_POINTS (work queue)                         stream MOTIONRACK_ROWS
//   motionrack.points.VERSION.SWEEP.KEY                           motionrack.rows.VERSION.SWEEP.KEY
//
//   gatherer ──offer──► point ──take──► worker ──answer──► row ──rows──► gatherer
//                         ▲               │ renew, while it runs
//                         └── after 5 s ──┘ of silence: a worker that died; another one gets it
//
// Each subject takes one message and refuses the next, so a point stands in the queue once however often it is offered,
// and there is one row a key however many workers made it. (Message ids would do the same for some minutes only, and
// would refuse a point that is offered again on purpose.) A worker answers first and gives the point back as done then:
// what is lost between the two is made once more and refused.
#pragma once

#include <cstdint>
#include <memory>
#include <motionrack/base/result.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::nats {

/// A point is given to another worker after so long a silence; a worker gives signs of life three times as often.
inline constexpr std::int64_t silence_ms = 5000;
/// Points and rows that nobody fetches are dropped after so long.
inline constexpr std::int64_t kept_days = 7;

/// A message that says what became of a point.
struct Answer {
    std::string key, text;
};

/// A point that a worker has, until it is done or given back. Any thread may renew it.
class LeasedPoint {
  public:
    virtual ~LeasedPoint() = default;
    virtual std::string_view text() const = 0;
    virtual std::string sweep() const = 0;
    /// How often it was given to a worker, this time included.
    virtual std::uint64_t times() const = 0;
    /// A sign of life.
    virtual void renew() = 0;
    /// It leaves the queue. Errors: io.
    virtual Result<void> done() = 0;
    /// Another worker gets it at once.
    virtual void give_back() = 0;
};

/// A connection with both streams. While the server is away calls wait for some seconds and fail with io; it is found
/// again by itself.
class Queue {
  public:
    /// `url`: nats://HOST:4222, nats://USER:PASSWORD@HOST:4222. Errors: io, there is no server, or it has no JetStream.
    static Result<std::unique_ptr<Queue>> open(const std::string& url);
    virtual ~Queue() = default;

    // ---- gatherer; one thread
    /// Puts a point into the queue, if it is not in it. Errors: io; refused, it is longer than the server's messages
    /// may be.
    virtual Result<void> offer(const std::string& sweep, const std::string& key, std::string_view text) = 0;
    /// The next answers for this sweep, from the first one on the server on; waits at most `wait_ms` for one. Errors:
    /// io.
    virtual Result<std::vector<Answer>> answers(const std::string& sweep, std::int64_t wait_ms) = 0;
    /// Removes what is left of a sweep, or of one point of it. Errors: io.
    virtual Result<void> forget(const std::string& sweep, const std::string& key = "*") = 0;
    /// Whether the server was away since this was asked last: then it may have lost something, and answers begins anew.
    virtual bool came_back() = 0;

    // ---- worker; one thread
    /// The next point of any sweep; waits at most `wait_ms` for one. Errors: io.
    virtual Result<std::unique_ptr<LeasedPoint>> take(std::int64_t wait_ms) = 0;
    /// The answer for a point; another one with this key is left out. Errors: io.
    virtual Result<void> answer(const std::string& sweep, const std::string& key, std::string_view text) = 0;
};

/// A server's address as it may be shown.
std::string without_password(const std::string& url);

}  // namespace motionrack::nats
