// Loading of the NATS client library.
#include <fmt/format.h>

#include <motionrack/nats/nats_library.hpp>

namespace motionrack::nats {

Result<void> load_library() {
    const std::string& trouble = LateTable<NatsLibrary>::loaded(MOTIONRACK_NATS_SONAME).trouble();
    if (trouble.empty()) return {};
    return fail(ErrorKind::io,
                fmt::format("The library of NATS cannot be loaded: {}. Nothing was queued; install it (on Debian "
                            "12: apt install libnats3.4).",
                            trouble));
}

const NatsLibrary& library() {
    const LateTable<NatsLibrary>& loaded = LateTable<NatsLibrary>::loaded(MOTIONRACK_NATS_SONAME);
    MOTIONRACK_ASSERT(loaded.trouble().empty());
    return loaded.table();
}

}  // namespace motionrack::nats
