// The run loop, the queue of wire changes, and snapshots.
#include <algorithm>
#include <cstring>
#include <motionrack/base/fnv.hpp>
#include <motionrack/sim/kernel.hpp>

namespace motionrack::sim {

namespace {
constexpr std::size_t queue_capacity = 4096;
constexpr std::size_t max_changes = 20'000;  // wire changes in one event
}  // namespace

DeviceId Kernel::add(Device& device, Phase phase, std::string name) {
    MOTIONRACK_ASSERT(!started_);
    devices_.push_back({&device, phase, std::move(name)});
    if (auto* deferring = dynamic_cast<DeferringDevice*>(&device)) deferring_.push_back(deferring);
    due_.push_back({});
    return static_cast<DeviceId>(devices_.size() - 1);
}

WireId Kernel::add_wire(std::string name, int level, int bits, WireId same) {
    MOTIONRACK_ASSERT(!started_ && find_wire(name) == WireId::none);
    if (same != WireId::none) {
        wires_[index(same)].also.push_back(std::move(name));
        return same;
    }
    wires_.push_back({std::move(name), {}, {}, -1, static_cast<std::int16_t>(bits), {}});
    wire_state_.push_back({level, level, 0, 0});
    return static_cast<WireId>(wires_.size() - 1);
}

void Kernel::listen(WireId wire, DeviceId device, int pin) {
    Wire& w = wires_[index(wire)];
    MOTIONRACK_ASSERT(!started_ && w.listeners.size() < 32);
    if (w.lazy_pin < 0) wire_state_[index(wire)].wants |= 1u << w.listeners.size();
    w.listeners.push_back({device, static_cast<std::int16_t>(pin)});
}

void Kernel::drive_lazily(WireId wire, DeviceId device, int pin) {
    Wire& w = wires_[index(wire)];
    MOTIONRACK_ASSERT(!started_ && w.lazy_pin < 0);
    w.lazy_owner = device;
    w.lazy_pin = static_cast<std::int16_t>(pin);
    wire_state_[index(wire)].wants = 0;
}

void Kernel::start() {
    MOTIONRACK_ASSERT(!started_);
    queue_.resize(queue_capacity);
    conditions_.resize(condition_capacity);
    started_ = true;
}

// ---- running

void Kernel::find_earliest() {
    earliest_ = 0;
    for (std::size_t i = 1; i < due_.size(); ++i)
        if (due_[i].is_before(due_[earliest_])) earliest_ = i;
    knows_earliest_ = true;
}

RunEnd Kernel::run_until(Instant until, RunBreak at) {
    MOTIONRACK_ASSERT(started_ && until >= state_.now);
    break_ = false;
    deliver();
    const std::uint64_t reported = at == RunBreak::conditions ? state_.condition_count : 0;
    while (!break_ && !due_.empty()) {
        if (!knows_earliest_) find_earliest();
        Due& next = due_[earliest_];
        if (next.at > until) break;
        state_.now = next.at;
        next.at = never;
        knows_earliest_ = false;
        ++state_.events;
        devices_[earliest_].device->on_scheduled(state_.now);
        deliver();
        if (at == RunBreak::conditions && state_.condition_count != reported) break_ = true;
    }
    if (!break_) state_.now = until;
    sync_all();
    return break_ ? RunEnd::broken : RunEnd::reached;
}

void Kernel::settle() {
    run_until(state_.now);
}

void Kernel::sync_all() {
    for (DeferringDevice* device : deferring_) device->sync(state_.now);
}

void Kernel::schedule(DeviceId device, Instant at) {
    Due& due = due_[index(device)];
    if (at == due.at) return;
    const Instant before = due.at;
    due.at = std::max(at, state_.now);
    due.order = (std::uint64_t{static_cast<std::uint8_t>(devices_[index(device)].phase)} << 56) | ++state_.sequence;
    if (index(device) == earliest_)
        knows_earliest_ = knows_earliest_ && due.at < before;
    else if (knows_earliest_ && due.is_before(due_[earliest_]))
        earliest_ = index(device);
}

void Kernel::report(DeviceId device, std::uint16_t code, std::int64_t a, std::int64_t b) {
    conditions_[state_.condition_count++ % condition_capacity] = {state_.now, device, code, a, b};
    mix(std::uint64_t{code} << 32 | index(device));
}

// ---- wires

void Kernel::set_wire(WireId wire, int level) {
    WireState& w = wire_state_[index(wire)];
    w.driven = level;
    if (!w.forced) change(wire, level);
}

void Kernel::change(WireId wire, int level) {
    WireState& w = wire_state_[index(wire)];
    if (w.level == level) return;
    if (!started_) {
        w.level = level;  // initial levels are not changes
        return;
    }
    if (queue_size_ - queue_head_ >= queue_capacity || queue_size_ >= max_changes) {
        if (!unsettled_)
            report(no_device, wires_never_settle, static_cast<std::int64_t>(index(wire)),
                   static_cast<std::int64_t>(queue_size_));
        unsettled_ = true;
        return;  // the wire keeps its level, which its listeners received last
    }
    w.level = level;
    queue_[queue_size_++ % queue_capacity] = {wire, 0, level};
}

void Kernel::deliver() {
    while (queue_head_ < queue_size_) {
        const Change c = queue_[queue_head_++ % queue_capacity];
        mix(std::uint64_t{index(c.wire)} << 32 | static_cast<std::uint32_t>(c.level));
        if (observer_) observer_->wire_changed(c.wire, c.level, state_.now);
        const Wire& wire = wires_[index(c.wire)];
        const std::uint32_t wants = wire_state_[index(c.wire)].wants;
        for (std::size_t i = 0; i < wire.listeners.size(); ++i)
            if (wants >> i & 1)
                devices_[index(wire.listeners[i].device)].device->on_wire(wire.listeners[i].pin, c.level, state_.now);
    }
    queue_head_ = queue_size_ = 0;
    unsettled_ = false;
}

int Kernel::level(WireId wire) const {
    const Wire& w = wires_[index(wire)];
    const WireState& s = wire_state_[index(wire)];
    if (w.lazy_pin >= 0 && !s.forced && !s.wants)
        return devices_[index(w.lazy_owner)].device->level_at(w.lazy_pin, state_.now);
    return s.level;
}

void Kernel::subscribe(WireId wire, DeviceId device, bool wanted) {
    const Wire& w = wires_[index(wire)];
    WireState& s = wire_state_[index(wire)];
    const std::uint32_t before = s.wants;
    for (std::size_t i = 0; i < w.listeners.size(); ++i)
        if (w.listeners[i].device == device) s.wants = wanted ? s.wants | 1u << i : s.wants & ~(1u << i);
    if (w.lazy_pin < 0 || (before != 0) == (s.wants != 0)) return;
    Device& owner = *devices_[index(w.lazy_owner)].device;
    if (s.wants) s.driven = owner.level_at(w.lazy_pin, state_.now);
    if (s.wants && !s.forced) s.level = s.driven;
    owner.wanted_changed(w.lazy_pin, s.wants != 0, state_.now);
}

bool Kernel::wanted(WireId wire) const {
    return wire_state_[index(wire)].wants != 0;
}

void Kernel::force(WireId wire, int level) {
    WireState& w = wire_state_[index(wire)];
    w.level = this->level(wire);  // level of a lazily driven wire
    w.forced = 1;
    change(wire, level);
    if (lazy(wire)) owner_of(wire).forced_changed(wires_[index(wire)].lazy_pin, true, level, state_.now);
}

void Kernel::release(WireId wire) {
    WireState& w = wire_state_[index(wire)];
    if (!w.forced) return;
    w.forced = 0;
    if (lazy(wire)) owner_of(wire).forced_changed(wires_[index(wire)].lazy_pin, false, 0, state_.now);
    change(wire, lazy(wire) && !w.wants ? level(wire) : w.driven);
}

const std::string& Kernel::wire_name(WireId wire, std::size_t further) const {
    static const std::string no_name;
    const Wire& w = wires_[index(wire)];
    if (further == 0) return w.name;
    return further <= w.also.size() ? w.also[further - 1] : no_name;
}

WireId Kernel::find_wire(std::string_view name) const {
    for (std::size_t i = 0; i < wires_.size(); ++i) {
        const Wire& wire = wires_[i];
        if (wire.name == name || std::find(wire.also.begin(), wire.also.end(), name) != wire.also.end())
            return static_cast<WireId>(i);
    }
    return WireId::none;
}

// ---- inspection and rewinding

std::vector<Condition> Kernel::conditions(std::uint64_t after) const {
    std::vector<Condition> out;
    const std::uint64_t first = std::max(after, dropped_conditions());
    for (std::uint64_t i = first; i < state_.condition_count; ++i) out.push_back(conditions_[i % condition_capacity]);
    return out;
}

std::uint64_t Kernel::dropped_conditions() const {
    return state_.condition_count > condition_capacity ? state_.condition_count - condition_capacity : 0;
}

void Kernel::mix(std::uint64_t value) {
    std::uint64_t h =
        state_.trace_hash ^ value ^ static_cast<std::uint64_t>(state_.now.count()) * 0xFF51AFD7ED558CCDull;
    h ^= h >> 32;
    h *= 0xD6E8FEB86659FD93ull;
    state_.trace_hash = h ^ (h >> 29);
}

namespace {

template <class T>
std::span<std::byte> bytes_of_vector(std::vector<T>& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    return {reinterpret_cast<std::byte*>(v.data()), v.size() * sizeof(T)};
}

}  // namespace

/// Calls visit(span) for every part of the rack's state in a fixed order; `of` selects the state of a device.
/// Conditions are excluded.
template <class Visit>
void Kernel::each_piece(Visit visit, std::span<std::byte> (Device::*of)()) {
    visit(bytes_of(state_));
    visit(bytes_of_vector(due_));
    visit(bytes_of_vector(wire_state_));
    for (Slot& slot : devices_) visit((slot.device->*of)());
}

/// Last part of a snapshot: the stored conditions, in the order of the ring, and wire changes made between runs that
/// have not reached their listeners yet.
std::array<std::span<std::byte>, 2> Kernel::tail() {
    MOTIONRACK_ASSERT(queue_head_ == 0);
    const auto kept = static_cast<std::size_t>(std::min<std::uint64_t>(state_.condition_count, condition_capacity));
    return {bytes_of_vector(conditions_).first(kept * sizeof(Condition)),
            bytes_of_vector(queue_).first(queue_size_ * sizeof(Change))};
}

Snapshot Kernel::snapshot() {
    MOTIONRACK_ASSERT(started_);
    Snapshot out;
    std::size_t size = tail()[0].size() + tail()[1].size();
    each_piece([&size](std::span<std::byte> piece) { size += piece.size(); }, &Device::state);
    out.bytes.reserve(size);
    const auto append = [&out](std::span<std::byte> piece) {
        out.bytes.insert(out.bytes.end(), piece.begin(), piece.end());
    };
    each_piece(append, &Device::state);
    for (const std::span<std::byte> piece : tail()) append(piece);
    return out;
}

void Kernel::restore(const Snapshot& snapshot) {
    std::size_t at = 0;
    auto take = [&](std::span<std::byte> piece) {
        MOTIONRACK_ASSERT(at + piece.size() <= snapshot.bytes.size());
        if (piece.empty()) return;
        std::memcpy(piece.data(), snapshot.bytes.data() + at, piece.size());
        at += piece.size();
    };
    each_piece(take, &Device::state);
    queue_head_ = queue_size_ = 0;
    queue_size_ = (snapshot.bytes.size() - at - tail()[0].size()) / sizeof(Change);
    MOTIONRACK_ASSERT(queue_size_ <= queue_capacity);
    for (const std::span<std::byte> piece : tail()) take(piece);
    MOTIONRACK_ASSERT(at == snapshot.bytes.size());
    unsettled_ = false;
    knows_earliest_ = false;
}

std::uint64_t Kernel::state_hash() {
    std::uint64_t h = fnv_start;
    const auto mix = [&h](std::span<const std::byte> piece) {
        for (const std::byte b : piece) h = fnv_step(h, static_cast<std::uint64_t>(b));
    };
    each_piece(mix, &Device::hashed_state);
    mix(tail()[1]);
    return h;
}

}  // namespace motionrack::sim
