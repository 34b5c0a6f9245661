// libFuzzer: any bytes as a recording of any kind; it is rejected with a sentence or its content is consistent.
#include <cstdint>
#include <motionrack/trace/diff.hpp>
#include <motionrack/trace/report_csv.hpp>
#include <string>
#include <tests/fuzz/scratch_file.hpp>
#include <vector>

namespace {

using namespace motionrack;
using fuzz::require;

void read_whole(const std::string& path) {
    const auto reader = trace::RecordingReader::open(path);
    if (!reader) return require(!reader.error().message.empty(), "a refusal has a sentence");
    for (const trace::RecordedSeries& series : reader->series()) {
        const auto columns = reader->columns(series);
        if (!columns) continue;
        std::vector<std::int64_t> values(1 << 14);
        for (std::uint64_t from = 0; from < columns->size && from < (1u << 20); from += values.size()) {
            const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(values.size(), columns->size - from));
            if (!columns->time.read(from, count, values.data()) || !columns->value.read(from, count, values.data()))
                break;
        }
    }
    const auto data = reader->report();
    require(data || !data.error().message.empty(), "a refusal has a sentence");
}

}  // namespace

/// The HDF5 library itself leaks some memory when it rejects a damaged file.
extern "C" const char* __asan_default_options() {
    return "detect_leaks=0";
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzz::ScratchFile file("recording");
    const std::string& path = file.path();
    file.write({reinterpret_cast<const char*>(data), size});
    const auto kind = trace::kind_of_file(path);
    if (kind && *kind == trace::FileKind::hdf5) read_whole(path);
    const auto diff = trace::diff_files(path, path);
    if (diff)
        require(
            diff->same() && !trace::diff_text(*diff, "a", "b").empty() && !trace::diff_json(*diff, "a", "b").empty(),
            "a recording is the same as itself");
    else
        require(!diff.error().message.empty(), "a refusal has a sentence");
    if (kind && *kind == trace::FileKind::csv) (void)trace::report_from_csv(path);
    return 0;
}
