// libFuzzer: any bytes as accesses, wires, images and passing time on a virtual IOFLEX02; what must always hold is in the card's
// test/card_fuzz.hpp.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <motionrack/cards/ioflex02/test/card_fuzz.hpp>
#include <span>

namespace {

class Bytes final : public motionrack::ioflex02::fuzz::Feed {
  public:
    explicit Bytes(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
    std::uint32_t word() override { return byte() | byte() << 8; }
    bool empty() const override { return bytes_.empty(); }

  private:
    std::uint32_t byte() {
        if (bytes_.empty()) return 0;
        const std::uint32_t value = bytes_.front();
        bytes_ = bytes_.subspan(1);
        return value;
    }
    std::span<const std::uint8_t> bytes_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes({data, size});
    motionrack::ioflex02::fuzz::Verdict verdict;
    motionrack::ioflex02::fuzz::run(bytes, 2'000, verdict);
    if (verdict.problem.empty()) return 0;
    std::fprintf(stderr, "%s\n", verdict.problem.c_str());
    std::abort();
}
