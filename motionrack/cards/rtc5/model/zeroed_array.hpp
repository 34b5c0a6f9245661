// An array of zeros whose pages use no memory until they are written.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <motionrack/base/result.hpp>
#include <span>
#include <type_traits>

namespace motionrack::rtc5 {

template <class Value>
class ZeroedArray {
  public:
    // NOLINTBEGIN(cppcoreguidelines-no-malloc): new would write the zeros
    explicit ZeroedArray(std::size_t size)
        : values_(static_cast<Value*>(std::calloc(size, sizeof(Value)))), size_(size) {
        static_assert(std::is_trivially_copyable_v<Value> && std::is_trivially_destructible_v<Value>);
        MOTIONRACK_ASSERT(values_ != nullptr);
    }

    Value& operator[](std::size_t i) { return values_[i]; }
    const Value& operator[](std::size_t i) const { return values_[i]; }
    std::span<Value> span() { return {values_.get(), size_}; }
    std::span<const Value> span() const { return {values_.get(), size_}; }

  private:
    struct Free {
        void operator()(void* memory) const { std::free(memory); }
    };
    // NOLINTEND(cppcoreguidelines-no-malloc)
    std::unique_ptr<Value[], Free> values_;
    std::size_t size_;
};

}  // namespace motionrack::rtc5
