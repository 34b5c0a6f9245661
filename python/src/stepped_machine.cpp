// Gate at which the motion thread waits until Python allows more time.
#include <chrono>
#include <python/src/stepped_machine.hpp>

namespace motionrack::python {

namespace {
constexpr auto hear_every = std::chrono::milliseconds(2);  // real-time interval at which the inbox is processed
constexpr auto look_every = std::chrono::milliseconds(50);
}  // namespace

Result<std::unique_ptr<SteppedMachine>> SteppedMachine::make(const rack::RackConfig& config) {
    std::unique_ptr<SteppedMachine> out(new SteppedMachine);
    operate::MachineSettings settings;
    settings.pace = [self = out.get()](Instant now) { return self->pace(now); };
    MOTIONRACK_TRY(std::unique_ptr<operate::Machine> machine, operate::Machine::make(config, std::move(settings)));
    out->begin(std::move(machine));
    return out;
}

void SteppedMachine::begin(std::unique_ptr<operate::Machine> machine) {
    machine_ = std::move(machine);
    motion_ = std::thread([this] { machine_->run(); });
    std::unique_lock<std::mutex> lock(lock_);
    changed_.wait(lock, [this] { return parked_; });
}

SteppedMachine::~SteppedMachine() {
    if (!motion_.joinable()) return;
    {
        const std::lock_guard<std::mutex> lock(lock_);
        quitting_ = true;
        changed_.notify_all();
    }
    machine_->post([this] { machine_->quit(); });
    motion_.join();
}

bool SteppedMachine::pace(Instant now) {
    std::unique_lock<std::mutex> lock(lock_);
    reached_ = now;
    if (quitting_ || now < allowed_) return parked_ = false, true;
    parked_ = true;
    changed_.notify_all();
    changed_.wait_for(lock, hear_every);
    parked_ = !(quitting_ || now < allowed_);
    return !parked_;
}

void SteppedMachine::advance(Duration time, const std::function<bool()>& look) {
    std::unique_lock<std::mutex> lock(lock_);
    changed_.wait(lock, [this] { return parked_; });
    allowed_ = later(reached_, time);
    if (allowed_ <= reached_) return;
    parked_ = false;
    changed_.notify_all();
    while (!changed_.wait_for(lock, look_every, [this] { return parked_; })) {
        lock.unlock();
        const bool enough = look();
        lock.lock();
        if (enough) allowed_ = reached_;
    }
}

}  // namespace motionrack::python
