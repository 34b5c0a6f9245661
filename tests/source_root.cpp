// The path of the tree, in the only test source that depends on it.
#include <tests/source_root.hpp>

namespace motionrack {

std::string source_dir() {
    return MOTIONRACK_SOURCE_DIR;
}

}  // namespace motionrack
