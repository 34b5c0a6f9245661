// Random draws from a seed, the same on every computer.
#pragma once

#include <cstdint>
#include <random>

namespace motionrack::swarm {

class Draws {
  public:
    explicit Draws(std::uint64_t seed) : random_(seed) {}
    /// 0 .. n-1.
    int pick(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
    bool one_in(int n) { return pick(n) == 0; }
    double number(double low, double high) {
        return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
    }
    std::uint64_t raw() { return random_(); }

  private:
    std::mt19937_64 random_;
};

}  // namespace motionrack::swarm
