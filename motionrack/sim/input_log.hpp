// All external inputs of a rack, with their instants: a replay gives the same history, bit for bit.
#pragma once

#include <cstdint>
#include <functional>
#include <motionrack/base/time.hpp>
#include <vector>

namespace motionrack::sim {

enum class InputKind : std::uint8_t { register_write, register_read, force_wire, release_wire, fault };

struct LoggedInput {
    Instant at{};
    InputKind kind{};
    std::uint16_t target = 0;  ///< device or wire number
    std::uint32_t offset = 0;  ///< register offset, or the fault's number
    std::uint16_t value = 0;
    double amount = 0;  ///< the fault's parameter
    friend bool operator==(const LoggedInput&, const LoggedInput&) = default;
};

/// Grows only between runs.
class InputLog {
  public:
    void add(const LoggedInput& input) {
        if (keeps_) inputs_.push_back(input);
    }
    /// Stops recording, for simulations without end that are never replayed.
    void keep_no_more() { keeps_ = false; }
    const std::vector<LoggedInput>& inputs() const { return inputs_; }

  private:
    std::vector<LoggedInput> inputs_;
    bool keeps_ = true;
};

class Kernel;

/// Replays `inputs` into a new world of the same wiring: each at its instant, then advances to `end`. `apply` executes
/// one input (writes the register, forces the wire); it is called between runs.
void replay(Kernel& kernel, const std::vector<LoggedInput>& inputs, Instant end,
            const std::function<void(const LoggedInput&)>& apply);

}  // namespace motionrack::sim
