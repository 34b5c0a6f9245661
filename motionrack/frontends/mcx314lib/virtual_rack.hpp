// Rack of the library's virtual chips: cards that share one simulated time. On Linux it is a complete rack from a rack
// file; on Windows (windows/virtual_rack.cpp) it has chips only.
//
//   ChipTable ──► VirtualRack::open ──► VirtualRack ──► VirtualCard ──► registers, interrupt ◄── Driver
//                                    └──► time and wires, shared by its cards
#pragma once

#include <cstdint>
#include <memory>
#include <motionrack/base/port.hpp>
#include <motionrack/base/result.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::mcx314lib {

class VirtualCard {
  public:
    virtual ~VirtualCard() = default;
    virtual const std::string& name() const = 0;
    virtual RegisterPort& registers() = 0;
    virtual Interrupt& interrupt() = 0;
    /// Returns a register or value by name ("RR0", "x.LP") without side effects. Errors: invalid_input.
    virtual Result<std::int64_t> inspect(std::string_view name) const = 0;
};

class VirtualRack {
  public:
    /// `path_or_text`: path or text of a rack file. Errors: invalid_input with the problem; io.
    static Result<std::shared_ptr<VirtualRack>> open(std::string_view path_or_text);
    virtual ~VirtualRack() = default;

    /// Returns its mcx314 cards in the order of the rack file.
    virtual std::vector<VirtualCard*> cards() = 0;
    /// Advances time by `ns` nanoseconds, 0 .. max_ns. Errors: refused.
    virtual Result<void> advance(std::uint64_t ns) = 0;
    static constexpr std::uint64_t max_ns = 1'000'000'000'000'000;
    /// Forces a wire to 0 or 1 until it is released (NaN). Errors: invalid_input, refused.
    virtual Result<void> set_wire(std::string_view name, double value) = 0;
};

/// Quotes user input for a sentence: printable and shortened.
std::string in_quotes(std::string_view text);

}  // namespace motionrack::mcx314lib
