// Order and timing of edges, and the faults of lines.
#include <motionrack/base/result.hpp>
#include <motionrack/sim/blocks/quadrature_counter.hpp>
#include <motionrack/sim/parts/line_output.hpp>

namespace motionrack::parts {

namespace {

constexpr std::int64_t max_behind = 8;  // counts: a larger lag is lost

/// Ticks between two edges at `rate` edges/s.
std::int64_t spacing_of(double rate) {
    return std::max<std::int64_t>(1, static_cast<std::int64_t>(1e10 / rate + 0.5));
}

}  // namespace

LineOutput::LineOutput(sim::Kernel& kernel, const std::string& name, const LineOutputSettings& settings,
                       LineOutputState& state)
    : kernel_(kernel), settings_(settings), state_(state) {
    MOTIONRACK_ASSERT(settings.index_every >= 0 && settings.index_every % 4 == 0);
    MOTIONRACK_ASSERT(settings.min_edge_interval >= nanoseconds(10) && settings.min_edge_interval <= whole_seconds(1));
    state_.min_edge_interval = settings.min_edge_interval.count();
    state_.random = settings.seed * 0x9E3779B97F4A7C15ull + 1;
    constexpr const char* names[] = {".a", ".b", ".z"};
    for (std::size_t i = 0; i < wires_.size(); ++i) wires_[i] = kernel.add_wire(name + names[i], 0);
    begin(0);
}

std::uint64_t LineOutput::random(std::uint64_t below) {
    state_.random = state_.random * 6'364'136'223'846'793'005ull + 1'442'695'040'888'963'407ull;
    return (state_.random >> 33) % below;
}

// ---- edges

void LineOutput::begin(std::int64_t count) {
    state_.shown = state_.target = count;
    note_index();
    put_out();
}

void LineOutput::show(std::int64_t count, Instant now) {
    state_.target = count;
    plan(now);
    if (state_.step_at <= now) act(now);
}

void LineOutput::rename(std::int64_t counts) {
    state_.shown += counts;
    state_.target += counts;
}

/// Plans the next edge if one is due and none is planned.
void LineOutput::plan(Instant now) {
    if (state_.shown == state_.target) {
        state_.step_at = never;
        return;
    }
    if (state_.step_at != never) return;
    const auto delay =
        state_.jitter > 0 ? static_cast<std::int64_t>(random(static_cast<std::uint64_t>(state_.jitter) + 1)) : 0;
    state_.step_at = std::max(now + Duration{delay}, state_.free_at);
}

bool LineOutput::loses_lines() const {
    return settings_.too_quick == TooQuick::loses_lines ||
           (settings_.too_quick == TooQuick::loses_by_fault &&
            state_.min_edge_interval != settings_.min_edge_interval.count());
}

void LineOutput::step(Instant now) {
    const std::int64_t to_go = state_.target - state_.shown, behind = to_go < 0 ? -to_go : to_go,
                       sign = to_go < 0 ? -1 : 1;
    if (loses_lines() && behind > max_behind) {
        const std::int64_t lost = (behind - max_behind / 2) / 4 * 4;
        state_.shown += sign * lost;
        state_.lost += lost;
    }
    state_.shown += sign;
    state_.free_at = now + Duration{state_.min_edge_interval};
    state_.step_at = never;
    note_index();
    put_out();
    plan(now);
}

void LineOutput::act(Instant now) {
    if (state_.noise_at <= now) noise(now);
    if (state_.step_at <= now) step(now);
}

// ---- appearance of a count

/// Within the dirt the lines are constant: they show the start of the dirt, which equals its end.
std::int64_t LineOutput::visible(std::int64_t count) const {
    if (state_.dirt_lines == 0) return count;
    const std::int64_t within = floor_mod(count - settings_.dirt_at, settings_.index_every);
    return within <= 4 * state_.dirt_lines ? count - within : count;
}

bool LineOutput::index(std::int64_t count) const {
    if (settings_.index_every == 0) return false;
    const std::int64_t within = floor_mod(count - settings_.index_at, settings_.index_every);
    return within == 0 || (state_.second_index > 0 && within == state_.second_index);
}

/// Handles the start or end of an index pulse.
void LineOutput::note_index() {
    const bool now = index(state_.shown);
    if (now && !state_.in_index && state_.missing_left > 0) {
        --state_.missing_left;
        state_.left_out = 1;
    }
    if (!now) state_.left_out = 0;
    state_.in_index = now;
}

void LineOutput::put_out() {
    const unsigned lines = sim::lines_of(visible(state_.shown));
    const bool z = state_.in_index && !state_.left_out;
    const std::array<unsigned, 3> signals = {state_.swapped ? lines >> 1 : lines & 1,
                                             state_.swapped ? lines & 1 : lines >> 1, z ? 1u : 0u};
    for (std::size_t i = 0; i < wires_.size(); ++i) {
        const unsigned level = signals[i] ^ ((state_.inverted ^ state_.flipped) >> i & 1u);
        kernel_.set_wire(wires_[i], state_.broken[i] == 0 ? static_cast<int>(level) : state_.broken[i] - 1);
    }
}

// ---- faults

/// Toggles between a pulse on A or B and a pause, of 50 ns to 1 us each.
void LineOutput::noise(Instant now) {
    if (state_.flipped != 0) {
        state_.flipped = 0;
        --state_.noise_left;
    } else {
        state_.flipped = static_cast<std::uint8_t>(1 + random(2));
    }
    put_out();
    state_.noise_at = state_.noise_left > 0 ? now + Duration{500 + static_cast<std::int64_t>(random(9'500))} : never;
}

bool LineOutput::fault(std::string_view name, double value, Instant now) {
    const auto within = [value](double max) { return value >= 0 && value <= max; };  // rejects NaN as well
    const auto whole = static_cast<std::int64_t>(within(1e9) ? value : 0);
    constexpr std::string_view letters = "abz";
    const std::size_t letter = name.empty() ? letters.npos : letters.find(name.back());
    if (letter != letters.npos && name.substr(0, name.size() - 1) == "broken_") {
        if (!within(2)) return false;
        state_.broken[letter] = static_cast<std::uint8_t>(whole);
    } else if (letter != letters.npos && name.substr(0, name.size() - 1) == "inverted_") {
        const unsigned bit = 1u << letter;
        state_.inverted = static_cast<std::uint8_t>(value != 0 ? state_.inverted | bit : state_.inverted & ~bit);
    } else if (name == "swapped") {
        state_.swapped = value != 0;
    } else if (name == "noise") {
        if (!within(1e6)) return false;
        state_.noise_left = whole;
        state_.flipped = 0;
        state_.noise_at = whole > 0 ? now : never;
    } else if (name == "missing_index") {
        if (!within(1e9)) return false;
        state_.missing_left = whole;
    } else if (name == "double_index") {
        if (!within(1e9) || whole >= settings_.index_every) return false;
        state_.second_index = whole;
    } else if (name == "jitter") {
        if (!within(1)) return false;
        state_.jitter = from_seconds(value).count();
    } else if (name == "dirt") {
        if (!within(1e9) || (whole > 0 && 4 * whole >= settings_.index_every)) return false;
        state_.dirt_lines = whole;
    } else if (name == "overspeed") {
        if (!within(1e8) || (value > 0 && value < 1)) return false;
        state_.min_edge_interval = value > 0 ? spacing_of(value) : settings_.min_edge_interval.count();
    } else {
        return false;
    }
    note_index();
    put_out();
    return true;
}

}  // namespace motionrack::parts
