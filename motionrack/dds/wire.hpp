// Conversion between a sample and the struct of Cyclone DDS; only the sources of this module include it.
#pragma once

#include <sample.h>

#include <memory>
#include <motionrack/dds/dds_library.hpp>
#include <motionrack/dds/sample.hpp>

namespace motionrack::dds {

inline constexpr const char* topic_name = "motionrack_grating_frames";

/// A WireSample with capacity for the longest frame, so reading and writing need no allocation.
class WireBuffer {
  public:
    WireBuffer() {
        wire_.counts._maximum = grating_bus::max_scales;
        wire_.counts._buffer = counts_.data();
        wire_.counts._release = false;
        wire_.addresses._maximum = grating_bus::max_scales;
        wire_.addresses._buffer = addresses_.data();
        wire_.addresses._release = false;
    }
    WireBuffer(const WireBuffer&) = delete;
    WireBuffer& operator=(const WireBuffer&) = delete;
    ~WireBuffer() = default;

    motionrack_dds_WireSample& wire() { return wire_; }
    void put(const Sample& sample);
    void get(Sample& sample) const;

  private:
    motionrack_dds_WireSample wire_{};
    std::array<std::uint32_t, grating_bus::max_scales> counts_{};
    std::array<std::uint8_t, grating_bus::max_scales> addresses_{};
};

/// Handle of a Cyclone DDS entity; the destructor deletes the entity.
class Entity {
  public:
    explicit Entity(dds_entity_t handle = 0) : handle_(handle) {}
    ~Entity() {
        if (handle_ > 0) dds_delete(handle_);
    }
    Entity(const Entity&) = delete;
    Entity& operator=(const Entity&) = delete;
    Entity(Entity&& other) noexcept : handle_(other.handle_) { other.handle_ = 0; }
    Entity& operator=(Entity&& other) noexcept {
        std::swap(handle_, other.handle_);
        return *this;
    }
    dds_entity_t get() const { return handle_; }

  private:
    dds_entity_t handle_;
};

/// Creates a participant in a domain; entities created from it end with it. Errors: invalid_input, io.
Result<Entity> join(const std::string& bus, int domain);
/// Returns the quality of service of a bus: best effort, keep last 1, volatile, in the bus' partition. `ignore_own`: a
/// reader ignores the writers of its own participant.
using Qos = std::unique_ptr<dds_qos_t, void (*)(dds_qos_t*)>;
Qos qos_of(const std::string& bus, bool ignore_own);
/// Makes an error from a DDS return code. `what` begins its message: "The frames' topic could not be created".
tl::unexpected<Error> engine_error(const char* what, dds_return_t code);

}  // namespace motionrack::dds
