// Reader of raw captures: samples of 1 to 8 bytes, one line per bit.
#include <fmt/format.h>

#include <array>
#include <motionrack/decode/capture.hpp>
#include <motionrack/decode/kernels.hpp>

namespace motionrack::decode {

namespace {

constexpr std::size_t block_bytes = std::size_t{1} << 18;

/// Every `size`-th byte.
template <std::size_t size>
void gather(const std::uint8_t* __restrict from, std::size_t samples, std::uint8_t* __restrict to) {
    for (std::size_t i = 0; i < samples; ++i) to[i] = from[i * size];
}
constexpr std::array<void (*)(const std::uint8_t*, std::size_t, std::uint8_t*), 8> gathers = {
    gather<1>, gather<2>, gather<3>, gather<4>, gather<5>, gather<6>, gather<7>, gather<8>};

class RawCapture final : public Capture {
  public:
    RawCapture(std::unique_ptr<Source> source, const std::string& name, const CaptureSettings& settings)
        : Capture(std::move(source), name),
          size_(static_cast<std::size_t>(settings.sample_bytes)),
          buffer_(block_bytes) {
        format_ = Format::raw;
        tick_s_ = 1 / settings.sample_rate_hz;
        for (int bit = 0; bit < 8 * settings.sample_bytes; ++bit) signals_.push_back(fmt::format("{}", bit));
    }
    Result<bool> next(SampleBlock& block) override;
    std::uint64_t bytes_read() const override { return read_; }

  private:
    void split(std::size_t samples);

    std::size_t size_;
    std::vector<std::uint8_t> buffer_;
    std::vector<std::uint8_t> column_;
    std::vector<std::vector<std::uint64_t>> planes_;
    std::uint64_t read_ = 0;
};

/// Converts the bytes of wider samples to planes.
void RawCapture::split(std::size_t samples) {
    const std::size_t words = (samples + 63) / 64;
    planes_.resize(chosen_.size());
    column_.resize(words * 64);
    for (std::size_t byte = 0; byte < size_; ++byte) {
        bool there = false;
        for (std::size_t line = 0; line < chosen_.size(); ++line) {
            if (chosen_[line] / 8 != byte) continue;
            if (!there) gathers[size_ - 1](buffer_.data() + byte, samples, column_.data());
            there = true;
            planes_[line].resize(words);
            best_kernels().split(column_.data(), words, static_cast<int>(chosen_[line] % 8), planes_[line].data());
        }
    }
}

Result<bool> RawCapture::next(SampleBlock& block) {
    block = {};
    // A multiple of all sample sizes, so only the last piece can end within one.
    const std::size_t wanted = block_bytes / (64 * size_) * (64 * size_);
    std::size_t have = 0;
    while (have < wanted) {
        MOTIONRACK_TRY(const std::size_t got,
                       source_->read(reinterpret_cast<char*>(buffer_.data()) + have, wanted - have));
        if (got == 0) break;
        have += got;
    }
    read_ += have;
    block.samples = have / size_;
    if (have % size_ != 0)
        cut_ = Error{ErrorKind::invalid_input,
                     fmt::format("The file ends {} of {} bytes into a sample, after {} bytes: it is cut off, or a "
                                 "sample has another number of bytes. The complete samples before that were decoded.",
                                 have % size_, size_, read_),
                     name_,
                     {}};
    if (block.samples == 0) return false;
    for (LineFacts& facts : facts_) facts.known_from = 0;
    if (size_ == 1) {
        block.bytes = buffer_.data();
        return true;
    }
    split(block.samples);
    for (const auto& plane : planes_) block.planes.push_back(plane.data());
    return true;
}

}  // namespace

Result<std::unique_ptr<Capture>> open_raw(std::unique_ptr<Source> source, const std::string& name,
                                          const CaptureSettings& settings) {
    if (settings.sample_bytes < 1 || settings.sample_bytes > 8)
        return fail(
            ErrorKind::refused,
            fmt::format("A raw sample has {} bytes; it must have 1 to 8. Nothing was decoded.", settings.sample_bytes));
    if (!(settings.sample_rate_hz > 0))
        return fail(ErrorKind::invalid_input,
                    "A raw capture has no sample rate. Nothing was decoded; add --sample-rate 24M, "
                    "for instance.",
                    {}, name);
    return std::make_unique<RawCapture>(std::move(source), name, settings);
}

}  // namespace motionrack::decode
