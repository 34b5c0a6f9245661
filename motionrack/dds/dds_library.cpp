// Loads Cyclone DDS.
#include <fmt/format.h>

#include <motionrack/dds/dds_library.hpp>

namespace motionrack::dds {

Result<void> load_library() {
    const std::string& trouble = LateTable<DdsLibrary>::loaded(MOTIONRACK_DDS_SONAME).trouble();
    if (trouble.empty()) return {};
    return fail(ErrorKind::io,
                fmt::format("The library Cyclone DDS cannot be loaded: {}. No bus was opened; install it (on Debian "
                            "12: apt install libddsc0debian).",
                            trouble));
}

const DdsLibrary& library() {
    const LateTable<DdsLibrary>& loaded = LateTable<DdsLibrary>::loaded(MOTIONRACK_DDS_SONAME);
    MOTIONRACK_ASSERT(loaded.trouble().empty());
    return loaded.table();
}

}  // namespace motionrack::dds
