// The name of the tree: the one source of the tests that depends on it.
#include <tests/source_root.hpp>

namespace motionrack {

std::string source_dir() {
    return MOTIONRACK_SOURCE_DIR;
}

}  // namespace motionrack
