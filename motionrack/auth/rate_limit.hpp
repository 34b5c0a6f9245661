// So many at once, then so many a second, each key by itself.
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>

namespace motionrack::auth {

/// A bucket of tries a key, which fills again with time. Keeps at most `max_keys`: full buckets are forgotten, and
/// while there are none, keys that are not known share one bucket.
class RateLimit {
  public:
    using Time = std::chrono::steady_clock::time_point;

    RateLimit(double at_once, double per_second, std::size_t max_keys = 10'000)
        : at_once_(at_once), per_second_(per_second), max_keys_(max_keys) {}

    /// Takes one try. False: there is none.
    bool take(std::string_view key, Time now);
    /// Whether there is one; takes none.
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
