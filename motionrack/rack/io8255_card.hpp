// The plug-in of the IO8255.
#pragma once

#include <motionrack/rack/catalogue.hpp>

namespace motionrack::rack {

extern const CardPlugin io8255_plugin;

}  // namespace motionrack::rack
