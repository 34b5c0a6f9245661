// Writes the event trace hash of a rack.
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <motionrack/rack/trace_hash_log.hpp>

namespace motionrack::rack {

void report_history(const sim::Kernel& kernel) noexcept {
    const char* const path = std::getenv(trace_hash_variable);
    if (path == nullptr || *path == '\0') return;
    std::FILE* const file = std::fopen(path, "a");
    if (file == nullptr) return;
    std::fprintf(file, "%016" PRIx64 " %" PRId64 "\n", kernel.trace_hash(), kernel.now().count());
    std::fclose(file);
}

}  // namespace motionrack::rack
