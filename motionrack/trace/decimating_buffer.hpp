// Stores any number of samples in bounded memory: when full, drops every second sample.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace motionrack::trace {

/// Stores each sample with its deviation; when two samples merge, keeps the larger deviation.
template <class Sample>
class DecimatingBuffer {
  public:
    /// `max_samples`: capacity, at least 16.
    explicit DecimatingBuffer(std::size_t max_samples) : max_samples_(std::max<std::size_t>(max_samples, 16)) {}

    /// Appends the sample or merges it with the last one.
    void add(const Sample& sample, double deviation) {
        if (++skipped_ < keep_every_) {
            deviations_.back() = std::max(deviations_.back(), deviation);
            return;
        }
        skipped_ = 0;
        samples_.push_back(sample);
        deviations_.push_back(deviation);
        if (samples_.size() > max_samples_) thin_out();
    }

    const std::vector<Sample>& samples() const { return samples_; }
    const std::vector<double>& deviations() const { return deviations_; }

  private:
    void thin_out() {
        std::size_t out = 0;
        for (std::size_t i = 0; i < samples_.size(); i += 2, ++out) {
            samples_[out] = samples_[i];
            deviations_[out] = std::max(deviations_[i], i + 1 < deviations_.size() ? deviations_[i + 1] : 0.0);
        }
        samples_.resize(out);
        deviations_.resize(out);
        keep_every_ *= 2;
    }

    std::size_t max_samples_;
    std::vector<Sample> samples_;
    std::vector<double> deviations_;
    std::size_t keep_every_ = 1, skipped_ = 0;
};

}  // namespace motionrack::trace
