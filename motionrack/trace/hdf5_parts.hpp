// What the writing and the reading half of hdf5.hpp share.
#pragma once

#include <motionrack/trace/hdf5.hpp>

namespace motionrack::trace::hdf5 {

/// A text of so many bytes (at least 1), zeros after its end.
Handle text_type(std::size_t bytes);
/// The library's number for it; of text that of a byte.
std::int64_t number_type(Type type);

}  // namespace motionrack::trace::hdf5
