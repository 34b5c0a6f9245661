// Published data of the motion thread: status of the machine and values of channels. Created between two runs of the
// kernel, shared, immutable.
#pragma once

#include <cstdint>
#include <functional>
#include <motionrack/base/time.hpp>
#include <motionrack/operate/status.hpp>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::panel {

/// The machine at one instant.
class StatusSnapshot {
  public:
    /// `write` creates the JSON text; it must not read data that changes.
    StatusSnapshot(operate::Status status, std::function<std::string(const operate::Status&)> write)
        : status_(std::move(status)), write_(std::move(write)) {}

    std::int64_t sequence() const { return status_.sequence; }
    Instant at() const { return status_.at; }
    const operate::Status& status() const { return status_; }
    /// Returns the status as JSON text; encodes it once, in the thread of the first caller.
    const std::string& status_text() const;

  private:
    operate::Status status_;
    std::function<std::string(const operate::Status&)> write_;
    mutable std::once_flag written_;
    mutable std::string text_;
};

/// Values of a list of channels at one instant, in the list's order. NaN: not available at present.
struct Values {
    std::int64_t sequence = 0;  ///< number of the status that they belong to
    Instant at{};
    std::vector<double> numbers;
};

}  // namespace motionrack::panel
