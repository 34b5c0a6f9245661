// Double buffer between a writer that never waits and a reader that never sees a partial value.
//
//   writer ──► [ A ] ──publish──► reader claims A; the writer rewrites B until A is released
//              [ B ]
#pragma once

#include <array>
#include <cstdint>

namespace motionrack::sim {

/// Plain state; trivially copyable if T is.
template <class T>
struct PingPong {
    static constexpr std::int32_t none = -1;

    /// Begins a write: takes the unclaimed buffer or, if both are free, the one not published last.
    T& begin() {
        filling = claimed != none ? 1 - claimed : published != none ? 1 - published : 0;
        return buffers[static_cast<std::size_t>(filling)];
    }
    /// Returns the buffer that begin() opened for the present write.
    T& current() { return buffers[static_cast<std::size_t>(filling)]; }
    const T& current() const { return buffers[static_cast<std::size_t>(filling)]; }
    bool begun() const { return filling != none; }
    /// Publishes the complete value.
    void publish() {
        published = filling;
        filling = none;
    }
    /// Aborts a write; its buffer becomes free.
    void abandon() {
        if (filling == published) published = claimed;
        filling = none;
    }
    /// Claims the value published last; while that is being overwritten, the reader keeps its old one. nullptr: none
    /// yet.
    const T* claim() {
        if (published != filling) claimed = published;
        return held();
    }
    void release() { claimed = none; }
    /// The claimed value; nullptr: none.
    const T* held() const { return claimed != none ? &buffers[static_cast<std::size_t>(claimed)] : nullptr; }
    /// The value published last, claimed or not; nullptr: none, or it is being overwritten.
    const T* last() const {
        return published != none && published != filling ? &buffers[static_cast<std::size_t>(published)] : nullptr;
    }

    std::array<T, 2> buffers{};
    std::int32_t published = none;
    std::int32_t filling = none;
    std::int32_t claimed = none;
    std::int32_t reserved = 0;
};

}  // namespace motionrack::sim
