// Loading Cyclone DDS.
#include <fmt/format.h>

#include <motionrack/base/late_library.hpp>
#include <motionrack/dds/dds_library.hpp>

namespace motionrack::dds {

namespace {

struct Loaded {
    LateLibrary file{MOTIONRACK_DDS_SONAME};
    Library library;
    Loaded() {
#define MOTIONRACK_DDS_FIND(name) file.find(#name, library.name##_);
        MOTIONRACK_DDS_FUNCTIONS(MOTIONRACK_DDS_FIND)
#undef MOTIONRACK_DDS_FIND
    }
};

const Loaded& loaded() {
    static const Loaded once;
    return once;
}

}  // namespace

Result<void> load_library() {
    if (loaded().file.trouble().empty()) return {};
    return fail(Trouble::io,
                fmt::format("The library Cyclone DDS cannot be loaded: {}. No bus was opened; install it (on Debian "
                            "12: apt install libddsc0debian).",
                            loaded().file.trouble()));
}

const Library& library() {
    MOTIONRACK_ASSERT(loaded().file.trouble().empty());
    return loaded().library;
}

}  // namespace motionrack::dds
