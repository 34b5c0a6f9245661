// Shared parts of the two binding files of the MCX314 function library.
#pragma once

#include <motionrack/cards/mcx314/driver/driver.hpp>
#include <python/src/rack_lock.hpp>

namespace motionrack::python {

template <>
struct HostOf<mcx314::Driver> {
    using type = Host;
};

using Mcx314 = BoundDriver<mcx314::Driver>;
using Mcx314Class = py::class_<Mcx314>;

/// Throws if `axes` is not an axis mask.
unsigned mask(unsigned axes);

void bind_mcx314_moves(Mcx314Class& c);
void bind_mcx314_signals(Mcx314Class& c);
void bind_mcx314_status(Mcx314Class& c);

}  // namespace motionrack::python
