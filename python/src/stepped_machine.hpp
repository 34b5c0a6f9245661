// A machine operated step by step: its motion thread runs up to the allowed time and then waits at a gate.
//
//  Python ──command──► [ inbox ] ──► motion thread: Machine::run ──► pace: gate open until `allowed_`
//  Python ──advance──► allowed_ ───────────────────────────────────────┘   at the gate: parked_, Python continues
//
// Python and the motion thread never run concurrently, so each command takes effect in the same slice in every run.
#pragma once

#include <condition_variable>
#include <memory>
#include <motionrack/operate/machine.hpp>
#include <mutex>
#include <string>
#include <thread>

namespace motionrack::python {

class SteppedMachine {
  public:
    static Result<std::unique_ptr<SteppedMachine>> make(const rack::RackConfig& config);
    ~SteppedMachine();
    SteppedMachine(const SteppedMachine&) = delete;
    SteppedMachine& operator=(const SteppedMachine&) = delete;

    /// Advances time in whole slices of 2 ms. Calls `look` every 50 ms of real time; if it returns true, the wait ends
    /// with the machine at the gate in the middle of its work.
    void advance(Duration time, const std::function<bool()>& look);
    /// Runs `work` on the motion thread at the gate and returns its result.
    template <class Work>
    auto execute(Work work) {
        using Value = decltype(work(*machine_));
        std::optional<Value> out;
        bool done = false;
        machine_->post([&] {
            Value value = work(*machine_);
            const std::lock_guard<std::mutex> lock(lock_);
            out.emplace(std::move(value));
            done = true;
            changed_.notify_all();
        });
        std::unique_lock<std::mutex> lock(lock_);
        changed_.notify_all();
        changed_.wait(lock, [&] { return done; });
        changed_.wait(lock, [this] { return parked_; });
        return std::move(*out);
    }

  private:
    SteppedMachine() = default;
    bool pace(Instant now);
    void begin(std::unique_ptr<operate::Machine> machine);

    std::unique_ptr<operate::Machine> machine_;
    std::thread motion_;
    std::mutex lock_;
    std::condition_variable changed_;
    Instant allowed_{}, reached_{};
    bool parked_ = false, quitting_ = false;
};

}  // namespace motionrack::python
