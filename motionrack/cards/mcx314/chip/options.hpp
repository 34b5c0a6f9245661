// What a chip is built as; none of it changes while it runs.
#pragma once

#include <cstdint>

namespace motionrack::mcx314 {

enum class Variant : std::uint8_t {
    mcx314,   ///< the original
    mcx314as  ///< with filters, home search, synchronous actions, wide ranges (RULES.md, "The MCX314As")
};

struct ChipOptions {
    Variant variant = Variant::mcx314;
};

}  // namespace motionrack::mcx314
