// Signal changes in time order, read from a VCD file or a CSV table (time_s,signal,value).
#pragma once

#include <cstdint>
#include <memory>
#include <motionrack/base/result.hpp>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace motionrack::trace {

/// Signals of several files by name.
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

struct SignalChange {
    std::int64_t at_ps = 0;
    std::size_t signal = 0;
    std::string value;  ///< "0", "1", "x", an integer or real number; wider values in binary without leading zeros
};

class ChangeSource {
  public:
    virtual ~ChangeSource() = default;
    /// Returns false at the end. Errors: io, invalid_input with the line (malformed change, decreasing time).
    virtual Result<bool> next(SignalChange& change) = 0;
    /// Declared signals, including those that never change.
    const std::vector<std::size_t>& declared() const { return declared_; }
    virtual double part() const = 0;
    /// Returns true if the file ends inside a line.
    virtual bool cut() const = 0;

  protected:
    std::vector<std::size_t> declared_;
};

/// Opens the file and reads its head. Errors: io, invalid_input.
Result<std::unique_ptr<ChangeSource>> open_vcd_changes(const std::string& path, SignalNames& names);
Result<std::unique_ptr<ChangeSource>> open_csv_changes(const std::string& path, SignalNames& names);

/// Converts decimal seconds to whole ps, exactly; false if the text is not a time or exceeds 100 days.
bool read_ps(std::string_view seconds, std::int64_t& ps);

}  // namespace motionrack::trace
