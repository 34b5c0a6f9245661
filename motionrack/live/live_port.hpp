// Common part of the ports of real cards: one access at a time with a minimum interval, the interrupt line, and the
// computer's clock.
//
//   LivePort ──► words:  volatile loads and stores in a mapping, or pread and pwrite
//             ──► line:   a UIO node, or polling
//             ──► clock:  the computer's monotonic clock
//
// One thread in one program may use a card at a time, because two masters would interfere. On Linux an open port
// therefore locks its bytes of the file, and a second port on them is refused. A card that is accessible through two
// files has two locks.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <motionrack/base/port.hpp>
#include <motionrack/base/result.hpp>
#include <motionrack/live/clock.hpp>
#include <motionrack/live/interrupt_line.hpp>
#include <motionrack/live/port_spec.hpp>
#include <motionrack/live/word_access.hpp>
#include <optional>
#include <string>

namespace motionrack::live {

class LivePort : public Interrupt {
  public:
    /// Waits for the UIO node to count an interrupt. Without a node it waits for the whole `timeout` and returns false.
    bool wait(Duration timeout) override;
    void pass(Duration duration) override { clock_->sleep(duration); }
    Instant now() const override { return clock_->now(); }
    bool stop_requested() const override { return stop_ && stop_->load(std::memory_order_relaxed); }

    /// Sets the flag by which a signal handler (Ctrl-C) requests a stop; may be nullptr.
    void set_stop_flag(const std::atomic<bool>* stop) { stop_ = stop; }
    /// True if this program receives the card's interrupts.
    bool has_interrupt() const { return line_.has_value(); }
    /// The first access that the computer refused or no card answered; no further access is made after it.
    const std::optional<Error>& trouble() const { return trouble_; }

  protected:
    struct Parts {
        std::unique_ptr<WordAccess> words;
        std::optional<InterruptLine> line;
        std::unique_ptr<Clock> clock;
    };
    /// Opens the files and creates the mapping; accesses no register. `length`: bytes from the start of the first
    /// register to the end of the last. Errors: io (not found, no permission, too short, cannot be mapped), refused
    /// (already open; accesses would not reach the card in the required width), with the remedy.
    static Result<Parts> open_parts(const PortSpec& spec, std::uint64_t length, std::unique_ptr<Clock> clock);
    LivePort(Parts parts, const PortSpec& spec);

    WordAccess& words() { return *words_; }
    const std::string& path() const { return path_; }
    /// Waits for the gap; returns false after a refused access.
    bool begin_access();
    /// `error`: errno of the access to the register at `offset`; 0: none.
    void end_access(int error, std::uint32_t offset, const char* what);
    void set_trouble(Error trouble) { trouble_ = std::move(trouble); }

  private:
    std::unique_ptr<WordAccess> words_;
    std::optional<InterruptLine> line_;
    std::unique_ptr<Clock> clock_;
    std::string path_;
    Duration gap_;
    std::optional<Instant> accessed_;
    std::optional<Error> trouble_;
    const std::atomic<bool>* stop_ = nullptr;
};

}  // namespace motionrack::live
