// libFuzzer: any bytes patched over a complete journal, or in its place. It is opened, or rejected with a sentence and
// left unchanged. Values accepted from an opened journal were really written, and every entry acknowledged afterwards
// exists in the next run.
//
//  input: 0, bytes of the file    or    n, then n times: offset (3 bytes), number of bytes (1), these bytes
#include <algorithm>
#include <cstdint>
#include <future>
#include <map>
#include <motionrack/journal/journal.hpp>
#include <tests/fuzz/scratch_file.hpp>

namespace {

using namespace motionrack;
using namespace motionrack::journal;
using fuzz::require;
using fuzz::ScratchFile;

const std::map<std::string, std::string> kept = {{"machine", "X 12.5, Y 3"}, {"offsets", "{\"G54\":[1,2,3]}"}};
constexpr int entry_count = 12;

const ScratchFile& file() {
    static const ScratchFile one("fuzz.journal");
    return one;
}

/// Returns the number of the entry, or the write error.
Result<std::int64_t> write(Journal& journal, const std::string& text) {
    std::promise<Result<std::int64_t>> number;
    journal.write(Instant{7}, "command", text, "{}", [&](const Result<std::int64_t>& done) { number.set_value(done); });
    return number.get_future().get();
}

/// A journal of two runs that ended regularly.
std::string make_journal() {
    file().clear();
    for (int run = 0; run < 2; ++run) {
        auto journal = Journal::open(file().path());
        require(journal.has_value(), "a journal can be made", journal ? "" : journal.error().text());
        for (int i = 0; i < entry_count / 2; ++i)
            require(write(**journal, "entry " + std::to_string(i)).has_value(), "a journal can be written");
        for (const auto& [key, value] : kept) (*journal)->keep(key, value);
        require((*journal)->close().has_value(), "a journal can be closed");
    }
    return file().bytes();
}

const std::string& whole_journal() {
    static const std::string bytes = make_journal();
    return bytes;
}

std::string journal_of(std::string_view input) {
    if (input.empty()) return whole_journal();
    const auto byte = [&]() -> std::size_t {
        if (input.empty()) return 0;
        const auto out = static_cast<unsigned char>(input.front());
        input.remove_prefix(1);
        return out;
    };
    std::size_t patches = byte();
    if (patches == 0) return std::string(input);
    std::string out = whole_journal();
    for (; patches > 0 && !input.empty(); --patches) {
        const std::size_t place = (byte() | byte() << 8 | byte() << 16) % out.size();
        const std::size_t size = std::min({byte(), input.size(), out.size() - place});
        out.replace(place, size, input.substr(0, size));
        input.remove_prefix(size);
    }
    return out;
}

/// Checks that all accepted values were really written.
void check_trust(const Journal& journal, bool is_patched) {
    require(!is_patched || journal.before().has_value(), "a journal that has runs is not taken for a new one");
    if (!journal.before()) return;
    const LastRun& last = *journal.before();
    for (const std::string& doubt : last.doubts) require(!doubt.empty(), "a doubt is a sentence");
    if (!is_patched || !last.clean || !last.doubts.empty()) return;
    require(last.kept == kept, "values that are trusted are those that were kept");
    if (!last.damage.empty()) return;
    const auto entries = journal.read({});
    require(entries.has_value() && entries->size() == entry_count, "entries that are trusted are all there");
    for (int i = 0; i < entry_count; ++i) {
        const Entry& entry = (*entries)[static_cast<std::size_t>(i)];
        require(entry.number == i + 1 && entry.text == "entry " + std::to_string(i % (entry_count / 2)),
                "entries that are trusted are those that were written", entry.text);
    }
}

/// Continues to write; the next run finds all acknowledged entries.
void go_on(std::unique_ptr<Journal> journal) {
    const auto number = write(*journal, "goes on");
    journal->keep("machine", "X 99");
    const auto closed = journal->close();
    const std::int64_t run = journal->run();
    if (!number) require(!number.error().message.empty() && !closed, "what is not written ends no run clean");
    if (!closed) return require(!closed.error().message.empty(), "a run without a clean end is told so");
    journal.reset();
    const auto next = Journal::open(file().path());
    require(next.has_value(), "a journal that was closed is opened", next ? "" : next.error().text());
    const LastRun& last = *(*next)->before();
    require(last.run == run && last.clean, "a run that was closed has ended clean");
    const auto found = last.kept.find("machine");
    require(found != last.kept.end() && found->second == "X 99", "a value that was kept is there in the next run");
    const auto entries = (*next)->read({*number - 1, "", 1});
    require(entries.has_value() && entries->size() == 1 && entries->front().text == "goes on",
            "an entry that was acknowledged is there in the next run");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const bool is_patched = size == 0 || data[0] != 0;
    const std::string bytes = journal_of({reinterpret_cast<const char*>(data), size});
    file().write(bytes);
    auto journal = Journal::open(file().path());
    if (journal) {
        check_trust(**journal, is_patched);
        go_on(std::move(*journal));
        return 0;
    }
    require(journal.error().message.find(file().path()) != std::string::npos && journal.error().kind == ErrorKind::io,
            "a refusal names the file", journal.error().text());
    require(file().bytes() == bytes, "a journal that is refused is left as it is", journal.error().text());
    return 0;
}
