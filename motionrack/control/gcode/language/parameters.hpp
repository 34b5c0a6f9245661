// The # parameters of a program and their scope.
#pragma once

#include <array>
#include <map>
#include <motionrack/control/gcode/language/expression_parser.hpp>
#include <span>
#include <vector>

namespace motionrack::control::gcode {

/// Maximum number of arguments of a call, its #1 to #30.
inline constexpr int max_arguments = 30;
/// Maximum depth of nested calls.
inline constexpr int max_call_depth = 100;
/// Maximum number of named parameters, globally and in each call.
inline constexpr std::size_t max_names = 1000;

/// Names that begin with '_' are global, others local to the call that set them.
inline bool is_global(std::string_view name) {
    return name.starts_with('_');
}

/// Parameters set by the program, without those of the machine. Copies are independent.
class Parameters {
  public:
    /// Returns #number, 1 .. last_parameter; 0 if it was never set.
    double numbered(int number) const { return numbered_.empty() ? 0 : numbered_[static_cast<std::size_t>(number)]; }
    void set(int number, double value);
    std::optional<double> named(std::string_view name) const;
    void set(const std::string& name, double value);
    /// Returns the number of names that can still be added in the scope of `name`.
    std::size_t capacity_for(std::string_view name) const;

    /// Starts a call with its own names and #1 .. #30 (the arguments, or 0). Returns false at max_call_depth.
    bool enter(std::span<const double> arguments);
    /// Starts a call without arguments; #1 .. #30 are those of the caller.
    bool enter();
    /// Ends a call: restores #1 .. #30 if they were local, and stores the return value, if any.
    void leave(std::optional<double> returned);
    /// Returns the depth of nested calls; 0 in the main program.
    int level() const { return static_cast<int>(calls_.size()); }
    /// Returns the value of the last call that ended.
    std::optional<double> returned() const { return returned_; }
    /// Clears the return value at the start of a call.
    void forget_returned() { returned_.reset(); }

  private:
    using Names = std::map<std::string, double, std::less<>>;
    struct SubprogramCall {
        std::array<double, max_arguments> kept = {};
        bool keeps = false;  ///< `kept` holds #1 .. #30 of the caller
        Names names;
    };

    const Names& names_of(std::string_view name) const {
        return is_global(name) ? global_ : calls_.empty() ? main_ : calls_.back().names;
    }

    std::vector<double> numbered_;  ///< empty until the first set()
    Names global_;
    Names main_;
    std::vector<SubprogramCall> calls_;
    std::optional<double> returned_;
};

}  // namespace motionrack::control::gcode
