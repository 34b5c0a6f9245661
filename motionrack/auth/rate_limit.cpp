// Token buckets per key.
#include <algorithm>
#include <motionrack/auth/rate_limit.hpp>

namespace motionrack::auth {

RateLimit::Bucket& RateLimit::bucket(std::string_view key, Time now) {
    const auto fill = [&](Bucket& one) {
        const double passed = std::chrono::duration<double>(now - one.at).count();
        if (passed > 0) {
            one.left = std::min(at_once_, one.left + passed * per_second_);
            one.at = now;
        }
    };
    auto found = buckets_.find(key);
    if (found == buckets_.end() && buckets_.size() >= max_keys_) {
        for (auto it = buckets_.begin(); it != buckets_.end();) {
            fill(it->second);
            it = it->second.left >= at_once_ ? buckets_.erase(it) : std::next(it);
        }
        if (buckets_.size() >= max_keys_) key = "", found = buckets_.find(key);
    }
    if (found == buckets_.end()) found = buckets_.emplace(std::string(key), Bucket{at_once_, now}).first;
    fill(found->second);
    return found->second;
}

bool RateLimit::there_is(std::string_view key, Time now) {
    return bucket(key, now).left >= 1;
}

bool RateLimit::take(std::string_view key, Time now) {
    Bucket& one = bucket(key, now);
    if (one.left < 1) return false;
    one.left -= 1;
    return true;
}

}  // namespace motionrack::auth
