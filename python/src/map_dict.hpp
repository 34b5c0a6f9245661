// Declaration of a card as Python objects.
#pragma once

#include <pybind11/pybind11.h>

#include <motionrack/base/card_map.hpp>

namespace motionrack::python {

/// Returns the complete declaration of a card.
pybind11::dict map_dict(const CardMap& map);

}  // namespace motionrack::python
