// A real card behind the port that drivers know: its registers in mapped memory or in I/O ports, its interrupt line by
// UIO, and the computer's clock. A driver on it is the same as on a virtual card.
//
//   driver ──► CardPort ──► words:  volatile 16-bit loads and stores in a mapping, or pread and pwrite of two bytes
//                  ──► line:   a UIO node, or looking again and again
//                  ──► clock:  the computer's monotonic one
//
// Linux. One thread at a time, one program at a time: two masters on one card confuse it. So an open port has a lock on
// its bytes of the file; a second one on them is refused. A card that is reached by two files has two locks.
#pragma once

#include <atomic>
#include <memory>
#include <motionrack/base/card_map.hpp>
#include <motionrack/base/port.hpp>
#include <motionrack/base/result.hpp>
#include <motionrack/live/clock.hpp>
#include <motionrack/live/interrupt_line.hpp>
#include <motionrack/live/port_spec.hpp>
#include <motionrack/live/word_access.hpp>
#include <optional>

namespace motionrack::live {

class CardPort final : public RegisterPort, public Interrupt {
  public:
    /// Opens the files and makes the mapping; no register is touched. `map` tells how far the card's registers go; each
    /// is 16 bits wide. Errors: io (not there, no permission, too short, cannot be mapped), refused (open already;
    /// accesses that would not reach the card as they must), with the remedy.
    static Result<std::unique_ptr<CardPort>> open(const PortSpec& spec, const CardMap& map,
                                                  std::unique_ptr<Clock> clock = nullptr);

    /// One access; at least PortSpec::gap after the one before. `offset`: of a register of the card's map.
    void write(std::uint32_t offset, std::uint16_t value) override;
    /// FFFFh, as from an empty slot, where the computer refused an access; see trouble().
    std::uint16_t read(std::uint32_t offset) override;

    /// Waits for the UIO node to count an interrupt. Without one it waits for the whole `timeout` and says false.
    bool wait(Duration timeout) override;
    void pass(Duration duration) override { clock_->sleep(duration); }
    Instant now() const override { return clock_->now(); }
    bool stop_requested() const override { return stop_ && stop_->load(std::memory_order_relaxed); }

    /// The flag a signal handler sets (Ctrl-C); may be nullptr.
    void set_stop_flag(const std::atomic<bool>* stop) { stop_ = stop; }
    /// True if the card's interrupts reach this program.
    bool has_interrupt() const { return line_.has_value(); }
    /// The first access that the computer refused; from then on no access is made.
    const std::optional<Error>& trouble() const { return trouble_; }

  private:
    CardPort(std::unique_ptr<WordAccess> words, std::optional<InterruptLine> line, std::unique_ptr<Clock> clock,
             const PortSpec& spec, std::uint32_t last);
    /// Lets the gap pass; false if there is trouble.
    bool begin_access(std::uint32_t offset);
    void end_access(int error, std::uint32_t offset, const char* what);

    std::unique_ptr<WordAccess> words_;
    std::optional<InterruptLine> line_;
    std::unique_ptr<Clock> clock_;
    std::string path_;
    Duration gap_;
    std::uint32_t stride_;
    std::uint32_t last_;  ///< offset of the last register
    std::optional<Instant> accessed_;
    std::optional<Error> trouble_;
    const std::atomic<bool>* stop_ = nullptr;
};

}  // namespace motionrack::live
