// Rate limit per key: a burst, then a rate per second.
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>

namespace motionrack::auth {

/// One token bucket per key, refilled over time. Keeps at most `max_keys`: drops full buckets first. If none is full,
/// all unknown keys share one bucket.
class RateLimit {
  public:
    using Time = std::chrono::steady_clock::time_point;

    RateLimit(double at_once, double per_second, std::size_t max_keys = 10'000)
        : at_once_(at_once), per_second_(per_second), max_keys_(max_keys) {}

    /// Takes one token. Returns false if the bucket is empty.
    bool take(std::string_view key, Time now);
    /// Returns true if a token is available; takes none.
    bool there_is(std::string_view key, Time now);
    std::size_t keys() const { return buckets_.size(); }

  private:
    struct Bucket {
        double left;
        Time at;
    };
    Bucket& bucket(std::string_view key, Time now);

    double at_once_, per_second_;
    std::size_t max_keys_;
    std::map<std::string, Bucket, std::less<>> buckets_;
};

}  // namespace motionrack::auth
