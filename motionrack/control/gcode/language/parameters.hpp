// What a program keeps in # parameters, and in which call it may see them.
#pragma once

#include <array>
#include <map>
#include <motionrack/control/gcode/language/expression_parser.hpp>
#include <span>
#include <vector>

namespace motionrack::control::gcode {

/// A call has this many arguments at most; they are #1 to #30 of its own.
inline constexpr int max_arguments = 30;
/// Calls in calls.
inline constexpr int max_call_depth = 100;
/// Named parameters, global ones or those of one call.
inline constexpr std::size_t max_names = 1000;

/// Names that begin with '_' are seen everywhere, others only in the call that set them.
inline bool is_global(std::string_view name) {
    return name.starts_with('_');
}

/// The parameters that a program sets itself; those of the machine are not here. Copies are independent.
class Parameters {
  public:
    /// 1 .. last_parameter; 0 if it was never set.
    double numbered(int number) const { return numbered_.empty() ? 0 : numbered_[static_cast<std::size_t>(number)]; }
    void set(int number, double value);
    std::optional<double> named(std::string_view name) const;
    void set(const std::string& name, double value);
    /// How many more names there may be where this one goes.
    std::size_t room_for(std::string_view name) const;

    /// A call begins: #1 .. #30 are its arguments, or 0, and it has names of its own. False: max_call_depth.
    bool enter(std::span<const double> arguments);
    /// The same without arguments: #1 .. #30 are those of the caller.
    bool enter();
    /// It ends: #1 .. #30 are as before, if they were its own; what it returned, if anything.
    void leave(std::optional<double> returned);
    /// 0: the main program.
    int level() const { return static_cast<int>(calls_.size()); }
    /// Of the last call that ended.
    std::optional<double> returned() const { return returned_; }
    /// A new call has not returned anything.
    void forget_returned() { returned_.reset(); }

  private:
    using Names = std::map<std::string, double, std::less<>>;
    struct Call {
        std::array<double, max_arguments> kept = {};
        bool keeps = false;  ///< #1 .. #30 of the caller are in `kept`
        Names names;
    };

    const Names& names_of(std::string_view name) const {
        return is_global(name) ? global_ : calls_.empty() ? main_ : calls_.back().names;
    }

    std::vector<double> numbered_;  ///< empty until one is set
    Names global_;
    Names main_;
    std::vector<Call> calls_;
    std::optional<double> returned_;
};

}  // namespace motionrack::control::gcode
