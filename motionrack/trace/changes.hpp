// Changes of signals in the order of time, out of a VCD file or a CSV table of changes (time_s,signal,value).
#pragma once

#include <cstdint>
#include <memory>
#include <motionrack/base/result.hpp>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace motionrack::trace {

/// Signals of several files by their names.
class SignalNames {
  public:
    std::size_t number(const std::string& name) {
        const auto [found, made] = numbers_.try_emplace(name, names_.size());
        if (made) names_.push_back(name);
        return found->second;
    }
    const std::string& name(std::size_t number) const { return names_[number]; }
    std::size_t size() const { return names_.size(); }

  private:
    std::unordered_map<std::string, std::size_t> numbers_;
    std::vector<std::string> names_;
};

struct Change {
    std::int64_t at_ps = 0;
    std::size_t signal = 0;
    std::string value;  ///< "0", "1", "x", a whole or real number; of wider ones in binary without zeros in front
};

class ChangeSource {
  public:
    virtual ~ChangeSource() = default;
    /// False at the end. Errors: io, invalid_input with its line (no change, a time before the last one).
    virtual Result<bool> next(Change& change) = 0;
    /// Signals that are declared, whether they change or not.
    const std::vector<std::size_t>& declared() const { return declared_; }
    virtual double part() const = 0;
    /// It does not end where a line does.
    virtual bool cut() const = 0;

  protected:
    std::vector<std::size_t> declared_;
};

/// Reads the head. Errors: io, invalid_input.
Result<std::unique_ptr<ChangeSource>> open_vcd_changes(const std::string& path, SignalNames& names);
Result<std::unique_ptr<ChangeSource>> open_csv_changes(const std::string& path, SignalNames& names);

/// Seconds in decimal as whole ps, exactly; false: it is no such time, or beyond 100 days.
bool read_ps(std::string_view seconds, std::int64_t& ps);

}  // namespace motionrack::trace
