// Loading of NATS.
#include <fmt/format.h>

#include <motionrack/base/late_library.hpp>
#include <motionrack/nats/nats_library.hpp>

namespace motionrack::nats {

namespace {

struct Loaded {
    LateLibrary file{MOTIONRACK_NATS_SONAME};
    Library library;
    Loaded() {
#define MOTIONRACK_NATS_FIND(name) file.find(#name, library.name##_);
        MOTIONRACK_NATS_FUNCTIONS(MOTIONRACK_NATS_FIND)
#undef MOTIONRACK_NATS_FIND
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
                fmt::format("The library of NATS cannot be loaded: {}. No machine was asked; install it (on Debian "
                            "12: apt install libnats3.4).",
                            loaded().file.trouble()));
}

const Library& library() {
    MOTIONRACK_ASSERT(loaded().file.trouble().empty());
    return loaded().library;
}

}  // namespace motionrack::nats
