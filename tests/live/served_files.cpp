// Served files over libfuse, one request at a time, on a separate thread.
#define FUSE_USE_VERSION 35
#include <fuse.h>
#include <poll.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <tests/live/served_files.hpp>
#include <tests/live/virtual_card.hpp>
#include <thread>

namespace motionrack::live_test {

namespace {

constexpr unsigned registers_end = port_base + 16;

/// State of the files; libfuse passes it to every call.
struct Served {
    VirtualCard& card;
    // Interrupt side of a UIO node: the kernel driver masks the line after counting an interrupt, and a write of 1
    // unmasks it.
    std::uint32_t count = 0, seen = 0;
    bool open = false;
    std::uint32_t refusals = 0;  // remaining number
    std::uint32_t absent = 0;

    bool refuses(const char* path) {
        if (refusals == 0 || std::strcmp(path, "/port") != 0) return false;
        --refusals;
        return true;
    }
    bool empty_slot(const char* path) const { return absent != 0 && std::strcmp(path, "/port") == 0; }
    void look() {
        if (!open || !card.interrupt()) return;
        ++count;
        open = false;
    }
};

Served& served() {
    return *static_cast<Served*>(::fuse_get_context()->private_data);
}
bool is(const char* path, const char* name) {
    return std::strcmp(path, name) == 0;
}

bool is_port(const char* path) {
    return is(path, "/port") || is(path, "/look");
}

bool is_number(const char* path) {
    return is(path, "/refuse") || is(path, "/absent");
}

int attributes(const char* path, struct stat* out, fuse_file_info*) {
    *out = {};
    out->st_uid = ::getuid();
    if (is(path, "/"))
        out->st_mode = S_IFDIR | 0700;
    else if (is_port(path))
        out->st_mode = S_IFREG | 0600, out->st_size = registers_end;
    else if (is(path, "/uio0") || is_number(path))
        out->st_mode = S_IFREG | 0600;
    else
        return -ENOENT;
    out->st_nlink = 1;
    return 0;
}

int open_file(const char* path, fuse_file_info* info) {
    if (!is_port(path) && !is(path, "/uio0") && !is_number(path)) return -ENOENT;
    info->direct_io = 1;  // no page cache: every read reaches the card
    info->nonseekable = is(path, "/uio0");
    return 0;
}

bool is_access(std::size_t bytes, off_t at) {
    return at >= port_base && at < registers_end && (bytes == 1 || (bytes == 2 && at % 2 == 0));
}

int read_file(const char* path, char* out, std::size_t bytes, off_t at, fuse_file_info*) {
    Served& files = served();
    if (is(path, "/uio0")) {
        if (bytes != sizeof files.count) return -EINVAL;
        files.look();
        if (files.count == files.seen) return -EAGAIN;
        files.seen = files.count;
        std::memcpy(out, &files.count, bytes);
        return static_cast<int>(bytes);
    }
    if (!is_port(path) || !is_access(bytes, at)) return -EINVAL;
    if (files.refuses(path)) return -ENODEV;
    if (files.empty_slot(path)) return std::memset(out, 0xFF, bytes), static_cast<int>(bytes);
    const std::uint16_t value =
        files.card.read(static_cast<std::uint32_t>(at - port_base), static_cast<unsigned>(8 * bytes));
    std::memcpy(out, &value, bytes);
    return static_cast<int>(bytes);
}

int write_file(const char* path, const char* from, std::size_t bytes, off_t at, fuse_file_info*) {
    Served& files = served();
    if (is(path, "/uio0")) {
        std::uint32_t opens = 0;
        if (bytes != sizeof opens) return -EINVAL;
        std::memcpy(&opens, from, bytes);
        files.open = opens == 1;
        return static_cast<int>(bytes);
    }
    if (is_number(path)) {
        std::uint32_t& number = is(path, "/refuse") ? files.refusals : files.absent;
        if (bytes != sizeof number) return -EINVAL;
        std::memcpy(&number, from, bytes);
        return static_cast<int>(bytes);
    }
    if (!is_port(path) || !is_access(bytes, at)) return -EINVAL;
    if (files.refuses(path)) return -ENODEV;
    if (files.empty_slot(path)) return static_cast<int>(bytes);
    std::uint16_t value = 0;
    std::memcpy(&value, from, bytes);
    files.card.write(static_cast<std::uint32_t>(at - port_base), static_cast<unsigned>(8 * bytes), value);
    return static_cast<int>(bytes);
}

/// Reports readiness. Sends no later notification: a waiting client polls again after its timeout.
int poll_file(const char* path, fuse_file_info*, fuse_pollhandle* handle, unsigned* events) {
    if (handle) ::fuse_pollhandle_destroy(handle);
    Served& files = served();
    files.look();
    *events = !is(path, "/uio0") || files.count != files.seen ? POLLIN : 0;
    return 0;
}

class FuseFiles final : public ServedFiles {
  public:
    explicit FuseFiles(VirtualCard& card) : served_{card} {}
    ~FuseFiles() override {
        if (!fuse_) return;
        if (thread_.joinable()) {
            ::fuse_exit(fuse_);
            ::fuse_unmount(fuse_);  // ends the wait of the thread
            thread_.join();
        }
        ::fuse_destroy(fuse_);
    }

    bool begin(const std::string& folder, std::string& why) {
        fuse_operations operations{};
        operations.getattr = attributes;
        operations.open = open_file;
        operations.read = read_file;
        operations.write = write_file;
        operations.poll = poll_file;
        char name[] = "live_server";
        char* words[] = {name, nullptr};
        fuse_args arguments{1, words, 0};
        fuse_ = ::fuse_new(&arguments, &operations, sizeof operations, &served_);
        ::fuse_opt_free_args(&arguments);
        if (!fuse_ || ::fuse_mount(fuse_, folder.c_str()) != 0) {
            why =
                "This computer does not let programs serve files (FUSE): it has no /dev/fuse, or does not allow "
                "mounting.";
            return false;
        }
        thread_ = std::thread([this] { ::fuse_loop(fuse_); });
        return true;
    }

  private:
    Served served_;
    ::fuse* fuse_ = nullptr;
    std::thread thread_;
};

}  // namespace

std::unique_ptr<ServedFiles> ServedFiles::serve(VirtualCard& card, const std::string& folder, std::string& why) {
    auto files = std::make_unique<FuseFiles>(card);
    if (!files->begin(folder, why)) return nullptr;
    return files;
}

}  // namespace motionrack::live_test
