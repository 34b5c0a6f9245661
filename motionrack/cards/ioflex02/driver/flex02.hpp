// The card's configuration object, the source's tIOFlex02: loads the array with an image, drives the outputs, reads the
// inputs. It accesses the card only through a register port, so it works with a virtual card as with a real one.
//
//   Init: base address      Configure:
//   signature? ─► one card? ─► unpack ─► CONFIGURE, DATA .. DATA, END ─► RUNNING? ─► Result
#pragma once

#include <cstdint>
#include <motionrack/base/port.hpp>
#include <motionrack/base/result.hpp>
#include <motionrack/cards/ioflex02/image.hpp>
#include <motionrack/cards/ioflex02/map.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace motionrack::ioflex02 {

/// Results of Init; the names are the source's, the numbers are chosen here.
enum FlexResult : int {
    Flex_Ok = 0,      ///< the array is configured
    Flex_ErrCfg = 1,  ///< configuration failed: the image is truncated, damaged or foreign, or the array did not start
    Flex_ErrDevice = 2,  ///< no card at the address, or two cards
    Flex_ErrProject = 3  ///< the array runs another project or version
};

struct FlexSettings {
    Duration start_timeout = whole_seconds(10);  ///< > 0: maximum wait for the configured array
    Duration poll = milliseconds(10);            ///< > 0: interval between two reads of STATUS
    std::uint8_t ident = position_ident;         ///< expected project version
    std::vector<std::uint8_t> image = {};        ///< compressed; empty: the built-in image
};

class Flex02 {
  public:
    Flex02(RegisterPort& port, Interrupt& interrupt, FlexSettings settings = {});
    virtual ~Flex02() = default;
    Flex02(const Flex02&) = delete;
    Flex02& operator=(const Flex02&) = delete;

    /// FlexResult of the last Configure; Flex_ErrDevice before the first. Unless it is Flex_Ok, nothing is written and
    /// every read returns 0.
    int Result = Flex_ErrDevice;
    /// Message of Result; empty if Result is Flex_Ok.
    const std::string& why() const { return why_; }
    bool ok() const { return Result == Flex_Ok; }

    /// Sets only the base address, like the source's constructor; call Configure next.
    virtual void Init(std::uint16_t Addr);
    /// Checks that exactly one card answers at the base address, loads its gate array with a compressed image and
    /// checks which project and version then runs. Takes seconds. Sets Result.
    virtual void Configure(std::span<const std::uint8_t> image);
    /// The image that Flex2Pos::Init loads; empty: the built-in one.
    void use_image(std::vector<std::uint8_t> image) { settings_.image = std::move(image); }
    std::uint16_t base_address() const { return base_; }

    /// Version of the project in the array.
    std::uint8_t GetIdent();
    /// Low and high 8 outputs of X5. The project "position" does not drive X7.
    void WriteOutL(std::uint8_t Data);
    void WriteOutH(std::uint8_t Data);
    /// Low and high 8 of the 16 inputs: A, B, Z, Cal of axes 0 and 1 from bit 0 on, and of axes 2 and 3.
    std::uint8_t ReadInL();
    std::uint8_t ReadInH();

  protected:
    std::uint16_t get(std::uint32_t at);
    void put(std::uint32_t at, std::uint16_t value);
    const std::vector<std::uint8_t>& own_image() const { return settings_.image; }
    /// Reads both registers of a 24-bit value; `low`: offset of the register _L. Returns 0 .. 16,777,215.
    std::uint32_t get24(std::uint32_t low);
    Instant now() const { return interrupt_.now(); }
    void pass(Duration duration) { interrupt_.pass(duration); }
    bool stop_requested() const { return interrupt_.stop_requested(); }

  private:
    bool set(FlexResult result, std::string why = {});
    bool find_card();
    bool feed(std::span<const std::uint8_t> raw);
    bool wait_until_running();
    bool check_project();
    std::uint16_t in(std::uint32_t at) { return port_.read(base_ + at); }
    void out(std::uint32_t at, std::uint16_t value) { port_.write(base_ + at, value); }

    RegisterPort& port_;
    Interrupt& interrupt_;
    FlexSettings settings_;
    std::uint16_t base_ = 0;
    std::string why_ = "Init was not called, so nothing can be read or written.";
};

}  // namespace motionrack::ioflex02
