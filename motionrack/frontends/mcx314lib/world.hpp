// Where the library's virtual chips are: cards in one time. On Linux it is a rack with all that a rack file describes;
// on Windows (windows/world.cpp) chips alone.
//
//   Bench ──► World::open ──► World ──► VirtualCard ──► registers, interrupt ◄── Driver
//                               └──► time and wires, for all of its cards
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
    /// A register or value by its name ("RR0", "x.LP"), without effects. Errors: invalid_input.
    virtual Result<std::int64_t> inspect(std::string_view name) const = 0;
};

class World {
  public:
    /// `path_or_text`: of a rack file, or the text of one. Errors: invalid_input, with what is wrong; io.
    static Result<std::shared_ptr<World>> open(std::string_view path_or_text);
    virtual ~World() = default;

    /// Its mcx314 cards, in the order of the rack file.
    virtual std::vector<VirtualCard*> cards() = 0;
    /// Lets `ns` nanoseconds pass, 0 .. max_ns. Errors: refused.
    virtual Result<void> advance(std::uint64_t ns) = 0;
    static constexpr std::uint64_t max_ns = 1'000'000'000'000'000;
    /// Drives a wire with 0 or 1 until it is released (NaN). Errors: invalid_input, refused.
    virtual Result<void> set_wire(std::string_view name, double value) = 0;
};

/// What a user wrote, printable and not too long, for a sentence.
std::string in_quotes(std::string_view text);

}  // namespace motionrack::mcx314lib
