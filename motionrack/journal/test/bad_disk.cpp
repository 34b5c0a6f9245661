#include "bad_disk.hpp"

#include <condition_variable>
#include <cstring>
#include <fstream>
#include <map>
#include <mutex>

namespace motionrack::journal {

namespace {

enum class Kind : std::uint8_t { write, truncate, sync, remove };

struct Call {
    Kind kind;
    std::string path;
    std::int64_t offset;  ///< truncate: the size; removal: whether it is synced on return
    std::string bytes;
};

struct Record {
    std::mutex lock;
    std::condition_variable released;
    bool held = false;
    BadDisk::Plan plan;
    std::int64_t count = 0, reads = 0;
    std::vector<Call> calls;
};
Record record;

/// Counts a call and returns its fault.
BadDisk::Fault next_call(Call call) {
    std::unique_lock<std::mutex> alone(record.lock);
    record.released.wait(alone, [] { return !record.held; });
    record.calls.push_back(std::move(call));
    const std::int64_t at = ++record.count;
    if (record.plan.fault == BadDisk::Fault::stay)
        return at >= record.plan.nth ? BadDisk::Fault::fail : BadDisk::Fault::none;
    return at == record.plan.nth ? record.plan.fault : BadDisk::Fault::none;
}

struct File {
    sqlite3_file base;
    char path[512];
    sqlite3_file* real() { return reinterpret_cast<sqlite3_file*>(this + 1); }
};

File* file_of(sqlite3_file* one) {
    return reinterpret_cast<File*>(one);
}
sqlite3_file* real_of(sqlite3_file* one) {
    return file_of(one)->real();
}

int on_read(sqlite3_file* one, void* to, int count, sqlite3_int64 offset) {
    {
        const std::lock_guard<std::mutex> alone(record.lock);
        if (++record.reads == record.plan.nth_read) return SQLITE_IOERR_READ;
    }
    return real_of(one)->pMethods->xRead(real_of(one), to, count, offset);
}

int on_write(sqlite3_file* one, const void* bytes, int count, sqlite3_int64 offset) {
    Call call{Kind::write, file_of(one)->path, offset, std::string(static_cast<const char*>(bytes), count)};
    switch (next_call(std::move(call))) {
        case BadDisk::Fault::none:
            return real_of(one)->pMethods->xWrite(real_of(one), bytes, count, offset);
        case BadDisk::Fault::drop:
            return SQLITE_OK;
        case BadDisk::Fault::tear:
            (void)real_of(one)->pMethods->xWrite(real_of(one), bytes, count / 2, offset);
            return SQLITE_IOERR_WRITE;
        default:
            return SQLITE_FULL;
    }
}

int on_truncate(sqlite3_file* one, sqlite3_int64 size) {
    switch (next_call({Kind::truncate, file_of(one)->path, size, {}})) {
        case BadDisk::Fault::none:
            return real_of(one)->pMethods->xTruncate(real_of(one), size);
        case BadDisk::Fault::drop:
            return SQLITE_OK;
        default:
            return SQLITE_IOERR_TRUNCATE;
    }
}

/// Records the sync only: the state after a power loss is reconstructed from the recorded calls.
int on_sync(sqlite3_file* one, int) {
    switch (next_call({Kind::sync, file_of(one)->path, 0, {}})) {
        case BadDisk::Fault::none:
        case BadDisk::Fault::drop:
            return SQLITE_OK;
        default:
            return SQLITE_IOERR_FSYNC;
    }
}

/// All other calls are passed through.
const sqlite3_io_methods methods = {
    2,
    [](sqlite3_file* f) { return real_of(f)->pMethods->xClose(real_of(f)); },
    on_read,
    on_write,
    on_truncate,
    on_sync,
    [](sqlite3_file* f, sqlite3_int64* size) { return real_of(f)->pMethods->xFileSize(real_of(f), size); },
    [](sqlite3_file* f, int lock) { return real_of(f)->pMethods->xLock(real_of(f), lock); },
    [](sqlite3_file* f, int lock) { return real_of(f)->pMethods->xUnlock(real_of(f), lock); },
    [](sqlite3_file* f, int* out) { return real_of(f)->pMethods->xCheckReservedLock(real_of(f), out); },
    [](sqlite3_file* f, int what, void* with) { return real_of(f)->pMethods->xFileControl(real_of(f), what, with); },
    [](sqlite3_file* f) { return real_of(f)->pMethods->xSectorSize(real_of(f)); },
    [](sqlite3_file* f) { return real_of(f)->pMethods->xDeviceCharacteristics(real_of(f)); },
    [](sqlite3_file* f, int page, int size, int extend, void volatile** to) {
        return real_of(f)->pMethods->xShmMap(real_of(f), page, size, extend, to);
    },
    [](sqlite3_file* f, int at, int n, int flags) { return real_of(f)->pMethods->xShmLock(real_of(f), at, n, flags); },
    [](sqlite3_file* f) { real_of(f)->pMethods->xShmBarrier(real_of(f)); },
    [](sqlite3_file* f, int drop) { return real_of(f)->pMethods->xShmUnmap(real_of(f), drop); },
    nullptr,
    nullptr,
};

sqlite3_vfs* under = nullptr;  ///< the disk interface of the system
sqlite3_vfs disk;

int on_open(sqlite3_vfs*, const char* path, sqlite3_file* one, int flags, int* out) {
    File* file = new (one) File{};
    const int code = under->xOpen(under, path, file->real(), flags, out);
    if (file->real()->pMethods == nullptr) return code;
    file->base.pMethods = &methods;
    if (path != nullptr) std::strncpy(file->path, path, sizeof file->path - 1);
    return code;
}

int on_remove(sqlite3_vfs*, const char* path, int sync_folder) {
    switch (next_call({Kind::remove, path, sync_folder, {}})) {
        case BadDisk::Fault::none:
            return under->xDelete(under, path, 0);
        case BadDisk::Fault::drop:
            return SQLITE_OK;
        default:
            return SQLITE_IOERR_DELETE;
    }
}

/// Applies calls to a file, giving its content after a power loss.
void put(std::string& file, const Call& call, std::size_t count) {
    if (call.kind == Kind::truncate) return file.resize(static_cast<std::size_t>(call.offset));
    const auto offset = static_cast<std::size_t>(call.offset);
    if (file.size() < offset + count) file.resize(offset + count);
    file.replace(offset, count, call.bytes, 0, count);
}

}  // namespace

BadDisk::BadDisk(const Plan& plan) {
    record.held = false;
    record.plan = plan;
    record.count = record.reads = 0;
    record.calls.clear();
    under = sqlite3_vfs_find(nullptr);
    disk = *under;
    disk.zName = "bad disk";
    disk.szOsFile += static_cast<int>(sizeof(File));
    disk.xOpen = on_open;
    disk.xDelete = on_remove;
    sqlite3_vfs_register(&disk, 1);
}

BadDisk::~BadDisk() {
    sqlite3_vfs_unregister(&disk);
    sqlite3_vfs_register(under, 1);
}

void BadDisk::hold(bool on) {
    const std::lock_guard<std::mutex> alone(record.lock);
    record.held = on;
    record.released.notify_all();
}

std::int64_t BadDisk::calls() const {
    const std::lock_guard<std::mutex> alone(record.lock);
    return record.count;
}

std::int64_t BadDisk::reads() const {
    const std::lock_guard<std::mutex> alone(record.lock);
    return record.reads;
}

void BadDisk::write_state(std::int64_t calls, std::mt19937& random, const std::string& from,
                          const std::string& to) const {
    const std::lock_guard<std::mutex> alone(record.lock);
    std::map<std::string, std::int64_t> synced;
    for (std::int64_t i = 0; i < calls; ++i)
        if (record.calls[static_cast<std::size_t>(i)].kind == Kind::sync)
            synced[record.calls[static_cast<std::size_t>(i)].path] = i;
    std::map<std::string, std::string> files;
    for (std::int64_t i = 0; i < calls; ++i) {
        const Call& call = record.calls[static_cast<std::size_t>(i)];
        if (call.kind == Kind::sync) continue;
        if (call.kind == Kind::remove) {
            if (call.offset != 0 || random() % 2 == 0) files.erase(call.path);
            continue;
        }
        const auto until = synced.find(call.path);
        const bool safe = until != synced.end() && i < until->second;
        const auto luck = safe ? 0 : random() % 3;
        if (luck == 0) put(files[call.path], call, call.bytes.size());
        if (luck == 1 && call.kind == Kind::write) put(files[call.path], call, random() % (call.bytes.size() + 1));
    }
    for (const char* end : {"", "-journal", "-wal", "-shm", ".lock"}) std::filesystem::remove(to + end);
    for (const auto& [path, bytes] : files) {
        const std::string end = path.substr(from.size());
        std::ofstream(to + end, std::ios::binary) << bytes;
    }
}

}  // namespace motionrack::journal
