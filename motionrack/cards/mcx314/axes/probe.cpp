// Probing: the chip itself latches the positions of its axes at the probe's edge, and stops them.
//
//   nIN3     ______________|~~~~~~~~~~~~~~      the probe touches, in tick n
//   LP         0 1 2 ... 812 813 ... 840 841    the drive decelerates from tick n on
//   BR                    |812                  saved at the end of tick n by each axis' own synchronous action
//
// The latched position depends neither on the feed rate nor on the host's polling.
#include <fmt/format.h>

#include <motionrack/cards/mcx314/axes/chip_axis_group.hpp>
#include <motionrack/cards/mcx314/map.hpp>

namespace motionrack::mcx314 {

namespace {

constexpr int probe_input = 3;

}  // namespace

Result<control::ProbeResult> ChipAxisGroup::probe(const control::PlannedMove& move, bool release) {
    MOTIONRACK_CHECK(check_probe(release));
    MOTIONRACK_CHECK(arm_probe(release));
    probing_ = true;
    Result<void> driven = follow(move);
    if (driven) driven = finish();
    probing_ = false;
    control::ProbeResult outcome;
    outcome.hit = probe_hit();
    // A move that the probe has ended is not an error.
    if (!driven && (!outcome.hit || driven.error().kind != ErrorKind::machine || stopped_by_other())) {
        MOTIONRACK_CHECK(disarm_probe());
        return tl::unexpected<Error>(std::move(driven.error()));
    }
    if (!driven) go_on_from_here();
    outcome.at = commanded_position();
    for (std::size_t i = 0; i < map_.channel.size() && outcome.hit; ++i)
        if (map_.channel[i] >= 0) outcome.at[i] = driver_.ReadBR(map_.channel[i]) / map_.limits[i].pulses_per_unit;
    MOTIONRACK_CHECK(disarm_probe());
    return outcome;
}

/// The path continues from the actual position, not from the end of the move.
void ChipAxisGroup::go_on_from_here() {
    starts_.push_back({-1, current_line_, driver_.interrupt().now()});
    for (int c = 0; c < channel_count; ++c) expected_[static_cast<std::size_t>(c)] = driver_.ReadLPS(c);
    notes_ = take_path_warnings();
    const std::int32_t block = segmenter_->next_move();
    segmenter_.emplace(map_, range_, expected_, host_);
    segmenter_->count_from(block);
}

Result<void> ChipAxisGroup::check_probe(bool release) {
    unsigned used = 0;
    for (const int channel : map_.channel)
        if (channel >= 0) used |= 1u << channel;
    if (probe_channels_ == 0)
        return fail(ErrorKind::refused, "No probe is connected to IN3 of this card. Nothing was moved.");
    if ((used & ~probe_channels_) != 0) {
        return fail(ErrorKind::refused,
                    "The probe is not at the input IN3 of each channel that moves an axis, so not all positions could "
                    "be latched. Nothing was moved; wire them in the rack file.");
    }
    for (int c = 0; c < channel_count; ++c) {
        if ((used >> c & 1) == 0 || driver_.inputs(c).in[probe_input] == release) continue;
        return fail(ErrorKind::machine,
                    release ? "The probe is open before the move that should open it. Nothing was moved."
                            : "The probe is closed before the move that should close it. Nothing was moved; move it "
                              "away first (G38.4).");
    }
    return {};
}

/// Every axis at the probe saves its own LP at the edge. It first saves LP once by command, so a change shows the edge.
Result<void> ChipAxisGroup::arm_probe(bool release) {
    const auto save = field("SM7", "LPSAV").mask;
    MOTIONRACK_CHECK(
        driver_.SetStopInput(probe_channels_, probe_input, release ? StopInput::at_low : StopInput::at_high));
    MOTIONRACK_CHECK(driver_.SetSynchronous(probe_channels_, field("SM6", "CMD").mask, save));
    MOTIONRACK_CHECK(driver_.Synchronous(probe_channels_));
    for (int c = 0; c < channel_count; ++c)
        if ((probe_channels_ >> c & 1) != 0) saved_before_[static_cast<std::size_t>(c)] = driver_.ReadBR(c);
    const auto edge = release ? field("SM6", "IN3DN").mask : field("SM6", "IN3UP").mask;
    return driver_.SetSynchronous(probe_channels_, edge, save);
}

Result<void> ChipAxisGroup::disarm_probe() {
    MOTIONRACK_CHECK(driver_.SetSynchronous(probe_channels_, 0, 0));
    return driver_.SetStopInput(probe_channels_, probe_input, StopInput::off);
}

bool ChipAxisGroup::probe_hit() {
    for (int c = 0; c < channel_count; ++c)
        if ((probe_channels_ >> c & 1) != 0 && driver_.ReadBR(c) != saved_before_[static_cast<std::size_t>(c)])
            return true;
    return false;
}

bool ChipAxisGroup::stopped_by_other() {
    for (int c = 0; c < channel_count; ++c) {
        const DriveStatus status = driver_.axis_status(c);
        if (status.at_limit() || status.alarm() || status.emergency()) return true;
    }
    return false;
}

}  // namespace motionrack::mcx314
