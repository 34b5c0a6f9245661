// Shared parts of the writing and the reading half of hdf5.hpp.
#pragma once

#include <motionrack/trace/hdf5.hpp>

namespace motionrack::trace::hdf5 {

/// Returns a text type of this many bytes (at least 1), zero-padded.
Handle text_type(std::size_t bytes);
/// Returns the library's type number; for text that of a one-byte string.
std::int64_t number_type(Type type);

}  // namespace motionrack::trace::hdf5
