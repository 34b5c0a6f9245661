// Simulates a computer whose nth allocation fails: replaces the allocation functions of a program (LD_PRELOAD).
//
//   MOTIONRACK_BAD_NEW        "12": the 12th allocation from main() on fails; "12 on": it and all later ones;
//                             without it none fails
//   MOTIONRACK_BAD_NEW_COUNT  file that receives the number of allocations when main() ends
#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

namespace {

std::atomic<bool> counts{false};
std::atomic<long> calls{0};
long first = 0, last = 0;
int (*real_main)(int, char**, char**) = nullptr;

bool fails() {
    if (!counts.load(std::memory_order_relaxed)) return false;
    const long call = calls.fetch_add(1, std::memory_order_relaxed) + 1;
    return call >= first && call <= last;
}

int counted_main(int argc, char** argv, char** environment) {
    if (const char* plan = std::getenv("MOTIONRACK_BAD_NEW")) {
        first = std::atol(plan);
        last = std::strstr(plan, "on") != nullptr ? __LONG_MAX__ : first;
    }
    if (first == 0) last = -1;
    counts = true;
    const int code = real_main(argc, argv, environment);
    counts = false;
    if (const char* path = std::getenv("MOTIONRACK_BAD_NEW_COUNT")) {
        char text[32];
        const int size = std::snprintf(text, sizeof text, "%ld\n", calls.load());
        const int file = ::open(path, O_WRONLY | O_CREAT | O_TRUNC, 0644);
        if (::write(file, text, static_cast<std::size_t>(size)) != size) std::abort();
        ::close(file);
    }
    return code;
}

void* memory(std::size_t size, std::size_t alignment) {
    const std::size_t whole = (size + alignment - 1) / alignment * alignment;
    return fails() ? nullptr : std::aligned_alloc(alignment, whole == 0 ? alignment : whole);
}

void* memory_or_throw(std::size_t size, std::size_t alignment) {
    void* const out = memory(size, alignment);
    if (out == nullptr) throw std::bad_alloc();
    return out;
}

}  // namespace

extern "C" int __libc_start_main(int (*main)(int, char**, char**), int argc, char** argv, void (*init)(),
                                 void (*fini)(), void (*rtld_fini)(), void* stack_end) {
    using Start = int (*)(int (*)(int, char**, char**), int, char**, void (*)(), void (*)(), void (*)(), void*);
    real_main = main;
    const auto start = reinterpret_cast<Start>(::dlsym(RTLD_NEXT, "__libc_start_main"));
    return start(counted_main, argc, argv, init, fini, rtld_fini, stack_end);
}

void* operator new(std::size_t size) {
    return memory_or_throw(size, alignof(std::max_align_t));
}
void* operator new[](std::size_t size) {
    return memory_or_throw(size, alignof(std::max_align_t));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
    return memory_or_throw(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
    return memory_or_throw(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return memory(size, alignof(std::max_align_t));
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
    return memory(size, alignof(std::max_align_t));
}
void operator delete(void* at) noexcept {
    std::free(at);
}
void operator delete[](void* at) noexcept {
    std::free(at);
}
void operator delete(void* at, std::size_t) noexcept {
    std::free(at);
}
void operator delete[](void* at, std::size_t) noexcept {
    std::free(at);
}
void operator delete(void* at, std::align_val_t) noexcept {
    std::free(at);
}
void operator delete[](void* at, std::align_val_t) noexcept {
    std::free(at);
}
void operator delete(void* at, std::size_t, std::align_val_t) noexcept {
    std::free(at);
}
void operator delete[](void* at, std::size_t, std::align_val_t) noexcept {
    std::free(at);
}
