// Samples, waves and copies of a rack.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/rack/wave_sink.hpp>
#include <python/src/python_error.hpp>
#include <python/src/rack_handle.hpp>

namespace motionrack::python {

Result<void> RackHandle::begin_samples(const std::vector<std::string>& names, Duration period,
                                       std::size_t max_samples) {
    running();
    if (sampler_)
        return fail(ErrorKind::refused, "A recording is running and continues. Nothing was started. Stop it first.");
    if (period < microseconds(1) || period > whole_seconds(3600))
        return fail(
            ErrorKind::refused,
            fmt::format("The period is {:.9g} s; it must be 1e-6 to 3600 s. Nothing was started.", to_seconds(period)));
    if (max_samples < 2 || max_samples > 100'000'000)
        return fail(ErrorKind::refused,
                    fmt::format("At most {} samples are to be kept; it must be 2 to 100000000. Nothing was started.",
                                max_samples));
    rack::RecorderSettings settings;
    MOTIONRACK_TRY(settings.sampled, sampled_channels(*rack_, *context_, names));
    settings.period = period;
    settings.breaks = true;
    settings.tap = tap_.get();
    settings.sink = [this, max_samples](const rack::Declaration& declared) {
        auto table = std::make_shared<SampleTable>(declared, max_samples);
        samples_ = table;
        return table;
    };
    MOTIONRACK_TRY(sampler_, rack::Recorder::create(*rack_, settings));
    sampler_->begin(period);
    sampler_->poll();
    sampler_->drain();
    return {};
}

Result<std::shared_ptr<const SampleTable>> RackHandle::end_samples() {
    rack();
    if (!sampler_) return fail(ErrorKind::refused, "No recording runs; nothing was done.");
    const std::unique_ptr<rack::Recorder> ended = std::move(sampler_);
    MOTIONRACK_CHECK(ended->finish());
    return std::move(samples_);
}

Result<void> RackHandle::begin_waves(const std::string& path, const std::vector<std::string>& signals) {
    running();
    if (recorder_)
        return fail(ErrorKind::refused,
                    "A recording of waves is running and continues. Nothing was started. Stop it first.");
    MOTIONRACK_TRY(const rack::WaveFormat format, rack::wave_format(path));
    rack::RecorderSettings settings;
    settings.sink = rack::wave_sink({path, format, Duration{0}, MOTIONRACK_VERSION});
    settings.tap = tap_.get();
    settings.signals = signals;
    MOTIONRACK_TRY(recorder_, rack::Recorder::create(*rack_, settings));
    next_register_look_ = now();
    return {};
}

Result<void> RackHandle::end_waves() {
    rack();
    if (!recorder_) return fail(ErrorKind::refused, "No recording of waves runs; nothing was done.");
    const std::unique_ptr<rack::Recorder> ended = std::move(recorder_);
    next_register_look_ = never;
    return ended->finish();
}

std::shared_ptr<RackHandle> RackHandle::copy() {
    running();
    auto out = std::make_shared<RackHandle>(config_);
    out->fault_texts_ = fault_texts_;
    out->sample_period_ = sample_period_;
    out->copy_from(*this);
    return out;
}

/// Returns true if both have the same cards in the same places and equal numbers of parts and wires, so that state can
/// be copied.
bool RackHandle::is_built_like(RackHandle& other) {
    const sim::Kernel &own = running().kernel(), &its = other.running().kernel();
    const auto same = [](const rack::RackCard& a, const rack::RackCard& b) {
        return a.name == b.name && a.type == b.type;
    };
    return own.device_count() == its.device_count() && own.wire_count() == its.wire_count() &&
           std::equal(config_.cards.begin(), config_.cards.end(), other.config_.cards.begin(),
                      other.config_.cards.end(), same);
}

void RackHandle::copy_from(RackHandle& other) {
    running();
    other.running();
    if (!is_built_like(other)) refuse("The snapshot is of a rack of another kind; nothing was done.");
    if (sampler_ || recorder_) refuse("A recording runs, and time would jump in it; nothing was done. Stop it first.");
    rack_->copy_from(*other.rack_);
    context_->copy_from(*other.context_);
    plan_->copy_from(*other.plan_);
    tap_->lend(nullptr);
    listen_again();
    if (job_) job_->copy_from(*other.job_);
}

}  // namespace motionrack::python
