// Two buffers between a writer that never waits and a reader that is never shown half of anything.
//
//   writer ──► [ A ] ──publish──► reader claims A; the writer goes on in B, again and again, until A is given back
//              [ B ]
#pragma once

#include <array>
#include <cstdint>

namespace motionrack::sim {

/// State only; trivially copyable if T is.
template <class T>
struct PingPong {
    static constexpr std::int32_t none = -1;

    /// The writer begins: the buffer that nobody has claimed, and if both are free the one not published last.
    T& begin() {
        filling = claimed != none ? 1 - claimed : published != none ? 1 - published : 0;
        return buffers[static_cast<std::size_t>(filling)];
    }
    /// What begin() gave.
    T& current() { return buffers[static_cast<std::size_t>(filling)]; }
    const T& current() const { return buffers[static_cast<std::size_t>(filling)]; }
    bool begun() const { return filling != none; }
    /// The writer has finished a whole.
    void publish() {
        published = filling;
        filling = none;
    }
    /// The writer gives up; what it began is no longer anybody's.
    void abandon() {
        if (filling == published) published = claimed;
        filling = none;
    }
    /// The reader takes what was published last; if that is being overwritten, it keeps what it had. nullptr: nothing
    /// yet.
    const T* claim() {
        if (published != filling) claimed = published;
        return held();
    }
    void release() { claimed = none; }
    /// What the reader has claimed; nullptr if nothing.
    const T* held() const { return claimed != none ? &buffers[static_cast<std::size_t>(claimed)] : nullptr; }
    /// What was published last, whoever reads it; nullptr if nothing or if it is being overwritten.
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
