// A card's declaration for Python.
#pragma once

#include <pybind11/pybind11.h>

#include <motionrack/base/card_map.hpp>

namespace motionrack::python {

/// Everything that is declared of a card.
pybind11::dict map_dict(const CardMap& map);

}  // namespace motionrack::python
