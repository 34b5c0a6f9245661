// Port of a real card for the drivers: its registers in mapped memory or in I/O ports, its interrupt line by UIO, and
// the computer's clock. The same driver runs on a virtual card.
//
//   driver ──► CardPort ──► words:  volatile 16-bit loads and stores in a mapping, or pread and pwrite of two bytes
//                  ──► line:   a UIO node, or polling
//                  ──► clock:  the computer's monotonic clock
//
// Linux only. One thread in one program may use a card at a time, because two masters would interfere. An open port
// therefore locks its bytes of the file, and a second port on them is refused. A card that is accessible through two
// files has two locks.
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
#include <vector>

namespace motionrack::live {

class CardPort final : public RegisterPort, public Interrupt {
  public:
    /// Opens the files and creates the mapping; accesses no register. `map` gives the extent of the card's registers;
    /// each is 16 bits wide. Errors: io (not found, no permission, too short, cannot be mapped), refused (already open;
    /// accesses would not reach the card in the required width), with the remedy.
    static Result<std::unique_ptr<CardPort>> open(const PortSpec& spec, const CardMap& map,
                                                  std::unique_ptr<Clock> clock = nullptr);

    /// One access, at least PortSpec::gap after the previous one. `offset`: of a register in the card's map.
    void write(std::uint32_t offset, std::uint16_t value) override;
    /// Returns FFFFh, as from an empty slot, if the computer refused an access; see trouble(). Where the card gives
    /// FFFFh, reads its other registers until one differs; if none does, no card answers, and that is trouble().
    std::uint16_t read(std::uint32_t offset) override;
    /// Reads the registers that reading does not change until one is not FFFFh. Errors: io if none is, or as trouble().
    Result<void> check_answers();

    /// Waits for the UIO node to count an interrupt. Without a node it waits for the whole `timeout` and returns false.
    bool wait(Duration timeout) override;
    void pass(Duration duration) override { clock_->sleep(duration); }
    Instant now() const override { return clock_->now(); }
    bool stop_requested() const override { return stop_ && stop_->load(std::memory_order_relaxed); }

    /// The flag of a signal handler (Ctrl-C); may be nullptr.
    void set_stop_flag(const std::atomic<bool>* stop) { stop_ = stop; }
    /// True if this program receives the card's interrupts.
    bool has_interrupt() const { return line_.has_value(); }
    /// The first access that the computer refused or no card answered; no further access is made after it.
    const std::optional<Error>& trouble() const { return trouble_; }

  private:
    CardPort(std::unique_ptr<WordAccess> words, std::optional<InterruptLine> line, std::unique_ptr<Clock> clock,
             const PortSpec& spec, const CardMap& map, std::uint32_t last);
    /// Waits for the gap; returns false after a refused access.
    bool begin_access(std::uint32_t offset);
    void end_access(int error, std::uint32_t offset, const char* what);
    std::uint16_t read_word(std::uint32_t offset);

    std::unique_ptr<WordAccess> words_;
    std::optional<InterruptLine> line_;
    std::unique_ptr<Clock> clock_;
    std::string path_;
    Duration gap_;
    std::uint32_t stride_;
    std::uint32_t last_;                ///< offset of the last register
    std::vector<std::uint32_t> quiet_;  ///< offsets of the registers that reading does not change
    std::optional<Instant> accessed_;
    std::optional<Error> trouble_;
    const std::atomic<bool>* stop_ = nullptr;
};

}  // namespace motionrack::live
